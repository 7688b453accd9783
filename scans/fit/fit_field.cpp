// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/fit_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/scans/fit/level_fit.hpp"
#include "treadmark/scans/fit/significance.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kFewestHeldOut = 200;

struct Size {
  std::size_t halvings_a, halvings_s;
};

/// Correlation of the residuals of points next to each other (in blocks of 2 x 2 cells): 0 when only noise is left.
double neighbour_correlation(const BandPoints& points, const std::vector<float>& residual) {
  constexpr std::size_t kSide = 2;
  std::vector<double> together(points.rows, 0.0), alone(points.rows, 0.0);
  parallel_for((points.rows + kSide - 1) / kSide, [&](std::size_t block) {
    for (std::size_t column = 0; column < points.columns; column += kSide) {
      double sum = 0.0, square = 0.0, n = 0.0;
      for (std::size_t row = kSide * block; row < std::min(points.rows, kSide * (block + 1)); ++row)
        for (std::size_t i = points.first(row, column);
             i < points.begin[row * points.columns + std::min(points.columns, column + kSide)]; ++i) {
          if (points.state[i] != PointState::used) continue;
          sum += residual[i];
          square += static_cast<double>(residual[i]) * residual[i];
          n += 1.0;
        }
      if (n < 2.0) continue;
      together[kSide * block] += sum * sum - square;
      alone[kSide * block] += (n - 1.0) * square;
    }
  });
  double a = 0.0, b = 0.0;
  for (std::size_t k = 0; k < points.rows; ++k) {
    a += together[k];
    b += alone[k];
  }
  return b > 0.0 ? a / b : 0.0;
}

}  // namespace

FitResult fit_field(BandPoints& points, const Band& band, const LocalNoise& noise, const FitSettings& settings,
                    const Progress& progress) {
  FitResult out{SplineField(band.length(), band.section.length(), band.closed), {}, {}, 0, 0, 0.0, 0.0, 0.0};
  std::vector<float> weight(points.size(), 0.0f);
  out.residual = points.d;
  constexpr std::size_t kRows = 16;                                                           // of a task
  std::vector<std::array<std::size_t, 2>> counts((points.rows + kRows - 1) / kRows, {0, 0});  // used, held out
  parallel_blocks(points.rows, kRows, [&](std::size_t from, std::size_t to) {
    auto& [used, held_out] = counts[from / kRows];
    for (std::size_t row = from; row < to; ++row)
      for (std::size_t column = 0; column < points.columns; ++column) {
        const double sigma = noise.at(row, column);
        for (std::size_t i = points.first(row, column); i < points.begin[row * points.columns + column + 1]; ++i) {
          if (points.state[i] == PointState::held_out) points.state[i] = PointState::used;
          if (points.state[i] != PointState::used) continue;
          constexpr std::uint64_t kSeed = 0x74726561u;
          if (Random(kSeed + points.index[i]).uniform() < settings.held_out) {
            points.state[i] = PointState::held_out;
            ++held_out;
            continue;
          }
          weight[i] = static_cast<float>(1.0 / (sigma * sigma));
          ++used;
        }
      }
  });
  for (const auto& [used, held_out] : counts) out.used += used, out.held_out += held_out;

  // coarse to fine by the area of a function; along and across independently
  const std::size_t most_a = points.halvings_a, most_s = points.halvings_s;
  const double finest = settings.finest;
  std::vector<Size> sizes;
  for (std::size_t a = 0; a <= most_a; ++a)
    for (std::size_t s = 0; s <= most_s; ++s) {
      const double knot_a = points.cell_a * static_cast<double>(std::size_t{1} << (most_a - a)),
                   knot_s = points.cell_s * static_cast<double>(std::size_t{1} << (most_s - s));
      if ((a > 0 || s > 0) && (knot_a < 0.7 * finest || knot_s < 0.7 * finest)) continue;
      sizes.push_back({a, s});
    }
  std::stable_sort(sizes.begin(), sizes.end(), [](const Size& x, const Size& y) {
    const std::size_t sx = x.halvings_a + x.halvings_s, sy = y.halvings_a + y.halvings_s;
    const auto skew = [](const Size& z) {
      return z.halvings_a > z.halvings_s ? z.halvings_a - z.halvings_s : z.halvings_s - z.halvings_a;
    };
    return sx < sy || (sx == sy && skew(x) > skew(y));
  });
  const auto sweep = [&](double factor, bool first) {
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      if (progress.stop_requested()) throw Error(ErrorKind::numerical, "stopped while the surface was fitted");
      if (progress.report) progress.report(k, sizes.size(), "fitting");
      SplineLevel level;
      level.closed = band.closed;
      level.intervals_a = points.rows >> (most_a - sizes[k].halvings_a);
      level.intervals_s = points.columns >> (most_s - sizes[k].halvings_s);
      level.knot_a = band.length() / static_cast<double>(level.intervals_a);
      level.knot_s = band.section.length() / static_cast<double>(level.intervals_s);
      const FunctionSums sums = sum_functions(points, out.residual, weight, level);
      FitLevelReport report{level.knot_a, level.knot_s, factor, level.size(), 0, 0};
      std::vector<float> ridge;
      if (first && k == 0) {
        level.active.assign(level.size(), 1);
        report.used = level.size();
      } else {
        report.used = choose_functions(sums, factor, level, ridge);
      }
      if (report.used > 0) {
        report.iterations = fit_level(points, out.residual, weight, ridge, level).iterations;
        out.field.add(std::move(level));
      }
      out.levels.push_back(report);
    }
  };
  const auto held_out_square = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points.state[i] == PointState::held_out) sum += static_cast<double>(out.residual[i]) * out.residual[i];
    return sum;
  };
  sweep(settings.significance, true);
  // what looks like noise to small surroundings may be a rough surface: follow it as long as the points that were held
  // out agree
  double factor = settings.significance, best = held_out_square();
  constexpr double kFiner = 1.0 / 3.0, kBetter = 0.98;
  constexpr int kMostSweeps = 5;
  constexpr double kUnrelated = 0.02;
  for (int again = 0; settings.follow && out.held_out >= kFewestHeldOut && again < kMostSweeps &&
                      neighbour_correlation(points, out.residual) > kUnrelated;
       ++again) {
    factor *= kFiner;
    const std::size_t levels_before = out.field.levels().size(), reports_before = out.levels.size();
    const std::vector<float> residual_before = out.residual;
    sweep(factor, false);
    const double square = held_out_square();
    if (square < kBetter * best) {
      best = square;
      continue;
    }
    out.field.drop_from(levels_before);
    out.levels.resize(reports_before);
    out.residual = residual_before;
    break;
  }
  double used = 0.0, held = 0.0, variance = 0.0;
  for (std::size_t row = 0; row < points.rows; ++row)
    for (std::size_t column = 0; column < points.columns; ++column)
      for (std::size_t i = points.first(row, column); i < points.begin[row * points.columns + column + 1]; ++i) {
        const double square = static_cast<double>(out.residual[i]) * out.residual[i];
        if (points.state[i] == PointState::used) used += square;
        if (points.state[i] == PointState::held_out) {
          held += square;
          variance += noise.at(row, column) * noise.at(row, column);
        }
      }
  if (out.used > 0) out.residual_rms = std::sqrt(used / static_cast<double>(out.used));
  if (out.held_out > 0) {
    out.held_out_rms = std::sqrt(held / static_cast<double>(out.held_out));
    out.held_out_error = std::sqrt(std::max(0.0, (held - variance) / static_cast<double>(out.held_out)));
  }
  return out;
}

}  // namespace treadmark::scans
