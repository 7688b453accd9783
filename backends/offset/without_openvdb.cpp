// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::offset {

std::unique_ptr<Channel> start_openvdb(const std::string&, int) { left_out("openvdb", "files of VDB (.vdb)"); }

}  // namespace treadmark::offset
