// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/meshes/read_mesh.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/io/meshes/parse_mesh.hpp"
#include "treadmark/io/profiles/line_scanner.hpp"
#include "treadmark/io/profiles/read_text.hpp"

namespace treadmark::io {

namespace {

std::string extension_of(const std::filesystem::path& file) { return profiles::lower(file.extension().string()); }

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".ply" || extension == ".stl" || extension == ".obj" || extension == ".off";
}

TriangleMesh read_mesh(const std::filesystem::path& file, double scale_to_mm, const SourcePosition& asked_by) {
  if (!(scale_to_mm > 0.0 && std::isfinite(scale_to_mm)))
    throw Error(ErrorKind::configuration,
                fmt::format("the scale of a mesh must be positive, this is {:g}", scale_to_mm), asked_by,
                "it leads to mm: 1 for a file in mm, 1000 for one in metres");
  if (!is_mesh_file(file))
    throw Error(ErrorKind::input_data, fmt::format("the mesh file '{}' is of no known kind", file.filename().string()),
                asked_by, "known are .ply, .stl, .obj and .off");
  const std::string bytes = profiles::read_text(file, "mesh", asked_by);
  const std::string name = file.string(), extension = extension_of(file);
  const double scale = 1e-3 * scale_to_mm;
  if (extension == ".ply") return meshes::parse_ply(bytes, name, scale);
  if (extension == ".stl") return meshes::parse_stl(bytes, name, scale);
  if (extension == ".obj") return meshes::parse_obj(bytes, name, scale);
  return meshes::parse_off(bytes, name, scale);
}

}  // namespace treadmark::io
