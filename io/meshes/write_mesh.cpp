// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iterator>

#include <fmt/format.h>

#include "treadmark/core/check_point.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/points/binary_values.hpp"

namespace treadmark::io {

namespace {

constexpr double kMillimetres = 1e3;

using points::put;
using Comments = std::span<const std::string>;

std::string lines(Comments comments, const char* start) {
  std::string out;
  for (const std::string& comment : comments) out += fmt::format("{} {}\n", start, comment);
  return out;
}

std::string ply(const TriangleMesh& mesh, Comments comments) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment millimetres\n{}element vertex {}\nproperty double x\nproperty "
      "double y\n"
      "property double z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      lines(comments, "comment"), mesh.vertices.size(), mesh.triangles.size());
  out.reserve(out.size() + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  CheckPoint check;
  for (const Vec3& v : mesh.vertices) {
    check.pass();
    for (int k = 0; k < 3; ++k) put(out, kMillimetres * v[k]);
  }
  for (const auto& c : mesh.triangles) {
    check.pass();
    put(out, std::uint8_t{3});
    for (const std::uint32_t v : c) put(out, v);
  }
  return out;
}

std::string stl(const TriangleMesh& mesh, Comments comments) {
  std::string out = "binary STL, millimetres";  // must not begin with the word solid
  if (!comments.empty()) out += "; " + comments.front();
  out.resize(80, ' ');
  out.reserve(84 + 50 * mesh.triangles.size());
  put(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  CheckPoint check;
  for (const auto& c : mesh.triangles) {
    check.pass();
    const Vec3 &a = mesh.vertices[c[0]], &b = mesh.vertices[c[1]], &d = mesh.vertices[c[2]];
    Vec3 n = (b - a).cross(d - a);
    if (n.norm() > 0.0) n.normalize();
    for (int k = 0; k < 3; ++k) put(out, static_cast<float>(n[k]));
    for (const Vec3* v : {&a, &b, &d})
      for (int k = 0; k < 3; ++k) put(out, static_cast<float>(kMillimetres * (*v)[k]));
    put(out, std::uint16_t{0});
  }
  return out;
}

/// Text with all digits. OBJ counts vertices from 1 and has letters at the start of lines.
std::string text(const TriangleMesh& mesh, bool obj, Comments comments) {
  std::string out = obj ? "# millimetres\n" + lines(comments, "#")
                        : fmt::format("OFF\n# millimetres\n{}{} {} 0\n", lines(comments, "#"), mesh.vertices.size(),
                                      mesh.triangles.size());
  const auto to = std::back_inserter(out);
  CheckPoint check;
  for (const Vec3& v : mesh.vertices) {
    check.pass();
    fmt::format_to(to, "{}{} {} {}\n", obj ? "v " : "", kMillimetres * v.x(), kMillimetres * v.y(),
                   kMillimetres * v.z());
  }
  for (const auto& c : mesh.triangles) {
    check.pass();
    const std::uint32_t first = obj ? 1 : 0;
    fmt::format_to(to, "{} {} {} {}\n", obj ? "f" : "3", c[0] + first, c[1] + first, c[2] + first);
  }
  return out;
}

}  // namespace

void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh, std::span<const std::string> comments) {
  const auto refuse = [&](const std::string& why, const std::string& advice) {
    throw Error(ErrorKind::configuration, fmt::format("the mesh cannot be written to '{}': {}", file.string(), why), {},
                advice);
  };
  for (const auto& c : mesh.triangles)
    for (const std::uint32_t v : c)
      if (v >= mesh.vertices.size()) refuse("it names vertices that it lacks", "");
  const std::string extension = extension_of(file);
  std::string content;
  if (extension == ".ply")
    content = ply(mesh, comments);
  else if (extension == ".stl")
    content = stl(mesh, comments);
  else if (extension == ".obj")
    content = text(mesh, true, comments);
  else if (extension == ".off")
    content = text(mesh, false, comments);
  else
    refuse("unknown extension", "known are .ply, .stl, .obj and .off");

  write_file(file, content);
}

}  // namespace treadmark::io
