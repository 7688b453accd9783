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
constexpr double kFiner = 1.0 / 3.0;  // significance of a sweep over that of the one before

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

/// Sizes of functions, coarse to fine by their area; along and across independently.
std::vector<Size> sizes_of(const BandPoints& points, double finest) {
  const std::size_t most_a = points.halvings_a, most_s = points.halvings_s;
  std::vector<Size> out;
  for (std::size_t a = 0; a <= most_a; ++a)
    for (std::size_t s = 0; s <= most_s; ++s) {
      const double knot_a = points.cell_a * static_cast<double>(std::size_t{1} << (most_a - a)),
                   knot_s = points.cell_s * static_cast<double>(std::size_t{1} << (most_s - s));
      if ((a > 0 || s > 0) && (knot_a < 0.7 * finest || knot_s < 0.7 * finest)) continue;
      out.push_back({a, s});
    }
  std::stable_sort(out.begin(), out.end(), [](const Size& x, const Size& y) {
    const std::size_t sx = x.halvings_a + x.halvings_s, sy = y.halvings_a + y.halvings_s;
    const auto skew = [](const Size& z) {
      return z.halvings_a > z.halvings_s ? z.halvings_a - z.halvings_s : z.halvings_s - z.halvings_a;
    };
    return sx < sy || (sx == sy && skew(x) > skew(y));
  });
  return out;
}

class FieldFit {
 public:
  FieldFit(BandPoints& points, const Band& band, const LocalNoise& noise, const FitSettings& settings,
           const Progress& progress)
      : points_(points),
        band_(band),
        noise_(noise),
        settings_(settings),
        progress_(progress),
        sizes_(sizes_of(points, settings.finest)),
        weight_(points.size(), 0.0f),
        out_{SplineField(band.length(), band.section.length(), band.closed), {}, points.d, 0, 0, 0, 0.0, 0.0, 0.0} {}

  FitResult fitted() {
    hold_out();
    sweep(settings_.significance, true);
    if (settings_.sweeps) {
      for (double factor = settings_.significance; out_.sweeps < *settings_.sweeps; ++out_.sweeps)
        sweep(factor *= kFiner, false);
    } else if (settings_.follow && out_.held_out >= kFewestHeldOut) {
      follow();
    }
    sum_up();
    return std::move(out_);
  }

 private:
  /// Draws the points that the fit does not see, and weighs the others.
  void hold_out() {
    constexpr std::size_t kRows = 16;                                                            // of a task
    std::vector<std::array<std::size_t, 2>> counts((points_.rows + kRows - 1) / kRows, {0, 0});  // used, held out
    parallel_blocks(points_.rows, kRows, [&](std::size_t from, std::size_t to) {
      auto& [used, held_out] = counts[from / kRows];
      for (std::size_t row = from; row < to; ++row)
        for (std::size_t column = 0; column < points_.columns; ++column) {
          const double of_cell = noise_.at(row, column);
          for (std::size_t i = points_.first(row, column); i < points_.begin[row * points_.columns + column + 1]; ++i) {
            if (points_.state[i] == PointState::held_out) points_.state[i] = PointState::used;
            if (points_.state[i] != PointState::used) continue;
            constexpr std::uint64_t kSeed = 0x74726561u;
            if (Random(kSeed + points_.number(i)).uniform() < settings_.held_out) {
              points_.state[i] = PointState::held_out;
              ++held_out;
              continue;
            }
            const double sigma = of_cell * noise_.factor_of(points_.index[i]);
            weight_[i] = static_cast<float>(1.0 / (sigma * sigma));
            ++used;
          }
        }
    });
    for (const auto& [used, held_out] : counts) out_.used += used, out_.held_out += held_out;
  }

  /// Fits functions of all sizes to what is left; the first of a first sweep are all used.
  void sweep(double factor, bool first) {
    for (std::size_t k = 0; k < sizes_.size(); ++k) {
      if (progress_.stop_requested()) throw Error(ErrorKind::numerical, "stopped while the surface was fitted");
      if (progress_.report) progress_.report(k, sizes_.size(), "fitting");
      SplineLevel level;
      level.closed = band_.closed;
      level.intervals_a = points_.rows >> (points_.halvings_a - sizes_[k].halvings_a);
      level.intervals_s = points_.columns >> (points_.halvings_s - sizes_[k].halvings_s);
      level.knot_a = band_.length() / static_cast<double>(level.intervals_a);
      level.knot_s = band_.section.length() / static_cast<double>(level.intervals_s);
      const FunctionSums sums = sum_functions(points_, out_.residual, weight_, level);
      FitLevelReport report{level.knot_a, level.knot_s, factor, level.size(), 0, 0};
      std::vector<float> ridge;
      if (first && k == 0) {
        level.active.assign(level.size(), 1);
        report.used = level.size();
      } else {
        report.used = choose_functions(sums, factor, level, ridge, functions_of_whole(level, sizes_[k]));
      }
      if (report.used > 0) {
        report.iterations = fit_level(points_, out_.residual, weight_, ridge, level).iterations;
        out_.field.add(std::move(level));
      }
      out_.levels.push_back(report);
    }
  }

  /// How many functions the level has, were it that of the whole band.
  std::size_t functions_of_whole(const SplineLevel& level, const Size& size) const {
    if (settings_.rows_of_whole == 0) return level.size();
    return ((settings_.rows_of_whole >> (points_.halvings_a - size.halvings_a)) + 3) * level.functions_s();
  }

  double held_out_square() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_.state[i] == PointState::held_out) sum += static_cast<double>(out_.residual[i]) * out_.residual[i];
    return sum;
  }

  /// What looks like noise to small surroundings may be a rough surface: follows it as long as the points that were
  /// held out agree.
  void follow() {
    double factor = settings_.significance, best = held_out_square();
    constexpr double kBetter = 0.98, kUnrelated = 0.02;
    constexpr int kMostSweeps = 5;
    for (int again = 0; again < kMostSweeps && neighbour_correlation(points_, out_.residual) > kUnrelated; ++again) {
      factor *= kFiner;
      const std::size_t levels_before = out_.field.levels().size(), reports_before = out_.levels.size();
      const std::vector<float> residual_before = out_.residual;
      sweep(factor, false);
      const double square = held_out_square();
      if (square < kBetter * best) {
        best = square;
        ++out_.sweeps;
        continue;
      }
      out_.field.drop_from(levels_before);
      out_.levels.resize(reports_before);
      out_.residual = residual_before;
      break;
    }
  }

  void sum_up() {
    double used = 0.0, held = 0.0, variance = 0.0;
    for (std::size_t row = 0; row < points_.rows; ++row)
      for (std::size_t column = 0; column < points_.columns; ++column)
        for (std::size_t i = points_.first(row, column); i < points_.begin[row * points_.columns + column + 1]; ++i) {
          const double square = static_cast<double>(out_.residual[i]) * out_.residual[i];
          if (points_.state[i] == PointState::used) used += square;
          if (points_.state[i] == PointState::held_out) {
            held += square;
            variance += std::pow(noise_.at(row, column) * noise_.factor_of(points_.index[i]), 2);
          }
        }
    if (out_.used > 0) out_.residual_rms = std::sqrt(used / static_cast<double>(out_.used));
    if (out_.held_out > 0) {
      out_.held_out_rms = std::sqrt(held / static_cast<double>(out_.held_out));
      out_.held_out_error = std::sqrt(std::max(0.0, (held - variance) / static_cast<double>(out_.held_out)));
    }
  }

  BandPoints& points_;
  const Band& band_;
  const LocalNoise& noise_;
  const FitSettings& settings_;
  const Progress& progress_;
  std::vector<Size> sizes_;
  std::vector<float> weight_;  ///< of the points that are used
  FitResult out_;
};

}  // namespace

FitResult fit_field(BandPoints& points, const Band& band, const LocalNoise& noise, const FitSettings& settings,
                    const Progress& progress) {
  return FieldFit(points, band, noise, settings, progress).fitted();
}

}  // namespace treadmark::scans
