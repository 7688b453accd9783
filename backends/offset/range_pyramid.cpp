// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/range_pyramid.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "treadmark/core/check_point.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::offset {

namespace {

constexpr int kCell = 8;

bool is_zero(float low, float high, float step_u, float step_y) {
  return low == 0.0f && high == 0.0f && step_u == 0.0f && step_y == 0.0f;
}

template <class Cell>
void merge(Cell& sum, const Cell& other) {
  sum.low = std::min(sum.low, other.low);
  sum.high = std::max(sum.high, other.high);
  sum.step_u = std::max(sum.step_u, other.step_u);
  sum.step_y = std::max(sum.step_y, other.step_y);
}

}  // namespace

RangePyramid::RangePyramid(const SheetGrid& coefficients, const BlockDirectory& blocks, const SheetFrame& frame,
                           int degree)
    : blocks_(blocks), frame_(frame), before_(degree == 1 ? 0 : 1), behind_(degree == 1 ? 1 : 2) {
  // Cells of the blocks and their neighbours, whose points reach over.
  std::vector<std::pair<std::int32_t, std::int32_t>> keys;
  for (const SheetGrid::Entry& b : coefficients.blocks())
    for (int di = -1; di <= 1; ++di)
      for (int cj = 8 * b.key.bj - 1; cj <= 8 * b.key.bj + 8; ++cj) {
        int ci = b.key.bi + di;
        if (frame_.turn > 0 && (ci < 0 || ci * kCell >= frame_.turn)) ci = ci < 0 ? (frame_.turn - 1) / kCell : 0;
        keys.emplace_back(ci, cj);
      }
  if (frame_.turn > 0)  // the last cell may be a small one, so that its neighbour sees the first voxels too
    for (const SheetGrid::Entry& b : coefficients.blocks())
      if (b.key.bi == 0)
        for (int cj = 8 * b.key.bj - 1; cj <= 8 * b.key.bj + 8; ++cj)
          keys.emplace_back(std::max(0, (frame_.turn - 1) / kCell - 1), cj);
  sort_many(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

  std::vector<Cell> cells(keys.size());
  constexpr std::size_t kChunk = 256;
  parallel_for((keys.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t k = chunk * kChunk; k < std::min(keys.size(), (chunk + 1) * kChunk); ++k)
      cells[k] = summary(keys[k].first, keys[k].second, kCell, kCell, keys[k].first * kCell, keys[k].second * kCell);
  });
  std::erase_if(cells, [](const Cell& c) { return is_zero(c.low, c.high, c.step_u, c.step_y); });
  cells.shrink_to_fit();
  levels_.push_back(std::move(cells));
  constexpr std::size_t kTop = 8, kMostLevels = 28;
  while (levels_.back().size() > kTop && levels_.size() < kMostLevels) {
    std::vector<Cell> above = levels_.back();
    for (Cell& c : above) c.ci >>= 1, c.cj >>= 1;
    sort_many(above, [](const Cell& a, const Cell& b) { return std::tie(a.ci, a.cj) < std::tie(b.ci, b.cj); });
    std::size_t n = 0;
    for (const Cell& c : above) {
      if (n > 0 && above[n - 1].ci == c.ci && above[n - 1].cj == c.cj)
        merge(above[n - 1], c);
      else
        above[n++] = c;
    }
    above.resize(n);
    above.shrink_to_fit();
    levels_.push_back(std::move(above));
  }
}

/// Over the points whose voxels, rounded down, are i_first .. i_first + i_count - 1, and likewise j.
RangePyramid::Cell RangePyramid::summary(std::int32_t ci, std::int32_t cj, int i_count, int j_count, int i_first,
                                         int j_first) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr int kWidest = 2 * kCell + 8;
  Cell sum{ci, cj, kInfinity, -kInfinity, 0.0f, 0.0f};
  float before[kWidest] = {};
  const int j_last = j_count + behind_;
  for (int i = -before_; i < i_count + behind_; ++i) {
    const int row = frame_.wrapped(i_first + i);
    float left = 0.0f;
    for (int j = -before_; j < j_last; ++j) {
      const float c = blocks_.value(row, j_first + j);
      float& above = before[j + before_];
      sum.low = std::min(sum.low, c);
      sum.high = std::max(sum.high, c);
      if (i > -before_) sum.step_u = std::max(sum.step_u, std::fabs(c - above));
      if (j > -before_) sum.step_y = std::max(sum.step_y, std::fabs(c - left));
      above = left = c;
    }
  }
  return sum;
}

displacement::OffsetRange RangePyramid::range(const Rectangle& uy) const {
  constexpr double kRounding = 1e-7;  // [voxels]
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (levels_.front().empty()) return {};
  Cell sum{0, 0, kInfinity, -kInfinity, 0.0f, 0.0f};
  Box box{(uy.x_min - frame_.u0) / frame_.du - kRounding, (uy.x_max - frame_.u0) / frame_.du + kRounding,
          frame_.across(uy.y_min) - kRounding, frame_.across(uy.y_max) + kRounding};
  if (frame_.body == Body::rail) {
    include(box, sum);
  } else {
    const double low = frame_.branch_begin(), period = frame_.period(), width = box.i_high - box.i_low;
    if (!(width < period)) {
      box.i_low = low, box.i_high = low + period - kRounding;
      include(box, sum);
    } else {
      box.i_low = frame_.along(uy.x_min) - kRounding;
      box.i_high = box.i_low + width;
      for (const double turn :
           {-period, 0.0, period}) {  // what lies beyond the branch comes in again on the other side
        const Box part{std::max(low, box.i_low + turn), std::min(low + period - kRounding, box.i_high + turn),
                       box.j_low, box.j_high};
        if (part.i_low <= part.i_high) include(part, sum);
      }
    }
  }
  if (!(sum.low <= sum.high)) return {};
  // Rounding of the convex combinations, and of differences of single precision numbers.
  const double slack = 1e-14 * std::max(std::fabs(sum.low), std::fabs(sum.high)), up = 1.0 + 1e-6;
  return {sum.low - slack, sum.high + slack, up * sum.step_u / frame_.du, up * sum.step_y / frame_.dy};
}

void RangePyramid::include(const Box& given, Cell& sum) const {
  constexpr double kFar = 1 << 30;
  const Box box{std::clamp(given.i_low, -kFar, kFar), std::clamp(given.i_high, -kFar, kFar),
                std::clamp(given.j_low, -kFar, kFar), std::clamp(given.j_high, -kFar, kFar)};
  const double size = std::max(box.i_high - box.i_low, box.j_high - box.j_low);
  const auto down = [](double x) { return to_whole<int>(std::floor(x)); };
  if (size <= kCell) {
    // few voxels: exactly these, unless there are none in their cells
    Cell around{};
    include_level(box, 0, around);
    const int i = down(box.i_low), j = down(box.j_low);
    merge(sum, is_zero(around.low, around.high, around.step_u, around.step_y)
                   ? Cell{}
                   : summary(0, 0, down(box.i_high) - i + 1, down(box.j_high) - j + 1, i, j));
    return;
  }
  std::size_t level = 0;
  while (level + 1 < levels_.size() && size > 8.0 * std::ldexp(kCell, static_cast<int>(level))) ++level;
  include_level(box, level, sum);
}

void RangePyramid::include_level(const Box& box, std::size_t level, Cell& sum) const {
  const double cell = std::ldexp(kCell, static_cast<int>(level));
  const auto index = [cell](double x) { return to_whole<std::int32_t>(std::floor(x / cell)); };
  const std::int32_t ci0 = index(box.i_low), ci1 = index(box.i_high), cj0 = index(box.j_low), cj1 = index(box.j_high);
  const std::vector<Cell>& cells = levels_[level];
  const auto seek = [&](auto from, std::int32_t ci, std::int32_t cj) {
    return std::lower_bound(from, cells.end(), std::pair(ci, cj), [](const Cell& c, const auto& key) {
      return std::tie(c.ci, c.cj) < std::tie(key.first, key.second);
    });
  };
  std::int64_t missing = (static_cast<std::int64_t>(ci1) - ci0 + 1) * (static_cast<std::int64_t>(cj1) - cj0 + 1);
  auto c = seek(cells.begin(), ci0, cj0);
  while (c != cells.end() && c->ci <= ci1) {
    if (c->cj < cj0) {
      c = seek(c, c->ci, cj0);
    } else if (c->cj > cj1) {
      c = seek(c, c->ci + 1, cj0);
    } else {
      merge(sum, *c);
      ++c;
      --missing;
    }
  }
  if (missing > 0) merge(sum, Cell{});  // zeros are not stored
}

std::size_t RangePyramid::memory_bytes() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += level.capacity() * sizeof(Cell);
  return sum;
}

}  // namespace treadmark::offset
