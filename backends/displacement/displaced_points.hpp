// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/displacement/reach.hpp"

namespace treadmark::displacement {

/// A point of the plane with the base's height and slopes there (NaN: missed); solve() replaces them by those of the
/// displaced surface.
struct PlanePoint {
  std::size_t index = 0;  ///< where the caller keeps it
  double x = 0.0, y = 0.0;
  double z = 0.0, dzdx = 0.0, dzdy = 0.0;
};

/// Displaced heights of a list of points, neighbours next to each other. Points that no offset can reach keep the
/// base's numbers bit for bit. Every other point is solved by Newton's method on its own line, together with the other
/// points so that the base is asked in batches. That the zero found is the outermost one is shown by the Lipschitz
/// constants of the offsets and by bounds of the base's heights near by; otherwise DisplacedLine::search decides.
class DisplacedPoints {
 public:
  DisplacedPoints(const View& view, double max_offset) : view_(view), max_offset_(max_offset) {}

  void solve(std::vector<PlanePoint>& points);

 private:
  struct Range {
    std::size_t begin, end;
  };
  /// Points solved together, with bounds that hold for all of them.
  struct Leaf {
    Range range;
    Rectangle rectangle;
    double outermost;  ///< no displaced height lies beyond it
    double rate;       ///< how far points moved back may go aside per change of height
  };
  struct Unknown {
    std::size_t point;
    double t, cx, cy, h, hx, hy;  ///< present height; where the base was asked and what it said
    double last_step, rate;
    double steepness, offset;  ///< when solved
    enum class State { moving, solved, failed } state;
  };

  void divide_list(std::vector<PlanePoint>& points);
  void divide(std::vector<PlanePoint>& points, const Range& range, double max_offset);
  void collect(std::vector<PlanePoint>& points, const Leaf& leaf);
  void iterate(const std::vector<PlanePoint>& points);
  void advance(const PlanePoint& p, Unknown& w, std::size_t k, int iteration);
  void ask_base();
  bool outermost_everywhere(const Leaf& leaf, const Range& unknowns) const;
  void search(PlanePoint& p) const;

  const View& view_;
  double max_offset_;
  std::vector<Leaf> leaves_;
  std::vector<Range> leaf_unknowns_;
  std::vector<Unknown> unknowns_;
  std::vector<std::size_t> active_, asking_, searched_;
  // buffers of one batch
  std::vector<double> u_, y_, d_, d_u_, d_y_, h_, hx_, hy_;
  std::vector<Vec2> moved_;
  std::vector<Vec3> slopes_;  ///< of solved unknowns
};

}  // namespace treadmark::displacement
