// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"

namespace treadmark::spline {

/// A surface as a pyramid of slabs: cells of a millimetre or some lie between two parallel planes a few micrometres
/// apart, groups of 16 of them between two planes, and so on. A slab cut off at a rectangle bounds heights over it.
class NurbsHull {
 public:
  explicit NurbsHull(const NurbsNet& net);

  /// Range that holds all heights over a rectangle; empty if there is no surface over it.
  Interval heights_over(const Pose& X_SP, const Rectangle& rectangle_P, Facing facing) const;
  std::size_t memory_bytes() const;

 private:
  static constexpr int kChildren = 16;

  /// Box centre +- half that holds a part of the surface, and normal . (p - centre) within offset +- thickness. Rounded
  /// outwards.
  struct Slab {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero(), half = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::UnitZ();
    float offset = 0.0f, thickness = 0.0f;
  };
  /// The children of one slab; those that do not exist have a negative half.
  struct Block {
    std::array<float, kChildren> c_x, c_y, c_z, h_x, h_y, h_z;
    std::array<Slab, kChildren> slabs;
  };
  struct Level {
    int blocks_u, blocks_v;
    std::vector<Block> blocks;
  };
  struct Search;

  static Slab slab_of(const std::vector<Vec3>& points);
  static Slab slab_around(const std::vector<Slab>& parts);
  Level level_of(const std::vector<Slab>& slabs, int nu, int nv) const;
  void descend(std::size_t level, int iu, int iv, Search& search) const;

  std::vector<Level> levels_;  ///< finest first
  int fan_u_, fan_v_;          ///< children of a block in each direction
  double extent_ = 0.0;        ///< of the whole surface from the origin
};

}  // namespace treadmark::spline
