// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr double kNever = 1e15;
constexpr double kUsual = 0.8;  // part of the length; the rest may be holes

/// Squared distances along one line of cells: min over q of f(q) + (step (p - q))^2, by the lower envelope of parabolas
/// (Felzenszwalb and Huttenlocher 2012).
void distances(std::vector<double>& f, double step, std::vector<std::size_t>& v, std::vector<double>& z,
               std::vector<double>& out) {
  const std::size_t n = f.size();
  v.assign(n, 0);
  z.assign(n + 1, 0.0);
  out.resize(n);
  std::size_t k = 0;
  z[0] = -1e30;
  z[1] = 1e30;
  const double square = step * step;
  const auto at = [](std::size_t i) { return static_cast<double>(i); };
  for (std::size_t q = 1; q < n; ++q) {
    double cross = 0.0;
    for (;;) {
      cross = ((f[q] / square + at(q) * at(q)) - (f[v[k]] / square + at(v[k]) * at(v[k]))) / (2.0 * (at(q) - at(v[k])));
      if (cross > z[k] || k == 0) break;
      --k;
    }
    if (cross <= z[k]) {
      v[k] = q;
    } else {
      ++k;
      v[k] = q;
      z[k] = cross;
    }
    z[k + 1] = 1e30;
  }
  k = 0;
  for (std::size_t q = 0; q < n; ++q) {
    while (z[k + 1] < at(q)) ++k;
    const double apart = at(q) - at(v[k]);
    out[q] = square * apart * apart + f[v[k]];
  }
}

class CoverageSearch {
 public:
  CoverageSearch(const BandPoints& points, const Band& band, const CoverageSettings& settings)
      : points_(points), band_(band), settings_(settings), rows_(points.rows), columns_(points.columns) {
    present_.assign(rows_ * columns_, 0);
    for (std::size_t k = 0; k < present_.size(); ++k)
      for (std::size_t i = points.begin[k]; i < points.begin[k + 1] && present_[k] == 0; ++i)
        present_[k] = is_of_surface(points.state[i]) ? 1 : 0;
  }

  Coverage found() {
    if (const Coverage* usual = settings_.usual; usual != nullptr) {
      out_.gap_a = usual->gap_a, out_.gap_s = usual->gap_s;
      out_.limit = usual->limit;
      out_.first_column = usual->first_column, out_.last_column = usual->last_column;
      find_distances();
    } else {
      out_.gap_a = points_.cell_a * usual_gap(true);
      out_.gap_s = points_.cell_s * usual_gap(false);
      constexpr double kLimit = 10e-3;
      out_.limit =
          settings_.hole_limit > 0.0 ? settings_.hole_limit : std::max(kLimit, 2.0 * std::max(out_.gap_a, out_.gap_s));
      find_distances();
      find_usable_width();
      leave_out_seldom_reached();
    }
    find_holes();
    return std::move(out_);
  }

 private:
  /// In cells, from one point to the next along (or across) lines that have any: the gap that most of their length does
  /// not exceed.
  double usual_gap(bool along) const {
    const std::size_t lines = along ? columns_ : rows_, cells = along ? rows_ : columns_;
    std::vector<std::size_t> runs;
    for (std::size_t line = 0; line < lines; ++line) {
      std::size_t last = cells, first = cells;
      for (std::size_t k = 0; k < cells; ++k) {
        if (present_[along ? k * columns_ + line : line * columns_ + k] == 0) continue;
        if (last < cells) runs.push_back(k - last);
        if (first == cells) first = k;
        last = k;
      }
      if (along && band_.closed && last < cells && last != first) runs.push_back(first + cells - last);
    }
    std::sort(runs.begin(), runs.end());
    double all = 0.0, sum = 0.0;
    for (const std::size_t r : runs) all += static_cast<double>(r);
    for (const std::size_t r : runs) {
      sum += static_cast<double>(r);
      if (sum >= kUsual * all) return static_cast<double>(r);
    }
    return 1.0;
  }

  /// Squared distances of all cells to the nearest present one.
  std::vector<double> squares(double step_a, double step_s) const {
    std::vector<double> out(rows_ * columns_), line, result, z;
    std::vector<std::size_t> v;
    for (std::size_t r = 0; r < rows_; ++r) {
      line.assign(columns_, 0.0);
      for (std::size_t c = 0; c < columns_; ++c) line[c] = present_[r * columns_ + c] != 0 ? 0.0 : kNever;
      distances(line, step_s, v, z, result);
      std::copy(result.begin(), result.end(), out.begin() + static_cast<std::ptrdiff_t>(r * columns_));
    }
    const std::size_t around = band_.closed ? std::min<std::size_t>(rows_, 256) : 0;
    for (std::size_t c = 0; c < columns_; ++c) {
      line.resize(rows_ + 2 * around);
      for (std::size_t r = 0; r < line.size(); ++r) line[r] = out[((r + rows_ - around) % rows_) * columns_ + c];
      distances(line, step_a, v, z, result);
      for (std::size_t r = 0; r < rows_; ++r) out[r * columns_ + c] = result[r + around];
    }
    return out;
  }

  /// Gaps up to the usual ones do not count as distance; how wide a hole is counts in true lengths.
  void find_distances() {
    const double scale_a = out_.gap_a > 2.0 * out_.gap_s ? out_.gap_s / out_.gap_a : 1.0,
                 scale_s = out_.gap_s > 2.0 * out_.gap_a ? out_.gap_a / out_.gap_s : 1.0;
    square_ = squares(scale_a * points_.cell_a, scale_s * points_.cell_s);
    width_ = scale_a < 1.0 || scale_s < 1.0 ? squares(points_.cell_a, points_.cell_s) : square_;
    reach_ = 1.01 * std::max(std::min(out_.gap_a, out_.gap_s), std::min(points_.cell_a, points_.cell_s));
  }

  bool covered(std::size_t cell) const { return std::sqrt(square_[cell]) <= reach_; }

  void find_usable_width() {
    std::vector<double> part(columns_, 0.0);
    for (std::size_t c = 0; c < columns_; ++c) {
      for (std::size_t r = 0; r < rows_; ++r) part[c] += covered(r * columns_ + c) ? 1.0 : 0.0;
      part[c] /= static_cast<double>(rows_);
    }
    std::size_t &first = out_.first_column, &last = out_.last_column;
    last = columns_;
    while (first < columns_ && part[first] < settings_.least_filled) ++first;
    while (last > first && part[last - 1] < settings_.least_filled) --last;
  }

  /// Random points cover far beyond their last ones: as much of the length has to have points in the next column at
  /// least.
  void leave_out_seldom_reached() {
    const auto block = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(out_.gap_a / points_.cell_a)));
    std::vector<std::size_t> lows, highs;
    for (std::size_t from = 0; from < rows_; from += block) {
      lows.push_back(columns_);
      highs.push_back(0);
      for (std::size_t cell = from * columns_; cell < std::min(rows_, from + block) * columns_; ++cell) {
        if (present_[cell] == 0) continue;
        lows.back() = std::min(lows.back(), cell % columns_);
        highs.back() = std::max(highs.back(), cell % columns_ + 1);
      }
    }
    const auto reached = to_whole<std::ptrdiff_t>(settings_.least_filled * static_cast<double>(lows.size() - 1));
    std::nth_element(lows.begin(), lows.begin() + reached, lows.end());
    std::nth_element(highs.begin(), highs.begin() + reached, highs.end(), std::greater<>());
    const std::size_t low = lows[static_cast<std::size_t>(reached)], high = highs[static_cast<std::size_t>(reached)];
    out_.first_column = std::max(out_.first_column, low - std::min<std::size_t>(low, 1));
    out_.last_column = std::max(out_.first_column, std::min(out_.last_column, high + 1));
  }

  /// Holes are connected cells that are not covered.
  void find_holes() {
    const double cell_area = points_.cell_a * points_.cell_s;
    out_.area = cell_area * static_cast<double>(rows_ * (out_.last_column - out_.first_column));
    seen_.assign(rows_ * columns_, 0);
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = out_.first_column; column < out_.last_column; ++column) {
        const std::size_t start = row * columns_ + column;
        if (seen_[start] != 0 || covered(start)) continue;
        const std::vector<std::size_t> members = connected(start);
        const std::size_t widest = *ranges::max_element(members, {}, [&](std::size_t k) { return width_[k]; });
        Hole hole;
        hole.a = points_.cell_a * (static_cast<double>(widest / columns_) + 0.5);
        hole.s = points_.cell_s * (static_cast<double>(widest % columns_) + 0.5);
        hole.diameter = 2.0 * std::sqrt(std::min(width_[widest], 1e6));
        hole.area = cell_area * static_cast<double>(members.size());
        hole.filled = hole.diameter <= out_.limit;
        out_.hole_area += hole.area;
        out_.holes.push_back(hole);
        if (hole.filled) continue;
        if (out_.open.empty()) out_.open.assign(rows_ * columns_, 0);
        for (const std::size_t cell : members) out_.open[cell] = 1;
      }
    std::stable_sort(out_.holes.begin(), out_.holes.end(),
                     [](const Hole& x, const Hole& y) { return x.diameter > y.diameter; });
  }

  std::vector<std::size_t> connected(std::size_t start) {
    std::vector<std::size_t> stack{start}, members;
    seen_[start] = 1;
    while (!stack.empty()) {
      const std::size_t cell = stack.back(), r = cell / columns_, c = cell % columns_;
      stack.pop_back();
      members.push_back(cell);
      for (std::size_t up = 0; up < 3; ++up) {
        if (!band_.closed && (r + up < 1 || r + up > rows_)) continue;
        const std::size_t row = (r + rows_ + up - 1) % rows_, end = std::min(out_.last_column, c + 2);
        for (std::size_t column = c > out_.first_column ? c - 1 : c; column < end; ++column) {
          const std::size_t next = row * columns_ + column;
          if (seen_[next] != 0 || covered(next)) continue;
          seen_[next] = 1;
          stack.push_back(next);
        }
      }
    }
    return members;
  }

  const BandPoints& points_;
  const Band& band_;
  const CoverageSettings& settings_;
  std::size_t rows_, columns_;
  std::vector<std::uint8_t> present_, seen_;
  std::vector<double> square_, width_;
  double reach_ = 0.0;  ///< distance up to which a cell is covered
  Coverage out_;
};

}  // namespace

Coverage find_coverage(const BandPoints& points, const Band& band, const CoverageSettings& settings) {
  return CoverageSearch(points, band, settings).found();
}

}  // namespace treadmark::scans
