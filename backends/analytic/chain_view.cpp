// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/chain_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::analytic {

ChainView::ChainView(const std::vector<ChainSegment>& chain, double d_y, double d_z) : chain_(&chain) {
  constexpr double kPi = std::numbers::pi;
  const double turn = std::atan2(d_y, d_z);  // inclination in the view = inclination + turn
  std::vector<double> ends;

  // Cut every segment where it runs along the direction of view, so that each piece is a graph h(w).
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const ChainSegment& seg = chain[i];
    const double a = seg.angle + turn, b = a + seg.curvature * seg.length;
    const double low = std::min(a, b), high = std::max(a, b);
    const int first = to_whole<int>(std::floor(low / kPi + 0.5)), last = to_whole<int>(std::ceil(high / kPi - 0.5));
    for (int half_turn = first; half_turn <= std::max(first, last); ++half_turn) {
      double from = 0.0, to = seg.length;
      if (seg.curvature != 0.0) {
        const double at_low = ((half_turn - 0.5) * kPi - a) / seg.curvature,
                     at_high = ((half_turn + 0.5) * kPi - a) / seg.curvature;
        from = std::max(from, std::min(at_low, at_high));
        to = std::min(to, std::max(at_low, at_high));
      }
      if (!(to > from)) continue;
      const ChainPoint p = point_on(seg, from), q = point_on(seg, to);
      const double w_p = p.y * d_z - p.z * d_y, w_q = q.y * d_z - q.z * d_y;
      if (!(std::fabs(w_q - w_p) > 0.0)) continue;
      // Build on the flatter end: the other one may be vertical in this view.
      const bool use_p = std::fabs(p.angle + turn - half_turn * kPi) <= std::fabs(q.angle + turn - half_turn * kPi);
      const ChainPoint& o = use_p ? p : q;
      const double angle = o.angle + turn;
      Piece piece;
      piece.graph = {std::min(w_p, w_q), std::max(w_p, w_q), use_p ? w_p : w_q, o.y * d_y + o.z * d_z,
                     std::sin(angle),    std::cos(angle),    seg.curvature};
      piece.segment = static_cast<int>(i);
      piece.angle_start = a;
      piece.half_turn = half_turn;
      pieces_.push_back(piece);
      ends.push_back(piece.graph.x_min);
      ends.push_back(piece.graph.x_max);
    }
  }

  // Between neighbouring ends the order of the pieces does not change: the visible one is found at the middle.
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (!(ends[i + 1] > ends[i])) continue;
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    Interval interval{ends[i], ends[i + 1], -1, 0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < pieces_.size(); ++j) {
      const ArcGraph& g = pieces_[j].graph;
      if (middle < g.x_min || middle > g.x_max) continue;
      ++interval.covering;
      const double h = g.height(middle);
      if (h < least) {
        least = h;
        interval.piece = static_cast<int>(j);
      }
    }
    // Joints computed from two sides differ in the last bits; such slivers must not open a gap or hide anything.
    if (!intervals_.empty() && interval.piece == intervals_.back().piece &&
        interval.covering == intervals_.back().covering)
      intervals_.back().w_max = interval.w_max;
    else
      intervals_.push_back(interval);
  }
}

int ChainView::find(double w, int guess) const {
  if (intervals_.empty()) return -1;
  const int last = static_cast<int>(intervals_.size()) - 1;
  int i = std::clamp(guess, 0, last);
  while (i < last && w > intervals_[static_cast<std::size_t>(i)].w_max) ++i;
  while (i > 0 && w < intervals_[static_cast<std::size_t>(i)].w_min) --i;
  const Interval& interval = intervals_[static_cast<std::size_t>(i)];
  if (!(w >= interval.w_min && w <= interval.w_max)) return -1;
  if (interval.piece >= 0) return i;
  constexpr double kSliver = 1e-12;  // [m] rounding between two pieces that touch
  if (interval.w_max - interval.w_min < kSliver && i < last && i > 0) return i + 1;
  return -1;
}

ChainView::Hit ChainView::hit(double w, int interval) const {
  const Interval& at = intervals_[static_cast<std::size_t>(interval)];
  const Piece& p = pieces_[static_cast<std::size_t>(at.piece)];
  const ChainSegment& seg = (*chain_)[static_cast<std::size_t>(p.segment)];
  Hit hit;
  hit.segment = p.segment;
  constexpr double kSliver = 1e-12;
  hit.hides_others = at.covering > 1 && at.w_max - at.w_min > kSliver;
  if (seg.curvature == 0.0) {
    hit.distance = (w - p.graph.x_min) / std::fabs(p.graph.c0);
    if (p.graph.c0 < 0.0) hit.distance = seg.length - hit.distance;
  } else {
    const double s = std::clamp(p.graph.sine(w), -1.0, 1.0);
    const double parity = p.half_turn % 2 == 0 ? 1.0 : -1.0;
    const double angle = p.half_turn * std::numbers::pi + parity * std::asin(s);
    hit.distance = (angle - p.angle_start) / seg.curvature;
  }
  hit.distance = std::clamp(hit.distance, 0.0, seg.length);
  return hit;
}

std::optional<std::pair<double, double>> ChainView::range(double w_min, double w_max) const {
  std::optional<std::pair<double, double>> all;
  for (const Interval& interval : intervals_) {
    if (interval.piece < 0 || interval.w_max < w_min || interval.w_min > w_max) continue;
    double low, high;
    pieces_[static_cast<std::size_t>(interval.piece)].graph.range(std::max(w_min, interval.w_min),
                                                                  std::min(w_max, interval.w_max), low, high);
    if (!all) all = {low, high};
    all->first = std::min(all->first, low);
    all->second = std::max(all->second, high);
  }
  return all;
}

}  // namespace treadmark::analytic
