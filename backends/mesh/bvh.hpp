// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <vector>

#include "treadmark/backends/mesh/plane_view.hpp"

namespace treadmark::mesh {

/// Bounding volume hierarchy in double precision: halves of the triangles by the middle along the longest axis. Answers
/// every query by itself and decides where single precision cannot. Nodes are compared in the plane frame, where a line is
/// a point and a box becomes a rectangle with a range of heights.
class Bvh {
 public:
  explicit Bvh(const PreparedMesh& mesh);

  /// The outermost triangle over (x, y), its outside or inside; none if the line passes by more than kRimTolerance.
  LineHit outermost(const PlaneView& view, double x, double y) const;

  /// Whether the line meets, inside of the given hit, another triangle from outside.
  bool hides_others(const PlaneView& view, double x, double y, const LineHit& hit) const;

  /// Range of the triangles that show their outside over the rectangle; margin(t, view) [m] widens that of triangle t and is
  /// at most largest_margin.
  HeightBounds bounds(const PlaneView& view, const Rectangle& r, double largest_margin,
                      const std::function<double(std::uint32_t)>& margin) const;

  MeshArrays arrays() const {
    return {mesh_.vertices.data()->data(), mesh_.triangles.data()->data(), mesh_.neighbours.data()->data(), nodes_.data(), order_.data()};
  }

  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node) + order_.capacity() * sizeof(std::uint32_t); }

 private:
  using Node = BvhNode;
  struct Extent;

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t count, const std::vector<Vec3>& middles,
             std::uint32_t stop_at);
  void close(std::uint32_t node);
  void add_slab(Node& node) const;

  const PreparedMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace treadmark::mesh
