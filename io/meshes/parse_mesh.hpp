// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::io::meshes {

/// What parsers return: coordinates times scale are metres. All errors are Error(input_data) that name `file` and the
/// line or the byte; nothing is allocated for elements that the text cannot hold.
TriangleMesh parse_ply(std::string_view bytes, const std::string& file, double scale);
TriangleMesh parse_stl(std::string_view bytes, const std::string& file, double scale);
TriangleMesh parse_obj(std::string_view text, const std::string& file, double scale);
TriangleMesh parse_off(std::string_view text, const std::string& file, double scale);

}  // namespace treadmark::io::meshes
