// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slice_hulls.hpp"

#include <cmath>
#include <limits>

namespace treadmark::spline {
namespace {

float greater(float bound, const NetPair& value) {
  // Rounded up; NaN (no surface) does not count.
  const double size = std::max(std::abs(value.y), std::abs(value.w));
  return size > static_cast<double>(bound) ? static_cast<float>(size * (1.0 + 1e-6)) : bound;
}

void widen(SliceHulls::Twist& twist, const SliceNet& net, int span, int cell) {
  const double h = net.span_end(span) - net.span_start(span);
  // Bezier points along u of each line's value, first and second derivative.
  NetPair value[4][4], first[4][3], second[4][2];
  for (int k = 0; k < 4; ++k) {
    const NetPair* p = net.line(span, cell + k).power;
    const NetPair c1 = h * p[1], c2 = (h * h) * p[2], c3 = (h * h * h) * p[3];
    value[k][0] = p[0];
    value[k][1] = p[0] + (1.0 / 3.0) * c1;
    value[k][2] = p[0] + (1.0 / 3.0) * (2.0 * c1 + c2);
    value[k][3] = p[0] + c1 + c2 + c3;
    first[k][0] = p[1];
    first[k][1] = p[1] + h * p[2];
    first[k][2] = p[1] + h * (2.0 * p[2] + (3.0 * h) * p[3]);
    second[k][0] = 2.0 * p[2];
    second[k][1] = 2.0 * p[2] + (6.0 * h) * p[3];
  }
  // Differences across the lines are the derivatives in v of uniform B-splines.
  const auto third = [](const auto& l, int i) { return (l[3][i] - l[0][i]) + 3.0 * (l[1][i] - l[2][i]); };
  const auto bend = [](const auto& l, int i, int k) { return (l[k][i] - l[k + 1][i]) + (l[k + 2][i] - l[k + 1][i]); };
  for (int i = 0; i < 4; ++i) {
    twist.vvv = greater(twist.vvv, third(value, i));
    for (const int k : {0, 1}) twist.vv = greater(twist.vv, bend(value, i, k));
  }
  for (int i = 0; i < 3; ++i) {
    twist.uvvv = greater(twist.uvvv, third(first, i));
    for (const int k : {0, 1}) twist.uvv = greater(twist.uvv, bend(first, i, k));
  }
  for (int i = 0; i < 2; ++i) {
    for (const int k : {0, 1}) twist.uuvv = greater(twist.uuvv, bend(second, i, k));
    for (const int k : {0, 1, 2}) twist.uuv = greater(twist.uuv, second[k + 1][i] - second[k][i]);
  }
  for (int k = 0; k < 4; ++k) twist.uuu = greater(twist.uuu, 6.0 * net.line(span, cell + k).power[3]);
}

}  // namespace

SliceHulls::SliceHulls(const SliceNet& net)
    : cells_(static_cast<std::size_t>(net.cells())), coarse_per_group_((cells_ + kCellsPerGroup - 1) / kCellsPerGroup),
      spans_(net.spans()) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto spans = static_cast<std::size_t>(net.spans());
  for (std::size_t first = 0; first < spans; first += kSpansPerGroup) {
    const std::size_t end = std::min(spans, first + kSpansPerGroup);
    Interval u{net.span_start(static_cast<int>(first)), net.span_end(static_cast<int>(end) - 1)};
    if (!net.closed() && first == 0) u.low = -kInfinite;
    if (!net.closed() && end == spans) u.high = kInfinite;
    u_.push_back(u);
    const std::size_t group = coarse_.size();
    coarse_.resize(group + coarse_per_group_);
    for (std::size_t cell = 0; cell < cells_; ++cell) {
      Box box;
      Twist& twist = twist_.emplace_back();
      for (std::size_t span = first; span < end; ++span) {
        widen(twist, net, static_cast<int>(span), static_cast<int>(cell));
        Box part;
        if (net.hull(static_cast<int>(span), static_cast<int>(cell), net.span_start(static_cast<int>(span)),
                     net.span_end(static_cast<int>(span)), part.y, part.w)) box.include(part);
      }
      fine_.push_back(box);
      coarse_[group + cell / kCellsPerGroup].include(box);
      all_.include(box);
    }
  }
}

}  // namespace treadmark::spline
