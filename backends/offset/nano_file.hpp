// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/backends/offset/sheet_grid.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"

namespace treadmark::offset {

/// The bytes of a NanoVDB file with two grids of single precision numbers, the offsets and the coefficients of the
/// cubic spline through them, without compression. Voxel (i, j) lies at (i, j / 8, j mod 8), see kBlockI. Equal offsets
/// give equal bytes.
std::string nano_bytes(const SparseOffsets& offsets, const Metadata& entries);

/// What nano_bytes made, mapped into memory, where it is evaluated; no memory is taken but for a list of blocks. The
/// file must stay as it is while surfaces of it are used: it is replaced, never written into. Errors: Error(input_data)
/// for a file that is missing, empty, no NanoVDB file, of other making or damaged.
SheetFile read_nano(const std::filesystem::path& file);

}  // namespace treadmark::offset
