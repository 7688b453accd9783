// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <vector>

#include "treadmark/backends/mesh/plane_view.hpp"

namespace treadmark::mesh {

/// Bounding volume hierarchy in double precision: halves of the triangles by the middle along the longest axis. Answers
/// every query by itself and decides where single precision cannot. Nodes are compared in the plane frame, where a line
/// is a point and a box becomes a rectangle with a range of heights.
class Bvh {
 public:
  /// Of a triangle, while the hierarchy is built.
  struct Middle {
    Vec3 at;  ///< local [m]
    std::uint32_t triangle;
  };

  /// Puts triangles and vertices in the order of the leaves, so that neighbours lie side by side in memory.
  explicit Bvh(PreparedMesh& mesh);

  /// The outermost triangle over (x, y), its outside or inside; none if the line passes by more than kRimTolerance.
  LineHit outermost(const PlaneView& view, double x, double y) const;

  /// Whether the line meets, inside of the given hit, another triangle from outside.
  bool hides_others(const PlaneView& view, double x, double y, const LineHit& hit) const;

  /// A surface about triangle t: the greatest distance along the normals [m] and their mean, at most of unit length.
  struct About {
    double distance;
    Vec3 normal;
  };
  /// Makes the nodes hold the surface about the triangles.
  void add_surface(const std::function<About(std::uint32_t)>& about);

  MeshArrays arrays() const {
    return {mesh_.vertices.data()->data(), mesh_.triangles.data()->data(), mesh_.neighbours.data()->data(),
            nodes_.data(), about_.empty() ? nullptr : about_.data()->data()};
  }

  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node) + about_.capacity() * sizeof(about_[0]); }

 private:
  using Node = BvhNode;

  void split(std::uint32_t node, std::vector<Middle>& middles);
  void split_below(std::uint32_t node, std::vector<Middle>& middles);
  void close_below(std::uint32_t node);
  void close(std::uint32_t node);
  void add_slab(Node& node) const;

  const PreparedMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<std::array<float, 4>> about_;  ///< see MeshArrays
};

}  // namespace treadmark::mesh
