// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Sums over windows of a grid; rows wrap round if closed.
std::vector<double> box_sums(const std::vector<double>& values, std::size_t rows, std::size_t columns, const Window& w,
                             bool closed) {
  std::vector<double> across(values.size()), out(values.size());
  for (std::size_t r = 0; r < rows; ++r) {
    const double* in = values.data() + r * columns;
    double sum = 0.0;
    for (std::size_t c = 0; c < std::min(columns, w.across); ++c) sum += in[c];
    for (std::size_t c = 0; c < columns; ++c) {
      if (c + w.across < columns) sum += in[c + w.across];
      if (c > w.across) sum -= in[c - w.across - 1];
      across[r * columns + c] = sum;
    }
  }
  const std::size_t half = closed ? std::min(w.along, (rows - 1) / 2) : w.along;
  for (std::size_t c = 0; c < columns; ++c) {
    // anew for every row: differences of running sums would lose what is small beside what is large
    for (std::size_t r = 0; r < rows; ++r) {
      double sum = 0.0;
      if (closed) {
        for (std::size_t k = 0; k <= 2 * half; ++k) sum += across[((r + rows + k - half) % rows) * columns + c];
      } else {
        for (std::size_t k = r > half ? r - half : 0; k <= std::min(rows - 1, r + half); ++k)
          sum += across[k * columns + c];
      }
      out[r * columns + c] = sum;
    }
  }
  return out;
}

}  // namespace

std::size_t choose_functions(const FunctionSums& sums, double factor, SplineLevel& level, std::vector<float>& ridge) {
  const std::size_t rows = level.functions_a(), columns = level.functions_s();
  std::vector<double> square(level.size(), 0.0), present(level.size(), 0.0);
  for (std::size_t f = 0; f < level.size(); ++f) {
    if (!(sums.wbb[f] > 0.0) || sums.points[f] < kFewestPoints) continue;
    // one wild value must not light up its whole window
    constexpr double kMost = 1e4;
    square[f] = std::min(sums.wbr[f] * sums.wbr[f] / sums.wbb[f], kMost);
    present[f] = 1.0;
  }
  std::vector<std::uint8_t> chosen(level.size(), 0);
  const double f2 = factor * factor, rare = std::log(static_cast<double>(level.size())) + kRare;
  for (const Window& w : kWindows) {
    const std::vector<double> sum = box_sums(square, rows, columns, w, level.closed),
                              count = box_sums(present, rows, columns, w, level.closed);
    for (std::size_t f = 0; f < level.size(); ++f) {
      if (present[f] == 0.0) continue;
      // neighbouring functions overlap, so that their squares rise together: as if there were a quarter of them, four
      // times each
      constexpr double kTogether = 4.0;
      const double alike = std::min(kTogether, count[f]), independent = count[f] / alike;
      if (sum[f] > f2 * alike * bound(independent, rare) && square[f] > f2 * kWorthwhile) chosen[f] = 1;
    }
  }
  // variance of coefficients around a function: what the squares have beyond 1, in units of the functions that are well
  // seen
  std::vector<double> excess(level.size(), 0.0);
  for (std::size_t f = 0; f < level.size(); ++f)
    if (present[f] > 0.0) excess[f] = std::max(square[f] - 1.0, 0.0);
  constexpr Window kAround{2, 2};
  constexpr double kLenient = 0.5;  // overlapping functions need larger coefficients than each alone
  const std::vector<double> signal = box_sums(excess, rows, columns, kAround, level.closed),
                            seen = box_sums(sums.wbb, rows, columns, kAround, level.closed);
  const std::vector<double> number_around = box_sums(present, rows, columns, kAround, level.closed);
  ridge.assign(level.size(), 0.0f);
  for (std::size_t f = 0; f < level.size(); ++f)
    ridge[f] = static_cast<float>(kLenient * seen[f] / std::max(signal[f], 0.5 * std::max(number_around[f], 1.0)));
  // on by one function to every side
  level.active.assign(level.size(), 0);
  std::size_t number = 0;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t f = r * columns + c;
      if (present[f] == 0.0) continue;
      bool near = false;
      for (std::ptrdiff_t dr = -1; dr <= 1 && !near; ++dr)
        for (std::ptrdiff_t dc = -1; dc <= 1 && !near; ++dc) {
          auto rr = static_cast<std::ptrdiff_t>(r) + dr;
          const auto cc = static_cast<std::ptrdiff_t>(c) + dc;
          if (cc < 0 || cc >= static_cast<std::ptrdiff_t>(columns)) continue;
          if (rr < 0 || rr >= static_cast<std::ptrdiff_t>(rows)) {
            if (!level.closed) continue;
            rr = (rr + static_cast<std::ptrdiff_t>(rows)) % static_cast<std::ptrdiff_t>(rows);
          }
          near = chosen[static_cast<std::size_t>(rr) * columns + static_cast<std::size_t>(cc)] != 0;
        }
      if (!near) continue;
      level.active[f] = 1;
      ++number;
    }
  return number;
}

}  // namespace treadmark::scans
