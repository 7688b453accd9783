// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/nurbs/bezier_patch.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_kernels.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::spline {

/// A spline surface as its bicubic Bezier patches. A rational one is a grid of control points, of which neighbouring
/// patches share those on their border; a polynomial one is kept by positions and derivatives at the corners of
/// patches, which form a grid or a list. Boxes of control points form a pyramid above the patches. Immutable, so safe
/// to use from any number of threads.
class NurbsNet {
 public:
  /// Derivatives by the parameters.
  struct Corner {
    Vec3 p, p_u, p_v, p_uv;
  };

  /// u_breaks, v_breaks: parameters of the patch borders, increasing. points: surface frame, homogeneous, index =
  /// iv + ((3 patches in v) + 1) iu.
  NurbsNet(std::vector<double> u_breaks, std::vector<double> v_breaks, std::vector<Quad> points);
  /// corners: index = iv + (patches in v + 1) iu; for u_breaks that go once round, the last row may be left out.
  NurbsNet(std::vector<double> u_breaks, std::vector<double> v_breaks, std::vector<Corner> corners);

  /// A part of the parameters, and where the corners of its patch stand in a list: [i along u][j along v].
  struct Cell {
    double u0, u1, v0, v1;
    std::uint32_t corner[2][2];
  };
  /// Neighbours in the list should be neighbours on the surface. Patches have the indices (place in the list, 0).
  NurbsNet(std::vector<Cell> cells, std::vector<Corner> corners);

  bool is_list() const { return !cells_.empty(); }
  int patches_u() const { return static_cast<int>(is_list() ? cells_.size() : u_.size() - 1); }
  int patches_v() const { return is_list() ? 1 : static_cast<int>(v_.size()) - 1; }
  /// Parameters at the borders of a patch.
  struct Range {
    double u0, u1, v0, v1;
  };
  Range range(int iu, int iv) const {
    const auto u = static_cast<std::size_t>(iu), v = static_cast<std::size_t>(iv);
    if (is_list()) return {cells_[u].u0, cells_[u].u1, cells_[u].v0, cells_[u].v1};
    return {u_[u], u_[u + 1], v_[v], v_[v + 1]};
  }
  /// Of the whole surface.
  Range range() const;
  /// How many neighbours in each direction a pyramid above the patches takes together.
  int fan_out_u() const { return is_list() ? 16 : 4; }
  int fan_out_v() const { return is_list() ? 1 : 4; }
  std::size_t memory_bytes() const;

  /// Surface frame.
  BezierPatch patch(int iu, int iv) const;
  /// Frame P: homogeneous coordinates there.
  BezierPatch patch(int iu, int iv, const Pose& X_SP) const;
  Box3 bounds() const { return bounds_; }
  /// Polynomial and kept by corners.
  bool by_corners() const { return !corners_.empty(); }
  /// The corners of a patch of such a net.
  PatchCorners corners(int iu, int iv) const;

  /// Patch and local parameters for (u, v), clamped to the surface. Of a list it takes time proportional to its length.
  struct Place {
    int iu, iv;
    double s, t;  ///< -1/2 .. 1/2
  };
  Place find(double u, double v) const;

  /// Numbers of the net: by how much its control points, or positions and derivatives at corners (p, p_u, p_v, p_uv one
  /// after the other), go along directions of their own.
  std::size_t numbers() const { return by_corners() ? 4 * corners_.size() : points_.size(); }
  /// The control point or corner of a number.
  Vec3 number_place(std::size_t number) const;
  NurbsNet with_number(std::size_t number, const Vec3& by) const;
  /// Calls use(number, share) for all on which a place depends: it goes by share of the number along its direction.
  template <class Use>
  void each_number(const Place& place, const Use& use) const;

  /// Calls use(iu, iv, centre, half) for every patch whose box passes wanted(centre, half); so must all boxes above it.
  template <class Wanted, class Use>
  void visit(const Wanted& wanted, const Use& use) const {
    descend(levels_.size() - 1, 0, 0, wanted, use);
  }

 private:
  // In single precision, rounded outwards.
  struct Box {
    Eigen::Vector3f middle, reach;
    Vec3 centre() const { return middle.cast<double>(); }
    Vec3 half() const { return reach.cast<double>(); }
  };
  struct Level {
    int nu, nv;
    std::vector<Box> boxes;
    const Box& at(int iu, int iv) const {
      return boxes[static_cast<std::size_t>(iu) * static_cast<std::size_t>(nv) + static_cast<std::size_t>(iv)];
    }
  };
  template <class Wanted, class Use>
  void descend(std::size_t level, int iu, int iv, const Wanted& wanted, const Use& use) const {
    const Box& box = levels_[level].at(iu, iv);
    const Vec3 centre = box.centre(), half = box.half();
    if (!wanted(centre, half)) return;
    if (level == 0) return use(iu, iv, centre, half);
    const Level& below = levels_[level - 1];
    const int fan_u = fan_out_u(), fan_v = fan_out_v();
    for (int ku = fan_u * iu; ku < std::min(fan_u * (iu + 1), below.nu); ++ku)
      for (int kv = fan_v * iv; kv < std::min(fan_v * (iv + 1), below.nv); ++kv)
        descend(level - 1, ku, kv, wanted, use);
  }

  void build_boxes();
  std::size_t corner_number(int iu, int iv, std::size_t i, std::size_t j) const {
    const auto u = static_cast<std::size_t>(iu);
    if (is_list()) return cells_[u].corner[i][j];
    const std::size_t row = v_.size(), first = (u + i) * row;
    return (first < corners_.size() ? first : 0) + static_cast<std::size_t>(iv) + j;
  }

  std::vector<double> u_, v_;  // of a grid
  std::vector<Cell> cells_;    // of a list
  std::vector<Quad> points_;   // one of the two is empty
  std::vector<Corner> corners_;
  std::vector<Level> levels_;
  Box3 bounds_;  // of all control points, in double precision: the ends of the surface are those of its box
};

template <class Use>
void NurbsNet::each_number(const Place& place, const Use& use) const {
  const double x = place.s + 0.5, y = place.t + 0.5;
  if (by_corners()) {
    const Range r = range(place.iu, place.iv);
    // Hermite's cubics: [end][value, derivative]
    const auto cubics = [](double at, double size) {
      const double a = 1.0 - at;
      return std::array<std::array<double, 2>, 2>{
          {{a * a * (1.0 + 2.0 * at), size * at * a * a}, {at * at * (1.0 + 2.0 * a), -size * at * at * a}}};
    };
    const auto along = cubics(x, r.u1 - r.u0), across = cubics(y, r.v1 - r.v0);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t m = 0; m < 4; ++m)
          use(4 * corner_number(place.iu, place.iv, i, j) + m, along[i][m % 2] * across[j][m / 2]);
    return;
  }
  const auto cubics = [](double at) {
    const double a = 1.0 - at;
    return std::array{a * a * a, 3.0 * a * a * at, 3.0 * a * at * at, at * at * at};
  };
  const auto along = cubics(x), across = cubics(y);
  const std::size_t row = 3 * (v_.size() - 1) + 1,
                    first = 3 * (static_cast<std::size_t>(place.iu) * row + static_cast<std::size_t>(place.iv));
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) sum += along[i] * across[j] * points_[first + i * row + j].w();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      use(first + i * row + j, along[i] * across[j] * points_[first + i * row + j].w() / sum);
}

}  // namespace treadmark::spline
