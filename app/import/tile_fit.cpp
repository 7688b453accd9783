// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/tile_fit.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/cleaning/thin.hpp"
#include "treadmark/scans/fit/band_surface.hpp"
#include "treadmark/scans/fit/damage.hpp"
#include "treadmark/scans/fit/half_fits.hpp"

namespace treadmark::app {
namespace {

using scans::PointState;

constexpr std::size_t kFewestOfTile = 1000;  // points that a fit makes sense with

class TileFit {
 public:
  TileFit(const TilePlan& plan, std::size_t tile, const TilePoints& points)
      : plan_(plan), own_(plan.own(tile)), window_(plan.window(tile)), in_(points) {
    scans::ProjectSettings how = plan.project;
    how.part = scans::BandIntervals{plan.band.from + plan.along(window_.from), plan.band.step, window_.count()};
    projection_ = scans::project(points.points, {}, Pose{}, plan.section, how);
    projection_.points.numbers = points.numbers;
    out_.open.assign(own_.count(), 1);
    out_.open_area = (s_max() - s_min()) * plan.along(own_.count());
    out_.columns = projection_.points.columns;
    out_.coverage.first_column = 0, out_.coverage.last_column = out_.columns;
  }

  FittedTile fitted(bool trial) {
    scans::BandPoints& points = projection_.points;
    if (points.size() < kFewestOfTile) return std::move(out_);
    scans::drop_duplicates(points, in_.points);
    const scans::LocalNoise noise = scans::find_noise(points, projection_.band, plan_.noise);
    scans::CoverageSettings how_covered = plan_.coverage;
    if (!trial) how_covered.usual = &plan_.usual;
    coverage_ = scans::find_coverage(points, projection_.band, how_covered);
    const scans::FitResult fit = scans::fit_field(points, projection_.band, noise, plan_.fit);
    if (trial) {
      out_.sweeps = fit.sweeps;
      out_.noise = noise.typical, out_.noise_window = noise.window;
      out_.coverage = std::move(coverage_);
      return std::move(out_);
    }
    const scans::FittedBand fitted{projection_.band, fit.field, s_min(), s_max(), 0.0};
    find_holes();
    find_damage(fit.field);
    cut_slices(fitted);
    find_checks(fitted);
    find_errors(fitted, noise);
    count(fit, noise);
    fill_maps(fit, noise);
    return std::move(out_);
  }

 private:
  double s_min() const { return projection_.points.cell_s * static_cast<double>(plan_.usual.first_column); }
  double s_max() const { return projection_.points.cell_s * static_cast<double>(plan_.usual.last_column); }
  double start() const { return plan_.along(window_.from); }  ///< of the window's band in the whole one [m]
  bool is_own(double along) const { return along >= plan_.along(own_.from) && along < plan_.along(own_.to); }
  std::size_t first_row() const { return (own_.from - window_.from) << plan_.halvings; }
  std::size_t last_row() const { return (own_.to - window_.from) << plan_.halvings; }

  void find_holes() {
    for (const scans::Hole& hole : coverage_.holes)
      if (is_own(start() + hole.a))
        for (const double number : {start() + hole.a, hole.s, hole.diameter, hole.area, hole.filled ? 1.0 : 0.0})
          out_.holes.push_back(number);
    out_.open.assign(own_.count(), 0);
    out_.open_area = 0.0;
    if (coverage_.whole()) return;
    const std::size_t columns = projection_.points.columns;
    for (std::size_t cell = first_row() * columns; cell < last_row() * columns; ++cell) {
      if (coverage_.open[cell] == 0) continue;
      out_.open[(cell / columns - first_row()) >> plan_.halvings] = 1;
      out_.open_area += projection_.points.cell_a * projection_.points.cell_s;
    }
  }

  void find_damage(const scans::SplineField& field) {
    for (const scans::Damage& d : scans::find_damage(projection_.band, field, s_min(), s_max(), plan_.damage_threshold))
      if (is_own(start() + d.a))
        for (const double number : {start() + d.a, d.s, d.length, d.width, d.depth, d.volume})
          out_.damage.push_back(number);
  }

  void cut_slices(const scans::FittedBand& fitted) {
    constexpr double kRounding = 1e-9;  // of places that are ends of intervals [m]
    const bool last = own_.to == plan_.band.count;
    std::vector<double> places = scans::slice_stations(fitted, plan_.tolerance, projection_.points.cell_a);
    const double from = plan_.along(own_.from) - start() - kRounding,
                 to = plan_.along(own_.to) - start() + (last ? kRounding : -kRounding);
    std::erase_if(places, [&](double a) { return a < from || a > to; });
    std::sort(places.begin(), places.end());
    std::vector<Profile> slices(places.size());
    parallel_for(places.size(),
                 [&](std::size_t k) { slices[k] = scans::slice_at(fitted, places[k], plan_.spacing, {}); });
    for (std::size_t k = 0; k < places.size(); ++k) {
      out_.along.push_back(start() + places[k]);
      out_.y.insert(out_.y.end(), slices[k].y.begin(), slices[k].y.end());
      out_.z.insert(out_.z.end(), slices[k].z.begin(), slices[k].z.end());
    }
  }

  /// At places that meet no nodes, away from the rims.
  void find_checks(const scans::FittedBand& fitted) {
    constexpr double kMargin = 2e-3;
    constexpr std::size_t kAcross = 101;
    for (const double share : {0.137, 0.618, 0.871}) {
      const double along = plan_.along(own_.from) + share * plan_.band.step * static_cast<double>(own_.count());
      for (std::size_t k = 0; k < kAcross; ++k) {
        const double s =
            s_min() + kMargin + (s_max() - s_min() - 2.0 * kMargin) * (static_cast<double>(k) + 0.41) / kAcross;
        const Vec2 p = fitted.across(along - start(), s), normal = plan_.section.at(s).normal;
        for (const double number : {along, p.x(), -p.y(), std::atan2(normal.x(), normal.y())})
          out_.checks.push_back(number);
      }
    }
  }

  void find_errors(const scans::FittedBand& fitted, const scans::LocalNoise& noise) {
    std::vector<double> places;
    for (const double along : plan_.error_stations)
      if (is_own(along)) places.push_back(along - start());
    if (places.empty()) return;
    SurfaceErrors errors = scans::half_fit_errors(fitted, projection_.points, noise, plan_.fit,
                                                  plan_.halves ? &*plan_.halves : nullptr, places, 0.0);
    for (const double a : places) out_.error_at.push_back(start() + a);
    for (const std::vector<double>& draw : errors.draws)
      out_.errors.insert(out_.errors.end(), draw.begin(), draw.end());
    out_.error_y = std::move(errors.y), out_.error_z = std::move(errors.z);
  }

  void count(const scans::FitResult& fit, const scans::LocalNoise& noise) {
    const scans::BandPoints& points = projection_.points;
    constexpr std::size_t kBins = 80;
    constexpr double kRange = 6.0;
    out_.histogram.assign(kBins, 0);
    const double range = kRange * plan_.noise.typical;
    for (std::size_t row = first_row(); row < last_row(); ++row)
      for (std::size_t column = 0; column < points.columns; ++column)
        for (std::size_t i = points.first(row, column); i < points.begin[row * points.columns + column + 1]; ++i) {
          out_.outliers += points.state[i] == PointState::outlier ? 1 : 0;
          out_.duplicates += points.state[i] == PointState::off_band ? 1 : 0;
          if (!scans::is_of_surface(points.state[i])) continue;
          const double r = fit.residual[i], square = r * r;
          const bool held_out = points.state[i] == PointState::held_out;
          ++(held_out ? out_.held_out : out_.used);
          (held_out ? out_.square_held_out : out_.square_used) += square;
          if (held_out) out_.variance_held_out += std::pow(noise.at(row, column), 2);
          out_.largest = std::max(out_.largest, std::fabs(r));
          if (const double place = 0.5 * (r / range + 1.0) * kBins; place >= 0.0 && place < kBins)
            ++out_.histogram[to_whole<std::size_t>(place)];
        }
  }

  void fill_maps(const scans::FitResult& fit, const scans::LocalNoise& noise) {
    const scans::BandPoints& points = projection_.points;
    const std::size_t map_rows = (own_.count() + plan_.map_intervals - 1) / plan_.map_intervals,
                      cells = plan_.map_intervals << plan_.halvings;
    for (std::vector<float>& map : out_.maps) map.assign(map_rows * points.columns, static_cast<float>(kNaN));
    parallel_for(map_rows, [&](std::size_t r) {
      const std::size_t from = first_row() + r * cells, to = std::min(last_row(), from + cells);
      for (std::size_t column = 0; column < points.columns; ++column) {
        double all = 0.0, removed = 0.0, sum = 0.0;
        for (std::size_t row = from; row < to; ++row)
          for (std::size_t i = points.first(row, column); i < points.begin[row * points.columns + column + 1]; ++i) {
            const bool counts = scans::is_of_surface(points.state[i]);
            all += 1.0, removed += counts ? 0.0 : 1.0;
            sum += counts ? static_cast<double>(fit.residual[i]) : 0.0;
          }
        const double area = points.cell_a * points.cell_s * static_cast<double>(to - from);
        const std::size_t at = r * points.columns + column;
        out_.maps[0][at] = static_cast<float>(all / area);
        out_.maps[1][at] = static_cast<float>(removed / area);
        out_.maps[2][at] = static_cast<float>(deviation(fit.field, from, to, column));
        if (all > removed) out_.maps[3][at] = static_cast<float>(sum / (all - removed));
        if (all > 0.0) out_.maps[4][at] = static_cast<float>(noise.at((from + to) / 2, column));
      }
    });
  }

  /// That of the greatest size over rows [from, to); NaN in open holes and beside the usable width.
  double deviation(const scans::SplineField& field, std::size_t from, std::size_t to, std::size_t column) const {
    const scans::BandPoints& points = projection_.points;
    constexpr std::size_t kPlaces = 8;
    double out = kNaN;
    if (column < plan_.usual.first_column || column >= plan_.usual.last_column) return out;
    for (std::size_t row = from; row < to; row += std::max<std::size_t>(1, (to - from) / kPlaces)) {
      if (!coverage_.whole() && coverage_.open[row * points.columns + column] != 0) continue;
      const double d = field.value(points.cell_a * (static_cast<double>(row) + 0.5),
                                   points.cell_s * (static_cast<double>(column) + 0.5));
      if (!(std::fabs(d) <= std::fabs(out))) out = d;
    }
    return out;
  }

  const TilePlan& plan_;
  const TileRange own_, window_;
  const TilePoints& in_;
  scans::Projection projection_;
  scans::Coverage coverage_;
  FittedTile out_;
};

}  // namespace

FittedTile fit_tile(const TilePlan& plan, std::size_t tile, const TilePoints& points, bool trial) {
  return TileFit(plan, tile, points).fitted(trial);
}

}  // namespace treadmark::app
