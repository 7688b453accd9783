// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

#include "treadmark/backends/displacement/band_kernel.hpp"
#include "treadmark/backends/displacement/base_heights.hpp"
#include "treadmark/backends/displacement/base_patch.hpp"
#include "treadmark/backends/displacement/displaced_points.hpp"
#include "treadmark/backends/displacement/natural_row.hpp"
#include "treadmark/backends/displacement/reach.hpp"

namespace treadmark::displacement {

/// A band of rows of a grid whose base heights are known, seen in blocks that are judged as a whole. Lines of blocks
/// where the offsets cannot make F (see DisplacedLine) fall, over places where the base is smooth from point to point,
/// have one zero. It is found with one offset, at a height foretold from the rows before, and one height of the base,
/// at the point moved back: interpolated if that is as good as asking (BasePatch). All other points are left to
/// DisplacedPoints.
class DisplacedBand {
 public:
  DisplacedBand(const View& view, double max_offset, const Grid2& grid, const BaseHeights& base, const HeightsOut& out);

  static constexpr int kRows = 32;
  /// out: full arrays with the heights of the base and its slopes, or none of these; they are replaced.
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
  static constexpr std::size_t kTogether = 64;  ///< columns solved together: what they need stays in the cache
  using Row = std::array<double, kTogether>;
  /// Points of a row on their way. Aligned as a kernel likes it.
  struct Points {
    Row x, t, d, d_u, d_y, sin, cos, per_r;  ///< t: where the offset was asked
    Row h, hx, hy;                           ///< base
    Row step, steepness, gx, gy, gz, back_x, back_y;
    BandPoints pointers();
  };
  /// A point whose base must be asked at the point moved back.
  struct Asking {
    int ix, iy;
    std::size_t block;
    double t, d, d_u, d_y, sin, cos, per_r, x, y;
  };

  Kind judge(int first_column, int last_column, Block& block);
  void leave_misses(const Block& block, double reach);
  void leave(int ix, int iy);
  void divide(int first_column, int last_column);
  void solve_columns(int first_column, int last_column);
  void foretell(int iy);
  void approach(int iy);
  void ask_offsets(Points& points, double y, std::size_t n);
  void see_base(int iy);
  void finish(int iy);
  bool is_good(const Points& p, std::size_t k, int ix, int iy, const Block& block, double moved_x,
               double moved_y) const;
  void write(const Points& p, std::size_t k, int ix, int iy);
  void ask_base();
  void solve_left();
  const Block& block_of(std::size_t k) const { return blocks_[block_[k]]; }

  const View& view_;
  double max_offset_;
  const Grid2& g_;
  const BaseHeights& base_;
  const HeightsOut& out_;
  const BandKernel& kernel_;
  BandAxes axes_;
  int first_ = 0, last_ = 0, begin_ = 0;  ///< rows; first column of those together
  std::size_t n_ = 0;                     ///< of columns
  bool moves_ = false;

  std::vector<Block> blocks_;
  std::array<std::size_t, kTogether> block_{};  ///< of each column
  Points now_, again_;
  Row rise_[4];                          ///< of the rows before, nearest first
  Row along_, across_;                   ///< way to the points moved back, in steps
  std::array<bool, kTogether> known_{};  ///< whether the base is, there
  std::array<std::size_t, kTogether> which_{};
  BasePatch patch_;
  NaturalRow natural_;
  std::vector<Asking> asking_;
  std::vector<PlanePoint> left_;
};

}  // namespace treadmark::displacement
