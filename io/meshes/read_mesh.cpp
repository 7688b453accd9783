// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/meshes/read_mesh.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/meshes/parse_mesh.hpp"

namespace treadmark::io {

namespace {

using Parser = TriangleMesh (*)(std::string_view, const std::string&, double);

Parser parser_of(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  if (extension == ".ply") return meshes::parse_ply;
  if (extension == ".stl") return meshes::parse_stl;
  if (extension == ".obj") return meshes::parse_obj;
  return extension == ".off" ? meshes::parse_off : nullptr;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) { return parser_of(file) != nullptr; }

TriangleMesh read_mesh(const std::filesystem::path& file, double scale_to_mm, const SourcePosition& asked_by) {
  if (!(scale_to_mm > 0.0 && std::isfinite(scale_to_mm)))
    throw Error(ErrorKind::configuration,
                fmt::format("the scale of a mesh must be positive, this is {:g}", scale_to_mm), asked_by,
                "it leads to mm: 1 for a file in mm, 1000 for one in metres");
  const Parser parser = parser_of(file);
  if (parser == nullptr)
    throw Error(ErrorKind::input_data, fmt::format("the mesh file '{}' is of no known kind", file.filename().string()),
                asked_by, "known are .ply, .stl, .obj and .off");
  return parser(profiles::read_text(file, "mesh", asked_by), file.string(), 1e-3 * scale_to_mm);
}

}  // namespace treadmark::io
