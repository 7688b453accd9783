// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/sheet_grid.hpp"

#include "treadmark/backends/offset/openvdb/sheet_library.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::offset {

namespace {

void throw_fault(const SheetFault& fault, const std::filesystem::path& file) {
  if (fault.message.empty()) return;
  const bool asked = fault.kind == SheetFault::Kind::configuration;
  throw Error(asked ? ErrorKind::configuration : ErrorKind::input_data, fault.message, {file.string()});
}

}  // namespace

SheetGrid::SheetGrid() : storage_(sheet_library().make_storage()) {}
SheetGrid::~SheetGrid() = default;
SheetGrid::SheetGrid(SheetGrid&&) noexcept = default;
SheetGrid& SheetGrid::operator=(SheetGrid&&) noexcept = default;

std::size_t SheetGrid::insert(const BlockKey& key, const Block& values, float tolerance) {
  return storage_->insert(key, values, tolerance);
}
const float* SheetGrid::block(const BlockKey& key) const { return storage_->block(key); }
std::vector<SheetGrid::Entry> SheetGrid::blocks() const { return storage_->blocks(); }
std::size_t SheetGrid::active_count() const { return storage_->active_count(); }
std::size_t SheetGrid::memory_bytes() const { return storage_->memory_bytes(); }

std::string sheet_bytes(const SheetGrid& grid, const SheetFile& frame) {
  std::string bytes;
  throw_fault(sheet_library().write(bytes, grid.blocks(), {frame.u0, frame.y0, frame.du, frame.dy, frame.metadata}),
              {});
  return bytes;
}

}  // namespace treadmark::offset
