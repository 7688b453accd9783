// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/meshes/parse_mesh.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/points/parse_obj.hpp"
#include "treadmark/io/points/parse_off.hpp"
#include "treadmark/io/points/parse_ply.hpp"
#include "treadmark/io/points/parse_stl.hpp"

namespace treadmark::io::meshes {

namespace {

using points::ByteBlocks;
using points::Field;
using points::LineBlocks;

/// Collects vertices, and triangles from polygons; says what is wrong with them.
class MeshSink {
 public:
  using Options = double;  ///< scale
  static constexpr bool kFaces = true;

  MeshSink(const ByteBlocks& bytes, double scale, std::size_t least_bytes, points::Fail fail)
      : bytes_(bytes), scale_(scale), least_bytes_(least_bytes), fail_(std::move(fail)) {
    mesh_.name = bytes.file();
  }

  static double number(const LineBlocks& lines, const Field& field) { return profiles::to_number(lines, field); }
  static std::uint64_t count(const LineBlocks& lines, const Field& field) {
    const int value = profiles::to_integer(lines, field);
    if (value < 0) lines.fail("a number of elements is negative", field.column);
    return static_cast<std::uint64_t>(value);
  }
  [[noreturn]] static void too_few(const LineBlocks& lines, const Field&, const char*) {
    lines.fail("a vertex needs three coordinates");
  }
  void comment(std::string_view) {}
  void set_content(bool, bool) {}

  void expect(std::uint64_t vertices, std::uint64_t faces) {
    constexpr std::size_t kLeastFace = 4;  // bytes: a number of corners and three of them
    if (vertices > bytes_.left() / least_bytes_ + 1 || faces > bytes_.left() / kLeastFace + 1)
      throw Error(ErrorKind::input_data,
                  fmt::format("{} vertices and {} faces are promised, more than the file holds", vertices, faces),
                  {mesh_.name, 0, 0}, "is it truncated?");
    mesh_.vertices.reserve(vertices);
    mesh_.triangles.reserve(faces);
    expected_ = vertices;
  }

  void add(const Vec3& p) {
    const Vec3 v = scale_ * p;
    if (!v.allFinite())
      fail_(fmt::format("a coordinate of vertex {} is not finite", mesh_.vertices.size()), "remove or repair it");
    mesh_.vertices.push_back(v);
  }
  void add_values(const points::VertexValues& v) { add({v[0], v[1], v[2]}); }

  void add_corner(const Vec3& p) {
    corners_.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
    add(p);
  }

  /// A corner that the file counts from 0 among the vertices that it promises.
  void add_index(double index) {
    if (!(index >= 0.0 && index < static_cast<double>(expected_)) || index != std::floor(index))
      fail_(fmt::format("a face names the vertex {:g}, there are {}", index, expected_), "is the file complete?");
    corners_.push_back(static_cast<std::uint32_t>(index));
  }

  static bool wants_corners() { return true; }
  static void add_normal(const Vec3&) {}

  /// "7", "7/1", "7//3", "7/1/3" or negative, counted back from the newest vertex. The number before the first stroke.
  void add_obj_corner(const LineBlocks& lines, const Field& field) {
    const std::string_view text = field.text.substr(0, field.text.find('/'));
    std::int64_t index = 0;
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc{} || end != text.data() + text.size() || text.empty())
      lines.fail("a vertex number is expected, this is " + profiles::printable(field.text), field.column);
    const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
    if (index == 0 || index > count || index < -count)
      lines.fail(fmt::format("a face names the vertex {}, so far there are {}", index, count), field.column,
                 "numbers count from 1, or back from -1");
    corners_.push_back(static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index));
  }

  /// A polygon, cut into triangles from its first corner.
  void end_face() {
    if (corners_.size() < 3)
      fail_(fmt::format("a face of {} corners", corners_.size()), "faces need at least three corners");
    for (std::size_t k = 2; k < corners_.size(); ++k)
      mesh_.triangles.push_back({corners_[0], corners_[k - 1], corners_[k]});
    corners_.clear();
  }

  TriangleMesh finish(const std::string&) {
    if (mesh_.triangles.empty())
      throw Error(ErrorKind::input_data, "the mesh has no triangles", {mesh_.name, 0, 0},
                  "is it a point cloud? make triangles of it first");
    return std::move(mesh_);
  }

 private:
  const ByteBlocks& bytes_;
  double scale_;
  std::size_t least_bytes_;
  points::Fail fail_;
  std::uint64_t expected_ = 0;  ///< vertices
  TriangleMesh mesh_;
  std::vector<std::uint32_t> corners_;  ///< of the face that is being read
};

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, const std::string& file, double scale) {
  ByteBlocks blocks(bytes, file);
  return points::parse_ply<MeshSink>(blocks, scale);
}

TriangleMesh parse_stl(std::string_view bytes, const std::string& file, double scale) {
  ByteBlocks blocks(bytes, file);
  return points::parse_stl<MeshSink>(blocks, scale);
}

TriangleMesh parse_obj(std::string_view text, const std::string& file, double scale) {
  ByteBlocks blocks(text, file);
  return points::parse_obj<MeshSink>(blocks, scale);
}

TriangleMesh parse_off(std::string_view text, const std::string& file, double scale) {
  ByteBlocks blocks(text, file);
  return points::parse_off<MeshSink>(blocks, scale);
}

}  // namespace treadmark::io::meshes
