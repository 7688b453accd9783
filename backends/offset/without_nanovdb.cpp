// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/nano_file.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::offset {

std::string nano_bytes(const SparseOffsets&, const Metadata&) { left_out("nanovdb", "files of NanoVDB (.nvdb)"); }
SheetFile read_nano(const std::filesystem::path&) { left_out("nanovdb", "files of NanoVDB (.nvdb)"); }

}  // namespace treadmark::offset
