// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/backends/spline/thb/thb_space.hpp"

namespace treadmark::spline {

/// Values of the Bernstein polynomials at a share of their interval.
KnotWeights bernstein_values(int degree, double share);

/// Where knots may stand in one direction. Breaks are numbers of places. Of a grid these are its points: the outer
/// intervals have two at least, so that the finest spline goes through all of them (not-a-knot ends).
struct FitLine {
  std::vector<double> at;
  double period = 0.0;  ///< 0: open
  int least = 1;        ///< places in the shortest interval
  int least_outer = 1;  ///< in the first and the last one

  bool closed() const { return period > 0.0; }
  int last() const { return static_cast<int>(at.size()) - (closed() ? 0 : 1); }
  double place(int i) const {
    return i < static_cast<int>(at.size()) ? at[static_cast<std::size_t>(i)] : at.front() + period;
  }
  /// Where an interval is halved; 0: it is not.
  int half(int from, int to) const;
  /// So many even intervals, or as many as there may be.
  std::vector<int> even(int intervals, int degree) const;
  /// Those longer than the limit halved.
  std::vector<int> halved(const std::vector<int>& breaks, int limit) const;
  KnotLine knots(int degree, const std::vector<int>& breaks) const;
};

/// Products of second differences of Bernstein coefficients.
Eigen::Matrix4d second_differences(int degree);

/// 0 if there are none.
double median_of(std::vector<double>& values);

/// What points leave over.
struct Remainder {
  double most = 0.0;    ///< square of the greatest distance [m^2]
  bool beyond = false;  ///< some point is farther off than allowed
  double sum = 0.0;     ///< of squares of distances along the normal
  double parts = 0.0;   ///< the same of the means of parts: what noise cannot hide
  std::size_t points = 0, filled_parts = 0;
};

/// Adds up a remainder, also by 4 x 4 parts of a cell.
class RemainderSum {
 public:
  /// square [m^2] of the distance, off [m] along the normal, s and t: where in the cell, 0 .. 1.
  void add(double square, double off, double allowed, double s, double t) {
    out_.most = square > out_.most ? square : out_.most;
    out_.beyond |= square > allowed * allowed;
    out_.sum += off * off;
    const std::size_t k = 4 * part_of(s) + part_of(t);
    off_[k] += off;
    ++points_[k];
  }
  Remainder result() const;

 private:
  static std::size_t part_of(double x) { return x < 0.25 ? 0 : x < 0.5 ? 1 : x < 0.75 ? 2 : 3; }
  std::array<double, 16> off_{};
  std::array<std::uint32_t, 16> points_{};
  Remainder out_;
};

/// How closely points are followed.
struct FitTolerance {
  double distance = 0.0;  ///< of a point [m]
  double noise = 0.0;     ///< standard deviation of points along the normal [m]
  bool scattered = false;

  bool noisy() const { return noise > distance; }
  /// Points in a cell that is divided: each child needs some, and more of them against noise.
  std::size_t fewest() const { return noisy() ? 64 : scattered ? 8 : 1; }
  /// Beyond what is allowed, and parts are farther off than independent noise explains.
  bool exceeded(const Remainder& left) const;
  /// Weight of second differences of Bernstein coefficients of a cell with so many points.
  double smoothing(double points) const { return (noisy() ? 1e-3 : 1e-10) * (1.0 + points); }
};

/// Sums over the points of a cell.
struct CellSums {
  Eigen::Matrix<double, 16, 16> moments;  ///< products of Bernstein polynomials, index = 4 i + j
  Eigen::Matrix<double, 16, 3> right;     ///< products of them with what is left [m]
  Remainder left;
};

/// Points with the parameters at which a surface should meet them, sorted by places of the lines. Const functions are
/// thread-safe.
class FitPoints {
 public:
  /// u as it is, v by mean chord lengths [m]. Nothing is followed more closely than a spline of that degree through all
  /// points follows the surface between them, by differences of neighbours.
  FitPoints(const sampling::PointGrid& grid, int degree);
  /// Scattered: u and v as they are, the lines even, with about so many points a place.
  FitPoints(std::vector<double> u, std::vector<double> v, std::vector<Vec3> points, bool closed, double length_of_u,
            double points_a_place);

  /// Of the lattice: of scattered points one less than places.
  int rows() const { return scattered() ? u_.last() : static_cast<int>(u_.at.size()); }
  int columns() const { return columns_; }
  const FitLine& u() const { return u_; }
  const FitLine& v() const { return v_; }
  std::size_t size() const { return points_.size(); }
  bool scattered() const { return !begin_.empty(); }

  /// Points of a cell: places from the first to before the last ones; those on its lower borders belong to it.
  struct Block {
    int i0, i1, j0, j1;
  };
  /// Calls use(place of the point in the list, u, v, point).
  template <class Use>
  void each(const Block& block, const Use& use) const {
    const auto columns = static_cast<std::size_t>(columns_);
    for (int i = block.i0; i < block.i1; ++i) {
      const std::size_t row = static_cast<std::size_t>(i) * columns, from = row + static_cast<std::size_t>(block.j0),
                        to = row + static_cast<std::size_t>(block.j1);
      if (!scattered())
        for (std::size_t k = from; k < to; ++k) use(k, u_.at[static_cast<std::size_t>(i)], v_.at[k - row], points_[k]);
      else
        for (std::size_t k = begin_[from]; k < begin_[to]; ++k) use(k, at_u_[k], at_v_[k], points_[k]);
    }
  }
  std::size_t count(const Block& block) const;
  /// piece: the surface over the range. allowed: distance of a point [m]. only_left: no products.
  CellSums sums(const Block& block, const ThbRange& range, int degree, const ThbPiece& piece, double allowed,
                bool only_left) const;
  /// What a point cannot tell [m].
  double doubt(std::size_t point) const { return doubt_.empty() ? 0.0 : static_cast<double>(doubt_[point]); }

 private:
  FitLine u_, v_;
  int columns_ = 0;  // of the lattice: one less than places for scattered points
  std::vector<Vec3> points_;
  std::vector<float> doubt_;          // of grids
  std::vector<double> at_u_, at_v_;   // of scattered points
  std::vector<std::uint32_t> begin_;  // of scattered points: the first of each cell of the lattice, and one more
};

}  // namespace treadmark::spline
