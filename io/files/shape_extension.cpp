// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/shape_extension.hpp"

#include "treadmark/io/files/extension.hpp"

namespace treadmark::io {

std::optional<ShapeExtension> shape_extension(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  for (const ShapeExtension& row : kShapeExtensions)
    if (row.extension == extension) return row;
  return std::nullopt;
}

bool can_hold(const std::filesystem::path& file, unsigned kinds) {
  const auto row = shape_extension(file);
  return row && (row->kinds & kinds) != 0;
}

std::optional<Body> body_by_extension(const std::filesystem::path& file) {
  const auto row = shape_extension(file);
  return row ? row->body : std::nullopt;
}

}  // namespace treadmark::io
