// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/triangle_mesh.hpp"

namespace treadmark::io::meshes {

/// Collects vertices and polygons; says what is wrong with them through `fail`, which knows the place in the file and
/// throws.
class MeshBuilder {
 public:
  using Fail = std::function<void(const std::string& message, const std::string& advice)>;

  MeshBuilder(const std::string& file, double scale) : scale_(scale) { mesh_.name = file; }

  void reserve(std::uint64_t vertices, std::uint64_t faces) {
    mesh_.vertices.reserve(vertices);
    mesh_.triangles.reserve(faces);
  }

  void add_vertex(double x, double y, double z, const Fail& fail) {
    const Vec3 v = scale_ * Vec3(x, y, z);
    if (!v.allFinite())
      fail(fmt::format("a coordinate of vertex {} is not finite", mesh_.vertices.size()), "remove or repair it");
    mesh_.vertices.push_back(v);
  }

  /// A polygon of at least three corners, cut into triangles from its first corner.
  void add_polygon(const std::vector<std::uint32_t>& corners, const Fail& fail) {
    if (corners.size() < 3)
      fail(fmt::format("a face of {} corners", corners.size()), "faces need at least three corners");
    for (std::size_t k = 2; k < corners.size(); ++k)
      mesh_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }

  std::size_t vertex_count() const { return mesh_.vertices.size(); }

  /// Checks an index from the file, which counts from 0.
  std::uint32_t corner(double index, std::uint64_t vertices, const Fail& fail) const {
    if (!(index >= 0.0 && index < static_cast<double>(vertices)) || index != std::floor(index))
      fail(fmt::format("a face names the vertex {:g}, there are {}", index, vertices), "is the file complete?");
    return static_cast<std::uint32_t>(index);
  }

  TriangleMesh finish() {
    if (mesh_.triangles.empty())
      throw Error(ErrorKind::input_data, "the mesh has no triangles", {mesh_.name, 0, 0},
                  "is it a point cloud? make triangles of it first");
    return std::move(mesh_);
  }

 private:
  double scale_;
  TriangleMesh mesh_;
};

}  // namespace treadmark::io::meshes
