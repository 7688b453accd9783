// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/error_sources.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "treadmark/core/median.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/fit/half_fits.hpp"

namespace treadmark::scans {
namespace {

/// Points of some cells: how many, what their residuals add up to, and the variance of that by their scatter [m^2].
struct CellSums {
  double count = 0.0, residual = 0.0, variance = 0.0;
};

/// Of the cells of rows [row, row + rows) and columns [column, column + columns), as far as they are there.
CellSums sums_of(const BandPoints& points, const LocalNoise& noise, std::span<const float> residual, std::size_t row,
                 std::size_t rows, std::size_t column, std::size_t columns) {
  CellSums out;
  for (std::size_t r = row; r < std::min(points.rows, row + rows); ++r)
    for (std::size_t c = column; c < std::min(points.columns, column + columns); ++c)
      for (std::size_t i = points.first(r, c); i < points.begin[r * points.columns + c + 1]; ++i) {
        if (points.state[i] != PointState::used && points.state[i] != PointState::held_out) continue;
        out.count += 1.0;
        out.residual += residual[i];
        out.variance += std::pow(noise.at(r, c) * noise.factor_of(points.index[i]), 2);
      }
  return out;
}

/// How far apart places along a band are, which may be closed [m].
double apart(const Band& band, double a, double b) {
  return std::fabs(band.closed ? std::remainder(a - b, band.length()) : a - b);
}

class ErrorFields {
 public:
  ErrorFields(const FitFindings& found, const SharedScatter& shared, std::span<const double> stations,
              const SurfaceErrors& errors)
      : found_(found), shared_(shared), stations_(stations), places_(errors.y.size()) {
    const BandPoints& p = found.points;
    across_ = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kWindow / p.cell_s)));
    along_ = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kWindow / p.cell_a)));
  }

  /// Residuals in windows whose means stand out of what scatter explains, strip by strip across.
  SurfaceErrors::Field smoothing() const {
    const auto damages = found_.damage.first(std::min(kMostDamages, found_.damage.size()));
    const BandPoints& p = found_.points;
    std::vector<std::size_t> of_row(p.rows, damages.size());  // number of the damage; last: none
    for (std::size_t row = 0; row < p.rows; ++row) {
      const double a = p.cell_a * (static_cast<double>(row) + 0.5);
      of_row[row] = damage_at(damages, a);
    }
    std::vector<std::vector<double>> strips;  // of each damage, and of the rest
    for (std::size_t region = 0; region <= damages.size(); ++region)
      strips.push_back(strips_of(of_row, region, region < damages.size() ? along_ : p.rows));
    SurfaceErrors::Field out{ErrorSource::smoothing, kWindow, {}};
    for (const double a : stations_) {
      const std::vector<double>& strip = strips[damage_at(damages, a)];
      std::vector<double>& sigma = out.sigma.emplace_back();
      for (std::size_t i = 0; i < places_; ++i) {
        const auto column = to_whole<std::size_t>(std::max(0.0, s_of(i)) / p.cell_s);
        sigma.push_back(strip[std::min(strip.size() - 1, column / across_)]);
      }
    }
    return out;
  }

  SurfaceErrors::Field holes() const {
    SurfaceErrors::Field out{ErrorSource::holes, 0.0, {}};
    out.sigma.assign(stations_.size(), std::vector<double>(places_, 0.0));
    for (const Hole& hole : found_.coverage.holes) {
      if (!hole.filled) continue;
      const double half = 0.5 * hole.diameter, middle = deviation_over(hole);
      out.length = std::max(out.length, half);
      for (std::size_t k = 0; k < stations_.size(); ++k) {
        if (apart(found_.fitted.band, stations_[k], hole.a) > half) continue;
        for (std::size_t i = 0; i < places_; ++i) {
          const double x = (s_of(i) - hole.s) / half;
          if (std::fabs(x) < 1.0) out.sigma[k][i] = std::max(out.sigma[k][i], middle * std::pow(1.0 - x * x, 2));
        }
      }
    }
    return out;
  }

 private:
  static constexpr double kWindow = 4e-3;  // [m]
  static constexpr std::size_t kMostDamages = 4;

  /// Where a place is along the section, in the order of half_fit_errors.
  double s_of(std::size_t place) const {
    const double share = static_cast<double>(place) / static_cast<double>(places_ - 1);
    const FittedBand& f = found_.fitted;
    return f.s_min + (f.band.body == Body::wheel ? 1.0 - share : share) * (f.s_max - f.s_min);
  }

  std::size_t damage_at(std::span<const Damage> damages, double a) const {
    const auto here =
        ranges::find_if(damages, [&](const Damage& d) { return apart(found_.fitted.band, a, d.a) <= 0.5 * d.length; });
    return static_cast<std::size_t>(here - damages.begin());
  }

  /// Of windows so many rows long in the rows of a region: standard deviation of means, of each strip.
  std::vector<double> strips_of(const std::vector<std::size_t>& of_row, std::size_t region, std::size_t window) const {
    constexpr double kFewest = 10.0;             // points
    constexpr double kSure = 3.0, kOfOne = 5.0;  // standard deviations of a variance, and of that of a single window
    std::vector<double> out;
    for (std::size_t column = 0; column < found_.points.columns; column += across_) {
      double excess = 0.0, uncertain = 0.0, windows = 0.0;
      for (std::size_t row = 0; row < of_row.size(); row += window) {
        CellSums all;
        for (std::size_t r = row; r < std::min(of_row.size(), row + window); ++r) {
          if (of_row[r] != region) continue;
          const CellSums one = sums_of(found_.points, found_.noise, found_.fit.residual, r, 1, column, across_);
          all.count += one.count, all.residual += one.residual, all.variance += one.variance;
        }
        if (all.count < kFewest) continue;
        const double variance = shared_.ratio * all.variance / (all.count * all.count);
        excess += std::pow(all.residual / all.count, 2) - variance;
        uncertain += 2.0 * variance * variance;
        windows += 1.0;
      }
      const bool sure = windows > 0.0 && excess > (kSure + kOfOne / std::sqrt(windows)) * std::sqrt(uncertain);
      out.push_back(sure ? std::sqrt(excess / windows) : 0.0);
    }
    return out;
  }

  /// How far the fit is off the mean of what it is half a diameter to both sides, around a hole: root mean square.
  double deviation_over(const Hole& hole) const {
    const FittedBand& f = found_.fitted;
    const double length = f.band.length();
    double squares = 0.0, count = 0.0;
    const auto at = [&](double a, double s) {
      return f.field.value(f.band.closed ? a - length * std::floor(a / length) : a, s);
    };
    const auto add = [&](double a, double s, double da, double ds) {
      const bool inside = s - ds >= f.s_min && s + ds <= f.s_max;
      if (!inside || (!f.band.closed && (a - da < 0.0 || a + da > length))) return;
      squares += std::pow(at(a, s) - 0.5 * (at(a - da, s - ds) + at(a + da, s + ds)), 2);
      count += 1.0;
    };
    for (const double k : {-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0}) {
      const double beside = k * hole.diameter, half = 0.5 * hole.diameter;
      add(hole.a + beside, hole.s, half, 0.0), add(hole.a + beside, hole.s, 0.0, half);
      add(hole.a, hole.s + beside, half, 0.0), add(hole.a, hole.s + beside, 0.0, half);
    }
    return count > 0.0 ? std::sqrt(squares / count) : 0.0;
  }

  const FitFindings& found_;
  const SharedScatter& shared_;
  std::span<const double> stations_;
  std::size_t places_, across_ = 1, along_ = 1;  ///< across, along: cells of a window
};

}  // namespace

SharedScatter shared_scatter(const BandPoints& points, const LocalNoise& noise, std::span<const float> residual) {
  constexpr std::size_t kLargest = 32, kFewestBlocks = 200;  // cells to a side
  constexpr double kMedian = 0.4549364, kError = 2.33;  // of chi-squared of one, and of a median over its root count
  constexpr double kSure = 4.0, kMost = 0.8;
  std::vector<std::pair<double, double>> ratios;  // with lengths
  SharedScatter out;
  double surest = 1.0;  // few blocks count less
  for (std::size_t side = 1; side <= kLargest; side *= 2) {
    std::vector<double> squares;
    for (std::size_t row = 0; row < points.rows; row += side)
      for (std::size_t column = 0; column < points.columns; column += side)
        if (const CellSums sums = sums_of(points, noise, residual, row, side, column, side); sums.variance > 0.0)
          squares.push_back(sums.residual * sums.residual / sums.variance);
    if (squares.size() < kFewestBlocks) break;
    const double by_chance = 1.0 + kSure * kError / std::sqrt(static_cast<double>(squares.size())),
                 ratio = median_of(squares) / kMedian;
    ratios.emplace_back(ratio, static_cast<double>(side) * std::sqrt(points.cell_a * points.cell_s));
    if (ratio / by_chance > surest) surest = ratio / by_chance, out.ratio = ratio;
  }
  for (const auto& [ratio, length] : ratios)
    if (out.ratio > 1.0 && out.length == 0.0 && ratio >= kMost * out.ratio) out.length = length;
  return out;
}

void add_error_sources(const FitFindings& found, const SharedScatter& shared, std::span<const double> stations,
                       SurfaceErrors& errors) {
  if (shared.ratio > 1.0)
    for (std::vector<double>& draw : errors.draws)
      for (double& error : draw) error *= std::sqrt(shared.ratio);
  const ErrorFields fields(found, shared, stations, errors);
  const auto add = [&](SurfaceErrors::Field field) {
    const auto any = [](const std::vector<double>& sigma) { return *ranges::max_element(sigma) > 0.0; };
    if (ranges::any_of(field.sigma, any)) errors.fields.push_back(std::move(field));
  };
  add(fields.smoothing());
  add(fields.holes());
}

}  // namespace treadmark::scans
