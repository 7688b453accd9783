// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/noise_factors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kFewestOfClass = 300, kFewestOfTile = 30;
constexpr int kPolishRounds = 10;
constexpr double kDiffers = 1.15;  // largest factor over the least of a property that counts
// what they may be off by chance: standard errors, and that of a median of sizes of normal numbers, relative, over
// 1 / root count
constexpr double kSurely = 3.0, kOfMedian = 1.17;

struct Class {
  std::size_t points = 0, looked_at = 0;
  double factor = 1.0;
};

class Polish {
 public:
  Polish(const BandPoints& points, std::span<const NoiseProperty> properties, const LocalNoise& noise)
      : points_(&points), properties_(properties), noise_(&noise), sigma_(noise.sigma) {
    for (const NoiseProperty& one : properties)
      classes_.emplace_back(one.empty() ? std::size_t{0} : std::size_t{*std::max_element(one.begin(), one.end())} + 1);
  }

  void run() {
    for (int round = 0; round < kPolishRounds; ++round) {
      for (std::size_t p = 0; p < properties_.size(); ++p) find_classes(p);
      find_tiles();
    }
  }

  /// Of those that are known, the largest over the least, as far as it is no chance.
  double spread(std::size_t property) const {
    double least = kInfinity, most = 0.0;
    for (const Class& one : classes_[property]) {
      if (one.looked_at < kFewestOfClass) continue;
      const double chance = std::exp(kSurely * kOfMedian / std::sqrt(static_cast<double>(one.looked_at)));
      least = std::min(least, one.factor * chance), most = std::max(most, one.factor / chance);
    }
    return most > 0.0 ? most / least : 1.0;
  }

  double factor(std::uint32_t point) const {
    double out = 1.0;
    for (std::size_t p = 0; p < properties_.size(); ++p) out *= classes_[p][properties_[p][point]].factor;
    return out;
  }
  const std::vector<float>& sigma() const { return sigma_; }
  const std::vector<Class>& classes(std::size_t property) const { return classes_[property]; }

 private:
  std::size_t tile(std::size_t row, std::size_t column) const {
    return row / LocalNoise::kTileCells * noise_->tile_columns + column / LocalNoise::kTileCells;
  }
  /// Calls visit(point of the band, its tile) for those whose residual is known.
  template <class Visit>
  void each(std::size_t first_row, std::size_t last_row, const Visit& visit) const {
    for (std::size_t row = first_row; row < last_row; ++row)
      for (std::size_t column = 0; column < points_->columns; ++column)
        for (std::size_t i = points_->first(row, column); i < points_->begin[row * points_->columns + column + 1]; ++i)
          if (!std::isnan(noise_->residual[i])) visit(i, tile(row, column));
  }

  void find_classes(std::size_t property) {
    constexpr std::size_t kMost = 1'000'000;  // points
    const std::size_t stride = 1 + points_->size() / kMost;
    std::vector<Class>& known = classes_[property];
    std::vector<std::vector<double>> sizes(known.size());
    each(0, points_->rows, [&](std::size_t i, std::size_t in_tile) {
      if (i % stride != 0) return;
      const std::uint16_t number = properties_[property][points_->index[i]];
      const double others = factor(points_->index[i]) / known[number].factor;
      sizes[number].push_back(static_cast<double>(noise_->residual[i]) /
                              (static_cast<double>(sigma_[in_tile]) * others));
    });
    double sum = 0.0, weight = 0.0;
    for (std::size_t number = 0; number < sizes.size(); ++number) {
      std::vector<double>& values = sizes[number];
      Class& one = known[number];
      one.looked_at = values.size();
      one.points = stride * values.size();
      one.factor = values.size() < kFewestOfClass ? 1.0 : std::max(kMad * median_of(values), 1e-3);
      sum += static_cast<double>(values.size()) * std::log(one.factor), weight += static_cast<double>(values.size());
    }
    // usual points keep what their tile says
    for (Class& one : known) one.factor /= weight > 0.0 ? std::exp(sum / weight) : 1.0;
  }

  void find_tiles() {
    parallel_for(noise_->tile_rows, [&](std::size_t tile_row) {
      std::vector<std::vector<double>> sizes(noise_->tile_columns);
      each(tile_row * LocalNoise::kTileCells, std::min(points_->rows, (tile_row + 1) * LocalNoise::kTileCells),
           [&](std::size_t i, std::size_t in_tile) {
             sizes[in_tile % noise_->tile_columns].push_back(static_cast<double>(noise_->residual[i]) /
                                                             factor(points_->index[i]));
           });
      for (std::size_t column = 0; column < noise_->tile_columns; ++column)
        if (sizes[column].size() >= kFewestOfTile)
          sigma_[tile_row * noise_->tile_columns + column] =
              static_cast<float>(std::max(kMad * median_of(sizes[column]), 1e-7));
    });
  }

  const BandPoints* points_;
  std::span<const NoiseProperty> properties_;
  const LocalNoise* noise_;
  std::vector<float> sigma_;
  std::vector<std::vector<Class>> classes_;  ///< of each property, by number
};

}  // namespace

std::vector<NoiseClass> find_noise_factors(BandPoints& points, std::span<const NoiseProperty> properties,
                                           const NoiseSettings& settings, LocalNoise& noise) {
  std::vector<NoiseClass> out;
  if (properties.empty() || points.size() == 0 || noise.residual.size() != points.size()) return out;
  std::vector<std::size_t> number;
  std::vector<NoiseProperty> that_count;
  Polish polish(points, properties, noise);
  polish.run();
  for (std::size_t p = 0; p < properties.size(); ++p)
    if (polish.spread(p) > kDiffers) number.push_back(p), that_count.push_back(properties[p]);
  if (that_count.empty()) return out;
  if (that_count.size() < properties.size()) {
    polish = Polish(points, that_count, noise);
    polish.run();
  }
  for (std::size_t p = 0; p < that_count.size(); ++p)
    for (std::size_t k = 0; k < polish.classes(p).size(); ++k)
      if (const Class& one = polish.classes(p)[k]; one.looked_at >= kFewestOfClass)
        out.push_back({number[p], static_cast<std::uint16_t>(k), one.points, one.factor});
  noise.sigma = polish.sigma();
  noise.factor.assign(that_count.front().size(), 1.0f);
  for (std::size_t row = 0; row < points.rows; ++row)
    for (std::size_t column = 0; column < points.columns; ++column)
      for (std::size_t i = points.first(row, column); i < points.begin[row * points.columns + column + 1]; ++i) {
        const std::uint32_t index = points.index[i];
        noise.factor[index] = static_cast<float>(polish.factor(index));
        if (points.state[i] != PointState::outlier || std::isnan(noise.residual[i])) continue;
        if (static_cast<double>(noise.residual[i]) >
            std::max(settings.outlier_factor * noise.at(row, column) * noise.factor_of(index), settings.least_outlier))
          continue;
        points.state[i] = PointState::used;
        --noise.outliers;
      }
  return out;
}

}  // namespace treadmark::scans
