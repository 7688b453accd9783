// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

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

/// The gap that most of the length of all lines do not exceed.
double usual_gap(const std::vector<std::size_t>& runs, double cell) {
  std::vector<std::size_t> sorted = runs;
  std::sort(sorted.begin(), sorted.end());
  double all = 0.0, sum = 0.0;
  for (const std::size_t r : sorted) all += static_cast<double>(r);
  for (const std::size_t r : sorted) {
    sum += static_cast<double>(r);
    if (sum >= kUsual * all) return cell * static_cast<double>(r);
  }
  return cell;
}

}  // namespace

Coverage find_coverage(const BandPoints& points, const Band& band, const CoverageSettings& settings) {
  Coverage out;
  const std::size_t rows = points.rows, columns = points.columns;
  std::vector<std::uint8_t> present(rows * columns, 0);
  for (std::size_t k = 0; k < present.size(); ++k)
    for (std::size_t i = points.begin[k]; i < points.begin[k + 1] && present[k] == 0; ++i)
      present[k] = points.state[i] == PointState::used || points.state[i] == PointState::held_out ? 1 : 0;

  // runs from one point to the next along rows and columns that have any
  std::vector<std::size_t> runs;
  for (std::size_t c = 0; c < columns; ++c) {
    std::size_t last = rows, first = rows;
    for (std::size_t r = 0; r < rows; ++r) {
      if (present[r * columns + c] == 0) continue;
      if (last < rows) runs.push_back(r - last);
      if (first == rows) first = r;
      last = r;
    }
    if (band.closed && last < rows && last != first) runs.push_back(first + rows - last);
  }
  out.gap_a = usual_gap(runs, points.cell_a);
  runs.clear();
  for (std::size_t r = 0; r < rows; ++r) {
    std::size_t last = columns;
    for (std::size_t c = 0; c < columns; ++c) {
      if (present[r * columns + c] == 0) continue;
      if (last < columns) runs.push_back(c - last);
      last = c;
    }
  }
  out.gap_s = usual_gap(runs, points.cell_s);
  constexpr double kLimit = 10e-3;
  out.limit = settings.hole_limit > 0.0 ? settings.hole_limit : std::max(kLimit, 2.0 * std::max(out.gap_a, out.gap_s));

  // squared distances to the nearest present cell; gaps up to the usual ones do not count as distance
  const double scale_a = out.gap_a > 2.0 * out.gap_s ? out.gap_s / out.gap_a : 1.0,
               scale_s = out.gap_s > 2.0 * out.gap_a ? out.gap_a / out.gap_s : 1.0;
  const std::size_t around = band.closed ? std::min<std::size_t>(rows, 256) : 0;
  const auto transform = [&](double step_a, double step_s) {
    std::vector<double> squares(rows * columns), line, result, z;
    std::vector<std::size_t> v;
    for (std::size_t r = 0; r < rows; ++r) {
      line.assign(columns, 0.0);
      for (std::size_t c = 0; c < columns; ++c) line[c] = present[r * columns + c] != 0 ? 0.0 : kNever;
      distances(line, step_s, v, z, result);
      std::copy(result.begin(), result.end(), squares.begin() + static_cast<std::ptrdiff_t>(r * columns));
    }
    for (std::size_t c = 0; c < columns; ++c) {
      line.resize(rows + 2 * around);
      for (std::size_t r = 0; r < line.size(); ++r) line[r] = squares[((r + rows - around) % rows) * columns + c];
      distances(line, step_a, v, z, result);
      for (std::size_t r = 0; r < rows; ++r) squares[r * columns + c] = result[r + around];
    }
    return squares;
  };
  const std::vector<double> square = transform(scale_a * points.cell_a, scale_s * points.cell_s);
  // how wide a hole is counts in true lengths
  const std::vector<double> unscaled =
      scale_a < 1.0 || scale_s < 1.0 ? transform(points.cell_a, points.cell_s) : std::vector<double>{};
  const std::vector<double>& width = unscaled.empty() ? square : unscaled;
  const double usual = std::min(out.gap_a, out.gap_s);
  const auto covered = [&](std::size_t cell) {
    return std::sqrt(square[cell]) <= 1.01 * std::max(usual, std::min(points.cell_a, points.cell_s));
  };

  // the usable width
  std::vector<double> part(columns, 0.0);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t r = 0; r < rows; ++r) part[c] += covered(r * columns + c) ? 1.0 : 0.0;
    part[c] /= static_cast<double>(rows);
  }
  out.first_column = 0;
  out.last_column = columns;
  while (out.first_column < columns && part[out.first_column] < settings.least_filled) ++out.first_column;
  while (out.last_column > out.first_column && part[out.last_column - 1] < settings.least_filled) --out.last_column;

  // random points cover far beyond their last ones: as much of the length has to have points in the next column at
  // least
  const auto block = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(out.gap_a / points.cell_a)));
  std::vector<std::size_t> lows, highs;
  for (std::size_t from = 0; from < rows; from += block) {
    lows.push_back(columns);
    highs.push_back(0);
    for (std::size_t cell = from * columns; cell < std::min(rows, from + block) * columns; ++cell) {
      if (present[cell] == 0) continue;
      lows.back() = std::min(lows.back(), cell % columns);
      highs.back() = std::max(highs.back(), cell % columns + 1);
    }
  }
  const auto reached = static_cast<std::ptrdiff_t>(settings.least_filled * static_cast<double>(lows.size() - 1));
  std::nth_element(lows.begin(), lows.begin() + reached, lows.end());
  std::nth_element(highs.begin(), highs.begin() + reached, highs.end(), std::greater<>());
  const std::size_t low = lows[static_cast<std::size_t>(reached)], high = highs[static_cast<std::size_t>(reached)];
  out.first_column = std::max(out.first_column, low - std::min<std::size_t>(low, 1));
  out.last_column = std::max(out.first_column, std::min(out.last_column, high + 1));

  // connected cells that are not covered
  std::vector<std::uint8_t> seen(rows * columns, 0);
  std::vector<std::size_t> stack, members;
  const double cell_area = points.cell_a * points.cell_s;
  out.area = cell_area * static_cast<double>(rows * (out.last_column - out.first_column));
  for (std::size_t start_row = 0; start_row < rows; ++start_row)
    for (std::size_t start_column = out.first_column; start_column < out.last_column; ++start_column) {
      const std::size_t start = start_row * columns + start_column;
      if (seen[start] != 0 || covered(start)) continue;
      Hole hole;
      double widest = -1.0;
      stack.assign(1, start);
      members.clear();
      seen[start] = 1;
      while (!stack.empty()) {
        const std::size_t cell = stack.back();
        stack.pop_back();
        members.push_back(cell);
        const std::size_t r = cell / columns, c = cell % columns;
        if (width[cell] > widest) {
          widest = width[cell];
          hole.a = points.cell_a * (static_cast<double>(r) + 0.5);
          hole.s = points.cell_s * (static_cast<double>(c) + 0.5);
        }
        for (int dr = -1; dr <= 1; ++dr)
          for (int dc = -1; dc <= 1; ++dc) {
            auto nr = static_cast<std::ptrdiff_t>(r) + dr;
            const auto nc = static_cast<std::ptrdiff_t>(c) + dc;
            if (nc < static_cast<std::ptrdiff_t>(out.first_column) ||
                nc >= static_cast<std::ptrdiff_t>(out.last_column))
              continue;
            if (nr < 0 || nr >= static_cast<std::ptrdiff_t>(rows)) {
              if (!band.closed) continue;
              nr = (nr + static_cast<std::ptrdiff_t>(rows)) % static_cast<std::ptrdiff_t>(rows);
            }
            const std::size_t next = static_cast<std::size_t>(nr) * columns + static_cast<std::size_t>(nc);
            if (seen[next] != 0 || covered(next)) continue;
            seen[next] = 1;
            stack.push_back(next);
          }
      }
      hole.diameter = 2.0 * std::sqrt(std::min(widest, 1e6));
      hole.area = cell_area * static_cast<double>(members.size());
      hole.filled = hole.diameter <= out.limit;
      out.hole_area += hole.area;
      out.holes.push_back(hole);
      if (hole.filled) continue;
      if (out.open.empty()) out.open.assign(rows * columns, 0);
      for (const std::size_t cell : members) out.open[cell] = 1;
    }
  std::stable_sort(out.holes.begin(), out.holes.end(),
                   [](const Hole& x, const Hole& y) { return x.diameter > y.diameter; });
  return out;
}

}  // namespace treadmark::scans
