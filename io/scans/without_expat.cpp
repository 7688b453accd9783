// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

Scan parse_e57(ByteBlocks&, const ScanReadOptions&) { left_out("expat", "scans in E57 files"); }

}  // namespace treadmark::io::scans
