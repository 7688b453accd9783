// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "treadmark/io/files/extension.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io {

/// What a file that stands for a wheel or rail can hold.
enum ShapeFile : unsigned {
  kProfileFile = 1,
  kSlicesFile = 2,
  kTriangleFile = 4,
  kSplineFile = 8,
  kCadFile = 16,
  kOffsetFile = 32,
  kPointFile = 64,  ///< of a scanner
};

struct ShapeExtension {
  std::string_view extension;
  unsigned kinds;  ///< of ShapeFile
  std::optional<Body> body = {};
  bool read = true;  ///< false: its reader refuses the file and says what to do with it
};

/// One row for each extension. Whatever depends on what a file's name ends with asks this table.
// clang-format off
inline constexpr ShapeExtension kShapeExtensions[] = {
    {".csv", kProfileFile | kPointFile}, {".txt", kProfileFile | kPointFile}, {".asc", kProfileFile | kPointFile},
    {".dat", kProfileFile}, {".mpt", kProfileFile},
    {".prr", kProfileFile, Body::rail}, {".ban", kProfileFile, Body::rail}, {".rail", kProfileFile, Body::rail, false},
    {".prw", kProfileFile, Body::wheel}, {".whl", kProfileFile, Body::wheel}, {".wheel", kProfileFile, Body::wheel},
    {".slcs", kSlicesFile, Body::rail}, {".slcw", kSlicesFile, Body::wheel},
    {".ply", kTriangleFile | kPointFile}, {".stl", kTriangleFile | kPointFile},
    {".obj", kTriangleFile | kPointFile}, {".off", kTriangleFile | kPointFile},
    {".xml", kSplineFile}, {".vdb", kOffsetFile}, {".nvdb", kOffsetFile},
    {".step", kCadFile}, {".stp", kCadFile}, {".iges", kCadFile}, {".igs", kCadFile},
    {".las", kPointFile}, {".laz", kPointFile, {}, false}, {".pcd", kPointFile}, {".e57", kPointFile},
    {".ptx", kPointFile}, {".pts", kPointFile}, {".xyz", kPointFile}, {".xyzrgb", kPointFile}, {".xyzn", kPointFile}};
// clang-format on

/// Nothing for a file whose name ends otherwise.
inline std::optional<ShapeExtension> shape_extension(const std::filesystem::path& file) {
  for (const ShapeExtension& row : kShapeExtensions)
    if (row.extension == extension_of(file)) return row;
  return std::nullopt;
}

/// Whether the file can hold one of these kinds.
inline bool can_hold(const std::filesystem::path& file, unsigned kinds) {
  const auto row = shape_extension(file);
  return row && (row->kinds & kinds) != 0;
}

/// The body that the name of a file stands for.
inline std::optional<Body> body_by_extension(const std::filesystem::path& file) {
  const auto row = shape_extension(file);
  return row ? row->body : std::nullopt;
}

}  // namespace treadmark::io
