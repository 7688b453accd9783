// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark {

/// Distances from a surface at the nodes of a cubic lattice near it, positive outside the material: a narrow band of
/// a level set (Museth 2013). Plain data.
struct DistanceGrid {
  static constexpr int kEdge = 8;     ///< nodes along the edge of a block
  static constexpr int kNodes = 512;  ///< of a block; index = 64 i + 8 j + k

  /// Neighbouring nodes.
  struct Block {
    std::array<std::int32_t, 3> first{};       ///< its first node, multiples of kEdge
    std::array<float, kNodes> value{};         ///< distances in units of the voxel; where nothing is known anything
    std::array<std::uint64_t, kEdge> known{};  ///< word i, bit 8 j + k: whether the value there is one
    /// Whether the node is known.
    bool knows(int node) const { return (known[static_cast<std::size_t>(node >> 6)] >> (node & 63) & 1u) != 0; }
  };

  std::string name;           ///< where it comes from, for messages
  Pose place;                 ///< of the lattice in the frame of the surface; node (i, j, k) lies at voxel (i, j, k)
  double voxel = 0.0;         ///< distance of neighbouring nodes [m]
  std::vector<Block> blocks;  ///< in any order, none twice
};

/// One of the bodies that make up a shape.
struct Solid {
  /// What is done with it to those before it.
  enum class Use {
    join,    ///< it is added
    cut,     ///< it is taken away
    common,  ///< only what lies in it as well stays
  };
  Use use = Use::join;                             ///< what is done with it
  std::variant<TriangleMesh, DistanceGrid> shape;  ///< closed triangles, or a level set
  Vec3 offset = Vec3::Zero();                      ///< of its frame in that of the surface [m]
};

/// A wheel or rail put together from bodies, one after the other.
struct SolidShape {
  std::string name;    ///< for messages
  double voxel = 0.0;  ///< of the common lattice [m]; 0: that of the first level set, else the default resolution
  std::vector<Solid> solids;  ///< the first one is joined
};

}  // namespace treadmark
