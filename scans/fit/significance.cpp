// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark::scans {
namespace {

constexpr double kFewestPoints = 1.5;  // sum of a function over the points: fewer cannot hold it

struct Window {
  std::size_t along, across;  // half widths
};
constexpr std::array<Window, 7> kWindows{{{0, 0}, {1, 1}, {7, 0}, {0, 7}, {4, 1}, {1, 4}, {7, 7}}};
constexpr double kRare = 3.0;        // a level picks out noise in less than about one of exp(3) cases
constexpr double kWorthwhile = 4.0;  // square that a function amid others needs itself

/// A sum of squares of n normal numbers exceeds this with a probability below exp(-x) (Laurent and Massart 2000).
double bound(double n, double x) { return n + 2.0 * std::sqrt(n * x) + 2.0 * x; }

struct Shape {
  std::size_t rows, columns;
  bool closed;  ///< rows wrap round
};

/// Sums over windows round the places of rows [from, to).
std::vector<double> box_sums(const std::vector<double>& values, const Shape& grid, const Window& w, std::size_t from,
                             std::size_t to) {
  const auto [rows, columns, closed] = grid;
  const std::size_t half = closed ? std::min(w.along, (rows - 1) / 2) : w.along, count = to - from;
  std::vector<double> across((count + 2 * half) * columns, 0.0), out(count * columns, 0.0);
  for (std::size_t k = 0; k < count + 2 * half; ++k) {
    if (!closed && (from + k < half || from + k - half >= rows)) continue;
    const double* in = values.data() + (from + k + rows - half) % rows * columns;
    double sum = 0.0;
    for (std::size_t c = 0; c < std::min(columns, w.across); ++c) sum += in[c];
    for (std::size_t c = 0; c < columns; ++c) {
      if (c + w.across < columns) sum += in[c + w.across];
      if (c > w.across) sum -= in[c - w.across - 1];
      across[k * columns + c] = sum;
    }
  }
  // anew for every row: differences of running sums would lose what is small beside what is large
  for (std::size_t r = 0; r < count; ++r)
    for (std::size_t k = r; k <= r + 2 * half; ++k)
      for (std::size_t c = 0; c < columns; ++c) out[r * columns + c] += across[k * columns + c];
  return out;
}

}  // namespace

std::size_t choose_functions(const FunctionSums& sums, double factor, SplineLevel& level, std::vector<float>& ridge,
                             std::size_t of) {
  const std::size_t rows = level.functions_a(), columns = level.functions_s();
  const Shape grid{rows, columns, level.closed};
  constexpr std::size_t kRows = 64, kAlone = 4096;  // of a task
  std::vector<double> square(level.size(), 0.0), present(level.size(), 0.0), excess(level.size(), 0.0);
  parallel_blocks(level.size(), kAlone, [&](std::size_t from, std::size_t to) {
    for (std::size_t f = from; f < to; ++f) {
      if (!(sums.wbb[f] > 0.0) || sums.points[f] < kFewestPoints) continue;
      // one wild value must not light up its whole window
      constexpr double kMost = 1e4;
      square[f] = std::min(sums.wbr[f] * sums.wbr[f] / sums.wbb[f], kMost);
      present[f] = 1.0;
      excess[f] = std::max(square[f] - 1.0, 0.0);
    }
  });
  std::vector<std::uint8_t> chosen(level.size(), 0);
  ridge.assign(level.size(), 0.0f);
  const double f2 = factor * factor, rare = std::log(static_cast<double>(of > 0 ? of : level.size())) + kRare;
  parallel_blocks(rows, kRows, [&](std::size_t from, std::size_t to) {
    const std::size_t first = from * columns, last = to * columns;
    for (const Window& w : kWindows) {
      const std::vector<double> sum = box_sums(square, grid, w, from, to), count = box_sums(present, grid, w, from, to);
      for (std::size_t f = first; f < last; ++f) {
        if (present[f] == 0.0) continue;
        // neighbouring functions overlap, so that their squares rise together: as if there were a quarter of them, four
        // times each
        constexpr double kTogether = 4.0;
        const double alike = std::min(kTogether, count[f - first]), independent = count[f - first] / alike;
        if (sum[f - first] > f2 * alike * bound(independent, rare) && square[f] > f2 * kWorthwhile) chosen[f] = 1;
      }
    }
    // variance of coefficients around a function: what the squares have beyond 1, in units of the functions that are
    // well seen
    constexpr Window kAround{2, 2};
    constexpr double kLenient = 0.5;  // overlapping functions need larger coefficients than each alone
    const std::vector<double> signal = box_sums(excess, grid, kAround, from, to),
                              seen = box_sums(sums.wbb, grid, kAround, from, to),
                              number_around = box_sums(present, grid, kAround, from, to);
    for (std::size_t f = 0; f < last - first; ++f)
      ridge[first + f] =
          static_cast<float>(kLenient * seen[f] / std::max(signal[f], 0.5 * std::max(number_around[f], 1.0)));
  });
  // on by one function to every side
  level.active.assign(level.size(), 0);
  const auto shown = [&](std::size_t r, std::size_t c) {
    for (std::ptrdiff_t dr = -1; dr <= 1; ++dr)
      for (std::ptrdiff_t dc = -1; dc <= 1; ++dc) {
        auto rr = static_cast<std::ptrdiff_t>(r) + dr;
        const auto cc = static_cast<std::ptrdiff_t>(c) + dc;
        if (cc < 0 || cc >= static_cast<std::ptrdiff_t>(columns)) continue;
        if (rr < 0 || rr >= static_cast<std::ptrdiff_t>(rows)) {
          if (!level.closed) continue;
          rr = (rr + static_cast<std::ptrdiff_t>(rows)) % static_cast<std::ptrdiff_t>(rows);
        }
        if (chosen[static_cast<std::size_t>(rr) * columns + static_cast<std::size_t>(cc)] != 0) return true;
      }
    return false;
  };
  std::vector<std::size_t> number((rows + kRows - 1) / kRows, 0);
  parallel_blocks(rows, kRows, [&](std::size_t from, std::size_t to) {
    for (std::size_t r = from; r < to; ++r)
      for (std::size_t c = 0; c < columns; ++c) {
        if (present[r * columns + c] == 0.0 || !shown(r, c)) continue;
        level.active[r * columns + c] = 1;
        ++number[from / kRows];
      }
  });
  return std::accumulate(number.begin(), number.end(), std::size_t{0});
}

}  // namespace treadmark::scans
