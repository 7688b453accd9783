// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::io {

/// Whether the name ends like a mesh file: .ply .stl .obj .off (any case).
bool is_mesh_file(const std::filesystem::path& file);

/// Reads .ply (ASCII, binary of both endians), .stl (ASCII, binary), .obj, .off (ASCII, binary). Polygons are cut into
/// triangles; other elements and properties are skipped. Coordinates times scale_to_mm are millimetres, the mesh is in
/// metres. The triangles are returned as they stand in the file; make_mesh_surface repairs. asked_by: where the file
/// was named. Errors: Error(input_data) with file:line:column (byte offset in binary files) and advice.
TriangleMesh read_mesh(const std::filesystem::path& file, double scale_to_mm = 1.0,
                       const SourcePosition& asked_by = {});

/// Writes by the extension of the name, in mm: .ply and .stl binary, .obj and .off as text. The file appears only when
/// complete. comments: lines without line ends for the head of the file; .stl has room for the start of the first one
/// only. Errors: Error(configuration) for another extension or a file that cannot be written.
void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh,
                std::span<const std::string> comments = {});

}  // namespace treadmark::io
