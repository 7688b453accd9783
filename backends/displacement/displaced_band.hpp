// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/displacement/base_heights.hpp"
#include "treadmark/backends/displacement/displaced_points.hpp"
#include "treadmark/backends/displacement/natural_row.hpp"
#include "treadmark/backends/displacement/reach.hpp"

namespace treadmark::displacement {

/// A band of rows of a grid whose base heights are known, seen in blocks that are judged as a whole. Lines of blocks where
/// the offsets cannot make F (see DisplacedLine) fall, over places where the base is smooth from point to point, have one zero.
/// It is found with one offset, at a height foretold from the rows before, and one height of the base, at the point moved
/// back. All other points are left to DisplacedPoints.
class DisplacedBand {
 public:
  DisplacedBand(const View& view, double max_offset, const Grid2& grid, const BaseHeights& base, const HeightsOut& out);

  static constexpr int kRows = 16;
  /// out: full arrays with the slopes of the base, or none; z is written.
  void solve(int first, int last);

 private:
  struct Block {
    int first, last;      ///< columns
    double rate;          ///< how far points moved back may go aside per change of height
    double tilt;          ///< how far points go along the surface per change of height
    std::uint8_t needed;  ///< smoothness of the base
    bool moves;           ///< whether points are moved aside at all
  };
  enum class Kind { untouched, together, one_by_one };
  Kind judge(int first_column, int last_column, Block& block);
  void leave_misses(const Block& block, double reach);
  void leave(int ix, int iy);
  void divide(int first_column, int last_column);
  void solve_columns();
  void solve_row(int iy);
  void approach(int iy, const std::vector<std::size_t>& active, std::vector<std::size_t>& next);
  void ask_base();
  void finish();
  void solve_left();

  /// A point on its way. Arrays of rows times columns.
  struct Point {
    double t, step;                    ///< where the offset was asked; from there to the height
    double d, d_u, d_y;                ///< the offset
    double sin, cos, per_r;            ///< of the wheel's natural direction
    double cx, cy;                     ///< moved back
    double h, hx, hy;                  ///< base there
    bool present;
  };
  struct Equation {
    double F, steepness;
    Vec3 g;  ///< gradient, in P
  };
  /// Whether a step leaves offset, base and their slopes as they are but for rounding and straight changes.
  static bool is_last(double step, const Block& block, double steepness);
  Equation equation(const Point& p, double x, double y) const;
  Point& at(int iy, std::size_t column) { return points_[static_cast<std::size_t>(iy - first_) * columns_.size() + column]; }

  const View& view_;
  double max_offset_;
  const Grid2& g_;
  const BaseHeights& base_;
  const HeightsOut& out_;
  Vec3 across_, along_rail_, up_rail_;  ///< e_y, and a rail's e_x and e_z, in P
  int first_ = 0, last_ = 0;

  struct Column {
    int ix;
    std::size_t block;
  };
  std::vector<Block> blocks_;
  std::vector<Column> columns_;
  std::vector<Point> points_;
  std::vector<double> x_, t_, d_, d_u_, d_y_;
  std::vector<double> rise_[4];  ///< of the rows before, nearest first
  std::vector<std::size_t> active_, next_;
  std::vector<Vec2> moved_;
  std::vector<Point*> asking_;
  std::vector<double> h_, hx_, hy_;
  NaturalRow natural_;
  std::vector<PlanePoint> left_;
};

}  // namespace treadmark::displacement
