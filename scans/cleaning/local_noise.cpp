// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/local_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/cleaning/window.hpp"

namespace treadmark::scans {
namespace {

constexpr double kWantedPoints = 60.0;
constexpr int kWidestWindow = 6;
constexpr std::size_t kMostPoints = 220;  // of the surroundings; evenly chosen from more
constexpr int kAbsolute = 3, kBiweight = 4;
constexpr std::size_t kUnknowns = Window::kTerms, kFewestSamples = 2 * kUnknowns;
constexpr int kMostWindow = 48;
constexpr double kMostLeverage = 0.9;
constexpr double kCalm = 3.5;  // standard deviations
constexpr std::size_t kMany = 48;

/// Points of the cells up to window cells from one, in coordinates that run from -1 to 1; evenly chosen if there are
/// many.
void gather(const BandPoints& points, const Band& band, std::size_t row, int column, int window, Window& samples) {
  const auto rows = static_cast<std::ptrdiff_t>(points.rows), columns = static_cast<std::ptrdiff_t>(points.columns);
  const double a0 = points.cell_a * (static_cast<double>(row) + 0.5), s0 = points.cell_s * (column + 0.5);
  const double reach_a = points.cell_a * (window + 0.5), reach_s = points.cell_s * (window + 0.5);
  static_assert(kMostPoints <= Window::kMost && Window::kMost % Window::kLanes == 0);
  samples.count = 0;
  std::size_t all = 0;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t stride = all / kMostPoints + 1;
    std::size_t number = 0;
    for (std::ptrdiff_t dr = -window; dr <= window; ++dr) {
      std::ptrdiff_t r = static_cast<std::ptrdiff_t>(row) + dr;
      double wrap = 0.0;
      if (r < 0 || r >= rows) {
        if (!band.closed) continue;
        wrap = r < 0 ? -band.length() : band.length();
        r = (r + rows) % rows;
      }
      const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, column - window)),
                 last = static_cast<std::size_t>(std::min<std::ptrdiff_t>(columns - 1, column + window));
      const std::size_t from = points.first(static_cast<std::size_t>(r), first),
                        to = points.begin[static_cast<std::size_t>(r) * points.columns + last + 1];
      if (pass == 0) {
        all += to - from;
        continue;
      }
      for (std::size_t i = from; i < to; ++i) {
        if (number++ % stride != 0) continue;
        samples.x[samples.count] = static_cast<float>((points.a[i] + wrap - a0) / reach_a);
        samples.y[samples.count] = static_cast<float>((points.s[i] - s0) / reach_s);
        samples.d[samples.count++] = points.d[i];
      }
    }
  }
  for (int i = samples.count; i % Window::kLanes != 0; ++i) samples.x[i] = samples.y[i] = samples.d[i] = 0.0f;
}

using Terms = Eigen::Matrix<double, Window::kTerms, 1>;
using Factor = Eigen::LLT<Eigen::Matrix<double, Window::kTerms, Window::kTerms>>;

Terms terms(double x, double y) { return Terms{1.0, x, y, x * x, x * y, y * y}; }

/// Of the normal matrix from the sums of WindowKernel, with so much added to the diagonal.
Factor factor_of(const std::array<double, Window::kMoments>& moments, double added) {
  constexpr std::size_t kAlong[] = {0, 1, 0, 2, 1, 0}, kAcross[] = {0, 0, 1, 0, 1, 2};  // powers of the terms
  constexpr std::size_t kBegin[] = {0, 5, 9, 12, 14};                                   // of each power of y
  Factor::MatrixType matrix;
  for (int i = 0; i < Window::kTerms; ++i)
    for (int k = 0; k < Window::kTerms; ++k)
      matrix(i, k) = moments[kBegin[kAcross[i] + kAcross[k]] + kAlong[i] + kAlong[k]] + (i == k ? added : 0.0);
  return Factor(matrix);
}

struct WindowFit {
  Terms c;             ///< over the window's own coordinates
  Factor factor;       ///< of the normal matrix
  double sigma = 0.0;  ///< scatter about the quadratic [m]
};

WindowFit fit_window(Window& samples, double least) {
  const auto count = static_cast<std::size_t>(samples.count);
  Terms c = Terms::Zero();
  double scale = 0.0;
  for (int round = 0;; ++round) {
    const WindowWeights weights = round == 0          ? WindowWeights::even
                                  : round < kAbsolute ? WindowWeights::absolute
                                                      : WindowWeights::biweight;
    std::array<double, Window::kMoments> moments;
    Terms products;
    fastest_kernel<WindowKernel>().sums(samples, c.data(), weights, round < kAbsolute ? scale : kTukey * scale,
                                        moments.data(), products.data());
    // surroundings that lie on one line leave terms open: those stay small
    const Factor factor = factor_of(moments, 1e-7 * std::max(moments[0], 1.0));
    c = factor.solve(products);
    float middle = 0.0f, greatest = 0.0f;
    fastest_kernel<WindowKernel>().sizes(samples, c.data(), &middle, &greatest);
    scale = std::max(kMad * static_cast<double>(middle), least);
    // nothing stands out of many: weights would change next to nothing; among few a wild point hides behind the scatter
    // that it makes
    const bool clean = round == 0 && count >= kMany && static_cast<double>(greatest) < kCalm * scale;
    if (clean || round + 1 == kAbsolute + kBiweight)
      return {c, factor, scale * std::sqrt(static_cast<double>(count) / static_cast<double>(count - kUnknowns))};
  }
}

}  // namespace

LocalNoise find_noise(BandPoints& points, const Band& band, const NoiseSettings& settings) {
  LocalNoise out;
  const std::size_t tile = LocalNoise::kTileCells;
  out.tile_rows = (points.rows + tile - 1) / tile;
  out.tile_columns = (points.columns + tile - 1) / tile;
  out.sigma.assign(out.tile_rows * out.tile_columns, 0.0f);
  std::size_t filled = 0;
  for (std::size_t k = 0; k + 1 < points.begin.size(); ++k) filled += points.begin[k + 1] > points.begin[k] ? 1 : 0;
  const double per_cell = static_cast<double>(points.size()) / static_cast<double>(std::max<std::size_t>(filled, 1));
  out.window =
      settings.window > 0
          ? settings.window
          : std::clamp(to_whole<int>(std::ceil(0.5 * (std::sqrt(kWantedPoints / per_cell) - 1.0))), 1, kWidestWindow);
  const auto columns = static_cast<int>(points.columns);
  std::vector<float> of_cell(points.begin.size() - 1, -1.0f);
  if (settings.residuals) out.residual.assign(points.size(), static_cast<float>(kNaN));
  std::vector<std::size_t> outliers(points.rows, 0), spared(points.rows, 0), isolated(points.rows, 0);
  parallel_for(points.rows, [&](std::size_t row) {
    Window samples;
    for (int column = 0; column < columns; ++column) {
      const std::size_t own = points.first(row, static_cast<std::size_t>(column)),
                        own_end = points.begin[row * points.columns + static_cast<std::size_t>(column) + 1];
      if (own == own_end) continue;
      const double a0 = points.cell_a * (static_cast<double>(row) + 0.5), s0 = points.cell_s * (column + 0.5);
      // where points are sparse the surroundings are wider
      int window = out.window;
      gather(points, band, row, column, window, samples);
      while (static_cast<std::size_t>(samples.count) < kFewestSamples && window < kMostWindow)
        gather(points, band, row, column, window *= 2, samples);
      if (static_cast<std::size_t>(samples.count) < kFewestSamples) {
        for (std::size_t i = own; i < own_end; ++i) points.state[i] = PointState::outlier;
        isolated[row] += own_end - own;
        continue;
      }
      const double reach_a = points.cell_a * (window + 0.5), reach_s = points.cell_s * (window + 0.5);
      const WindowFit fit = fit_window(samples, 0.1 * settings.least_noise);
      of_cell[row * points.columns + static_cast<std::size_t>(column)] = static_cast<float>(fit.sigma);
      const bool judged = settings.outlier_factor > 0.0;
      if (!judged && !settings.residuals) continue;
      const double limit = judged ? std::max(settings.outlier_factor * fit.sigma, settings.least_outlier) : kInfinity;
      const auto beyond = static_cast<std::size_t>(
          std::count_if(samples.size, samples.size + samples.count, [&](float size) { return size > limit; }));
      const bool edge = static_cast<double>(beyond) >
                        settings.most_flagged * static_cast<double>(static_cast<std::size_t>(samples.count));
      for (std::size_t i = own; i < own_end; ++i) {
        const Terms t = terms((points.a[i] - a0) / reach_a, (points.s[i] - s0) / reach_s);
        // a lone point draws the quadratic to itself: judged by what the others say of it (Cook and Weisberg 1982)
        const double leverage = fit.factor.matrixL().solve(t).squaredNorm();
        if (leverage > kMostLeverage) {
          if (!judged) continue;
          points.state[i] = PointState::outlier;
          ++isolated[row];
          continue;
        }
        const double off = std::fabs(points.d[i] - fit.c.dot(t));
        if (settings.residuals) out.residual[i] = static_cast<float>(off / std::sqrt(1.0 - leverage));
        if (!(off > limit * std::sqrt(1.0 - leverage))) continue;
        ++(edge ? spared : outliers)[row];
        if (!edge) points.state[i] = PointState::outlier;
      }
    }
  });
  for (std::size_t row = 0; row < points.rows; ++row) {
    out.outliers += outliers[row];
    out.spared += spared[row];
    out.isolated += isolated[row];
  }
  // medians of tiles; tiles without any take the typical one
  std::vector<float> all, here;
  for (std::size_t k = 0; k < of_cell.size(); ++k)
    if (of_cell[k] >= 0.0f) all.push_back(of_cell[k]);
  const auto median = [](std::vector<float>& values) { return static_cast<double>(median_of(values)); };
  out.typical = settings.typical > 0.0 ? settings.typical
                : all.empty()          ? settings.least_noise
                                       : std::max(median(all), settings.least_noise);
  for (std::size_t tr = 0; tr < out.tile_rows; ++tr)
    for (std::size_t tc = 0; tc < out.tile_columns; ++tc) {
      here.clear();
      for (std::size_t r = tr * tile; r < std::min(points.rows, (tr + 1) * tile); ++r)
        for (std::size_t c = tc * tile; c < std::min(points.columns, (tc + 1) * tile); ++c)
          if (const float value = of_cell[r * points.columns + c]; value >= 0.0f) here.push_back(value);
      constexpr std::size_t kEnough = 5;
      out.sigma[tr * out.tile_columns + tc] =
          static_cast<float>(here.size() >= kEnough ? std::max(median(here), settings.least_noise) : out.typical);
    }
  return out;
}

}  // namespace treadmark::scans
