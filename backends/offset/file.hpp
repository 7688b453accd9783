// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::offset {

/// Units, axes, body, period and base as texts; numbers with all their digits.
/// Errors: Error(configuration) for a base that is not a constant section, or belongs to the other body.
Metadata to_metadata(const SparseOffsets& offsets, const SurfaceSpec& base);

/// Fills everything but the grid. Errors: Error(input_data) for an entry that is missing, broken or implausible, naming
/// it.
void from_metadata(const Metadata& metadata, SparseOffsets& offsets, SurfaceSpec& base, const std::string& file);

/// FNV-1a (Fowler, Noll, Vo) over 64 bits; before: the sum of what stands before it.
std::uint64_t sum_of(const char* data, std::size_t size, std::uint64_t before = 14695981039346656037ull);

/// What the file with that sheet holds. Errors: Error(input_data) for entries as above, offsets that are none, a
/// transform that makes no sense.
OffsetFile from_sheet(SheetFile sheet, const std::filesystem::path& file);

}  // namespace treadmark::offset
