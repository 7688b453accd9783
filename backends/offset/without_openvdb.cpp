// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::offset {
namespace {

[[noreturn]] void without_openvdb() { left_out("openvdb", "offsets over a base"); }

}  // namespace

OffsetSample sample_offsets(const Surface&, const Surface&, Body, double, const OffsetSettings&) { without_openvdb(); }

OffsetSample offsets_from_map(const OffsetMap&, Body, double) { without_openvdb(); }

std::shared_ptr<const Surface> make_offset_surface(std::shared_ptr<const Surface>, std::shared_ptr<const SparseOffsets>,
                                                   Interpolation, std::string) {
  without_openvdb();
}

std::size_t memory_bytes(const SparseOffsets&) { without_openvdb(); }
std::size_t active_count(const SparseOffsets&) { without_openvdb(); }

void write_vdb(const std::filesystem::path&, const OffsetFile&) { left_out("openvdb", "files of offsets (.vdb)"); }
OffsetFile read_vdb(const std::filesystem::path&) { left_out("openvdb", "files of offsets (.vdb)"); }

}  // namespace treadmark::offset
