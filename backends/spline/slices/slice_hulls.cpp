// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slices/slice_hulls.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark::spline {
namespace {

float greater(float bound, const NetPair& value) {
  // Rounded up; NaN (no surface) does not count.
  const double size = std::max(std::abs(value.y), std::abs(value.w));
  return size > static_cast<double>(bound) ? static_cast<float>(size * (1.0 + 1e-6)) : bound;
}

// Bounds of derivatives (u in its unit, v in cells), greatest of both fields.
struct Twist {
  float uuu = 0.0F, uuv = 0.0F, uuvv = 0.0F, uvv = 0.0F, uvvv = 0.0F, vv = 0.0F, vvv = 0.0F;
};

void widen(Twist& twist, const SliceNet& net, int span, int cell) {
  const double h = net.span_end(span) - net.span_start(span);
  // Bezier points along u of each line's value, first and second derivative.
  NetPair value[4][4], first[4][3], second[4][2];
  const int from = net.straight() ? 1 : 0, to = net.straight() ? 3 : 4;
  for (int k = from; k < to; ++k) {
    const SliceNet::LineCubic line = net.line(span, cell + k);
    const NetPair* p = line.power;
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
    twist.uuu = greater(twist.uuu, 6.0 * p[3]);
  }
  for (int k = from; k + 1 < to; ++k)
    for (int i = 0; i < 2; ++i) twist.uuv = greater(twist.uuv, second[k + 1][i] - second[k][i]);
  if (net.straight()) return;
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
  for (int i = 0; i < 2; ++i)
    for (const int k : {0, 1}) twist.uuvv = greater(twist.uuvv, bend(second, i, k));
}

// Least float interval about a range.
void round_outwards(const Interval& range, float& middle, float& half) {
  middle = static_cast<float>(0.5 * (range.low + range.high));
  const double exact = std::max(range.high - static_cast<double>(middle), static_cast<double>(middle) - range.low);
  half = std::nextafter(static_cast<float>(exact), std::numeric_limits<float>::infinity());
}

// The level above, whose boxes hold rows x columns of the one below.
SliceHulls::Level level_above(const SliceHulls::Level& below, int rows, int columns) {
  SliceHulls::Level level;
  level.rows = (below.rows + rows - 1) / rows;
  level.columns = (below.columns + columns - 1) / columns;
  level.rows_below = rows;
  level.columns_below = columns;
  for (int row = 0; row < level.rows; ++row) {
    const int first_row = row * rows, last_row = std::min(below.rows, first_row + rows);
    level.u.push_back(
        {below.u[static_cast<std::size_t>(first_row)].low, below.u[static_cast<std::size_t>(last_row) - 1].high});
    for (int column = 0; column < level.columns; ++column) {
      Interval y = Interval::none(), w = Interval::none();
      for (int r = first_row; r < last_row; ++r)
        for (int c = column * columns; c < std::min(below.columns, (column + 1) * columns); ++c)
          if (const HullBox& box = below.box(r, c); !box.empty()) {
            y.include(box.range_y());
            w.include(box.range_w());
          }
      level.boxes.push_back(y.empty() ? HullBox() : HullBox(y, w));
    }
  }
  return level;
}

}  // namespace

HullBox::HullBox(const Interval& range_y, const Interval& range_w) {
  round_outwards(range_y, y, half_y);
  round_outwards(range_w, w, half_w);
}

SliceHulls::SliceHulls(const SliceNet& net)
    : stride_((static_cast<std::size_t>(net.cells()) + 3) / 4 * 4 + 4), spans_(net.spans()) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  constexpr int kFewBoxes = 8;
  Level finest;
  finest.rows = (spans_ + kSpansPerGroup - 1) / kSpansPerGroup;
  finest.columns = net.cells();
  twist_.assign(static_cast<std::size_t>(finest.rows) * 7 * stride_, 0.0F);
  const auto rows = static_cast<std::size_t>(finest.rows), columns = static_cast<std::size_t>(finest.columns);
  finest.u.resize(rows);
  finest.boxes.resize(rows * columns);
  std::vector<std::array<Interval, 2>> reached(rows, {Interval::none(), Interval::none()});  // y, w
  constexpr std::size_t kRows = 8;                                                           // of a task
  parallel_blocks(rows, kRows, [&](std::size_t from, std::size_t to) {
    for (std::size_t row = from; row < to; ++row) {
      const int first = first_span(static_cast<int>(row)), end = first_span(static_cast<int>(row) + 1);
      Interval& u = finest.u[row] = {net.span_start(first), net.span_end(end - 1)};
      if (!net.closed() && first == 0) u.low = -kInfinite;
      if (!net.closed() && end == spans_) u.high = kInfinite;
      for (std::size_t column = 0; column < columns; ++column) {
        const auto cell = static_cast<int>(column);
        Interval y = Interval::none(), w = Interval::none();
        Twist twist;
        for (int span = first; span < end; ++span) {
          widen(twist, net, span, cell);
          Interval part_y, part_w;
          if (!net.hull(span, cell, net.span_start(span), net.span_end(span), part_y, part_w)) continue;
          y.include(part_y);
          w.include(part_w);
        }
        const float bounds[7] = {twist.uuu, twist.uuv, twist.uuvv, twist.uvv, twist.uvvv, twist.vvv, twist.vv};
        for (std::size_t i = 0; i < 7; ++i) twist_[(row * 7 + i) * stride_ + column] = bounds[i];
        finest.boxes[row * columns + column] = y.empty() ? HullBox() : HullBox(y, w);
        reached[row][0].include(y);
        reached[row][1].include(w);
      }
    }
  });
  for (const auto& [y, w] : reached) {
    all_y_.include(y);
    all_w_.include(w);
  }
  levels_.push_back(std::move(finest));
  levels_.push_back(level_above(levels_.back(), 1, 8));
  while (levels_.back().rows * levels_.back().columns > kFewBoxes) levels_.push_back(level_above(levels_.back(), 4, 4));
  if (!empty()) all_ = HullBox(all_y_, all_w_);
}

std::size_t SliceHulls::memory_bytes() const {
  std::size_t bytes = twist_.size() * sizeof(float);
  for (const Level& level : levels_) bytes += level.boxes.size() * sizeof(HullBox) + level.u.size() * sizeof(Interval);
  return bytes;
}

}  // namespace treadmark::spline
