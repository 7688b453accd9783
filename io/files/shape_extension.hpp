// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

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
inline constexpr ShapeExtension kShapeExtensions[] = {
    {".csv", kProfileFile | kPointFile},
    {".txt", kProfileFile | kPointFile},
    {".asc", kProfileFile | kPointFile},
    {".dat", kProfileFile},
    {".mpt", kProfileFile},
    {".prr", kProfileFile, Body::rail},
    {".prw", kProfileFile, Body::wheel},
    {".ban", kProfileFile, Body::rail},
    {".whl", kProfileFile, Body::wheel},
    {".wheel", kProfileFile, Body::wheel},
    {".rail", kProfileFile, Body::rail, false},
    {".slcs", kSlicesFile, Body::rail},
    {".slcw", kSlicesFile, Body::wheel},
    {".ply", kTriangleFile | kPointFile},
    {".stl", kTriangleFile | kPointFile},
    {".obj", kTriangleFile | kPointFile},
    {".off", kTriangleFile | kPointFile},
    {".xml", kSplineFile},
    {".step", kCadFile},
    {".stp", kCadFile},
    {".iges", kCadFile},
    {".igs", kCadFile},
    {".vdb", kOffsetFile},
    {".las", kPointFile},
    {".laz", kPointFile, {}, false},
    {".pcd", kPointFile},
    {".e57", kPointFile},
    {".ptx", kPointFile},
    {".pts", kPointFile},
    {".xyz", kPointFile},
    {".xyzrgb", kPointFile},
    {".xyzn", kPointFile},
};

/// Nothing for a file whose name ends otherwise.
std::optional<ShapeExtension> shape_extension(const std::filesystem::path& file);
/// Whether the file can hold one of these kinds.
bool can_hold(const std::filesystem::path& file, unsigned kinds);
/// The body that the name of a file stands for.
std::optional<Body> body_by_extension(const std::filesystem::path& file);

}  // namespace treadmark::io
