// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/fill_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::app {
namespace {

constexpr std::size_t kMostDots = 6000;

/// The cells of the points as a map that begins at the least u, wherever the band itself begins.
struct MapFrame {
  io::BandMap empty;
  std::size_t first_row = 0;  // of the points' cells
};

MapFrame map_frame(const ImportFindings& found) {
  const scans::BandPoints& points = found.projection.points;
  const scans::Band& band = found.projection.band;
  MapFrame out;
  out.empty.rows = points.rows;
  out.empty.columns = points.columns;
  out.empty.s_max = band.section.length();
  double a_min = found.fitted.u_at(0.0) * band.radius;
  if (band.closed) {
    // from -180 to 180 degrees
    const double start = -std::numbers::pi * band.radius;
    double rows = std::floor((start - a_min) / points.cell_a + 0.5);
    rows -= std::floor(rows / static_cast<double>(points.rows)) * static_cast<double>(points.rows);
    out.first_row = to_whole<std::size_t>(rows) % points.rows;
    a_min =
        wrap_angle((a_min + points.cell_a * (static_cast<double>(out.first_row) + 0.5)) / band.radius) * band.radius -
        0.5 * points.cell_a;
  }
  out.empty.a_min = a_min;
  out.empty.a_max = a_min + band.length();
  out.empty.value.assign(points.rows * points.columns, std::numeric_limits<float>::quiet_NaN());
  return out;
}

template <class Value>
io::BandMap map_of(const ImportFindings& found, const MapFrame& frame, const Value& value) {
  const scans::BandPoints& points = found.projection.points;
  io::BandMap out = frame.empty;
  parallel_for(points.rows, [&](std::size_t r) {
    const std::size_t row = (r + frame.first_row) % points.rows;
    for (std::size_t c = 0; c < points.columns; ++c)
      out.value[r * points.columns + c] = static_cast<float>(value(row, c));
  });
  return out;
}

void fill_maps(const ImportFindings& found, io::ImportReport& report) {
  const scans::BandPoints& points = found.projection.points;
  const MapFrame frame = map_frame(found);
  const double cell = points.cell_a * points.cell_s;
  const auto count = [&](std::size_t row, std::size_t column, const auto& counts) {
    std::size_t n = 0;
    for (std::size_t i = points.first(row, column); i < points.begin[row * points.columns + column + 1]; ++i)
      n += counts(i) ? 1 : 0;
    return n;
  };
  const auto inside = [&](std::size_t i) { return scans::is_of_surface(points.state[i]); };
  report.density = map_of(found, frame, [&](std::size_t r, std::size_t c) {
    return static_cast<double>(count(r, c, [](std::size_t) { return true; })) / cell;
  });
  report.removed_map = map_of(found, frame, [&](std::size_t r, std::size_t c) {
    return static_cast<double>(count(r, c, [&](std::size_t i) { return !inside(i); })) / cell;
  });
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  report.fitted = map_of(found, frame, [&](std::size_t r, std::size_t c) {
    const double s = points.cell_s * (static_cast<double>(c) + 0.5);
    if (s < found.fitted.s_min || s > found.fitted.s_max) return kNone;
    if (!found.coverage.open.empty() && found.coverage.open[r * points.columns + c] != 0) return kNone;
    return found.fitted.field.value(points.cell_a * (static_cast<double>(r) + 0.5), s);
  });
  report.residual = map_of(found, frame, [&](std::size_t r, std::size_t c) {
    double sum = 0.0, n = 0.0;
    for (std::size_t i = points.first(r, c); i < points.begin[r * points.columns + c + 1]; ++i)
      if (inside(i)) {
        sum += found.fit.residual[i];
        n += 1.0;
      }
    return n > 0.0 ? sum / n : kNone;
  });
  report.noise_map = map_of(found, frame, [&](std::size_t r, std::size_t c) {
    return points.begin[r * points.columns + c + 1] > points.first(r, c) ? found.noise.at(r, c) : kNone;
  });
}

}  // namespace

void fill_error_map(const ImportFindings& found, const SurfaceErrors& errors, io::ImportReport& report) {
  constexpr std::size_t kNear = 16;  // draws, as in results
  const scans::BandPoints& points = found.projection.points;
  const scans::FittedBand& fitted = found.fitted;
  const bool wheel = found.scan.body == Body::wheel;
  std::vector<std::vector<std::size_t>> near(points.rows);
  parallel_for(points.rows, [&](std::size_t row) {
    const double a = points.cell_a * (static_cast<double>(row) + 0.5);
    near[row] = nearest_draws(errors, fitted.u_at(a), kNear, wheel ? 2.0 * kPi : 0.0);
  });
  std::vector<double> s, tilt;
  std::vector<std::size_t> place;
  for (std::size_t c = 0; c < points.columns; ++c) {
    s.push_back(points.cell_s * (static_cast<double>(c) + 0.5));
    const scans::Section::Point at = fitted.band.section.at(s.back());
    tilt.push_back(std::atan2(wheel ? -at.normal.x() : at.normal.x(), at.normal.y()));
    std::size_t best = 0;
    for (std::size_t i = 1; i < errors.y.size(); ++i)
      if (std::fabs(errors.y[i] - at.position.x()) < std::fabs(errors.y[best] - at.position.x())) best = i;
    place.push_back(best);
  }
  report.error_map = map_of(found, map_frame(found), [&](std::size_t r, std::size_t c) {
    const bool inside = s[c] >= fitted.s_min && s[c] <= fitted.s_max;
    return inside ? deviation_at(errors, place[c], near[r], tilt[c]) : kNaN;
  });
}

namespace {

void fill_sections(const ImportFindings& found, io::ImportReport& report) {
  const bool wheel = found.scan.body == Body::wheel;
  const double radius = wheel ? found.scan.placement.nominal_radius : 0.0;
  const auto in_profile = [&](double y, double v) { return Vec2(y, wheel ? v - radius : -v); };
  const std::size_t stride = std::max<std::size_t>(1, found.scan.points.size() / kMostDots);
  const auto in_section = [&](std::size_t i) {
    const scans::Natural n =
        scans::natural(found.scan.body, found.scan.placement.X_CS.apply_inverse(found.scan.points[i]));
    return in_profile(n.y, n.v);
  };
  for (std::size_t i = 0; i < found.scan.points.size(); i += stride) report.raw_section.push_back(in_section(i));
  std::vector<std::uint8_t> used(found.scan.points.size(), 0);
  const scans::BandPoints& points = found.projection.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (scans::is_of_surface(points.state[i])) used[points.index[i]] = 1;
  if (found.sections != nullptr)
    for (const auto& section : found.sections->points)
      for (const std::uint32_t i : section) used[i] = 1;
  const auto removed = static_cast<std::size_t>(std::count(used.begin(), used.end(), std::uint8_t{0}));
  const std::size_t every = std::max<std::size_t>(1, removed / kMostDots);
  std::size_t number = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] == 0 && number++ % every == 0) report.removed_section.push_back(in_section(i));
  const scans::Section& section = found.projection.band.section;
  for (double s = 0.0; s <= section.length(); s += 0.25e-3) {
    const Vec2 p = section.at(s).position;
    report.section.push_back(in_profile(p.x(), p.y()));
  }
  report.nominal_section = found.scan.nominal;
}

void fill_residuals(const ImportFindings& found, io::ImportReport& report) {
  const scans::BandPoints& points = found.projection.points;
  constexpr std::size_t kBins = 80;
  report.residual_range = 6.0 * std::max(found.noise.typical, report.residual_rms);
  report.residual_histogram.assign(kBins, 0);
  report.residuals = io::ImportReport::Residuals{};
  io::ImportReport::Residuals& residuals = *report.residuals;
  std::vector<float> all;
  all.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!scans::is_of_surface(points.state[i])) continue;
    const double r = found.fit.residual[i];
    all.push_back(static_cast<float>(r));
    const double place = 0.5 * (r / report.residual_range + 1.0) * kBins;
    if (place < 0.0)
      ++residuals.below;
    else if (place < static_cast<double>(kBins))
      ++report.residual_histogram[to_whole<std::size_t>(place)];
    else
      ++residuals.above;
  }
  residuals.distances = distances_of(std::move(all));
  report.residual_max = residuals.distances.largest;
}

/// Of every so many things in their order one, which a seed chooses: even, and without the pattern of scan lines.
class EvenChoice {
 public:
  EvenChoice(std::size_t all, std::size_t most, std::uint64_t seed)
      : every_(std::max<std::size_t>(1, (all + most - 1) / most)), random_(seed) {
    choose();
  }
  /// Whether the next one is chosen.
  bool next() {
    const bool chosen = at_ == chosen_;
    if (++at_ == every_) choose();
    return chosen;
  }

 private:
  void choose() {
    at_ = 0;
    chosen_ = random_.bits() % every_;
  }
  std::size_t every_, at_ = 0, chosen_ = 0;
  Random random_;
};

void fill_cloud(const ImportFindings& found, io::ImportReport& report) {
  constexpr std::size_t kMost = 80'000, kMostRemoved = 20'000;
  constexpr double kFar = 0.1;      // removed points farther from the box of the others are not shown [m]
  constexpr double kDigits = 1e-6;  // of places [m]
  io::ImportReport::CloudSample& out = report.cloud;
  const scans::BandPoints& points = found.projection.points;
  const Pose X_SC = found.scan.placement.X_CS.inverse();
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const auto add = [&](const Vec3& p_S, float residual, float distance, float tilt) {
    const auto rounded = [](double value) { return static_cast<float>(kDigits * std::round(value / kDigits)); };
    out.x.push_back(rounded(p_S.x()));
    out.y.push_back(rounded(p_S.y()));
    out.z.push_back(rounded(p_S.z()));
    out.residual.push_back(residual);
    out.distance.push_back(distance);
    out.tilt.push_back(tilt);
  };
  std::vector<std::uint8_t> used(found.scan.points.size(), 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (scans::is_of_surface(points.state[i])) used[points.index[i]] = 1, ++count;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  EvenChoice choice(count, kMost, 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!scans::is_of_surface(points.state[i]) || !choice.next()) continue;
    const Vec3 p_S = X_SC.apply(found.scan.points[points.index[i]]);
    low = low.cwiseMin(p_S);
    high = high.cwiseMax(p_S);
    const Vec2 normal = found.projection.band.section.at(points.s[i]).normal;
    add(p_S, static_cast<float>(found.fit.residual[i]), points.d[i],
        static_cast<float>(std::atan2(normal.x(), normal.y())));
  }
  out.all = used.size();
  out.removed = used.size() - count;
  EvenChoice removed(out.removed, kMostRemoved, 2);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) continue;
    const Vec3 p_S = X_SC.apply(found.scan.points[i]);
    const double off = (low - p_S).cwiseMax(p_S - high).maxCoeff();
    const bool chosen = removed.next();
    if (!(off <= kFar))
      ++out.far;
    else if (chosen)
      add(p_S, kNone, kNone, kNone);
  }
}

}  // namespace

void fill_placement(const PlacedScan& scan, io::ImportReport& report) {
  report.body = scan.body;
  report.X_CS = frame_in_cloud(scan);
  report.nominal_radius = scan.body == Body::wheel ? scan.placement.nominal_radius : 0.0;
  report.radius_error = scan.placement.radius_error;
  report.axis_position_error = scan.placement.position_error;
  report.axis_direction_error = scan.placement.direction_error;
  report.scatter = scan.placement.scatter;
  report.undamaged = scan.placement.undamaged;
  if (scan.placement.match) {
    report.match_residual = scan.placement.match->residual;
    report.match_agreeing = scan.placement.match->agreeing;
    report.turned = scan.placement.match->turned;
  }
}

void fill_report(const ImportFindings& found, io::ImportReport& report) {
  const scans::Band& band = found.projection.band;
  const auto u_of = [&](double a) { return band.closed ? wrap_angle(found.fitted.u_at(a)) : found.fitted.u_at(a); };
  fill_placement(found.scan, report);
  report.gap_a = found.coverage.gap_a;
  report.gap_s = found.coverage.gap_s;
  report.noise = found.noise.typical;
  report.area = found.coverage.area;
  report.hole_area = found.coverage.hole_area;
  report.hole_limit = found.coverage.limit;
  for (const scans::Hole& hole : found.coverage.holes)
    report.holes.push_back(
        {u_of(hole.a), band.section.at(hole.s).position.x(), hole.diameter, hole.area, hole.filled, hole.s});
  for (const scans::FitLevelReport& level : found.fit.levels)
    report.levels.push_back({level.knot_a, level.knot_s, level.functions, level.used, level.iterations});
  report.fitted_points = found.fit.used;
  report.held_out_points = found.fit.held_out;
  report.points_used = found.fit.used + found.fit.held_out;
  if (found.sections != nullptr) {
    const scans::MeasuredSections& kept = *found.sections;
    io::ImportReport::Sections sections;
    sections.count = kept.u.size();
    const auto [fewest, most] = std::minmax_element(kept.points.begin(), kept.points.end(),
                                                    [](const auto& a, const auto& b) { return a.size() < b.size(); });
    sections.fewest_points = fewest->size();
    sections.most_points = most->size();
    sections.least_gap = kept.least_gap;
    sections.widest_gap = kept.widest_gap;
    sections.spread = kept.spread;
    report.sections = sections;
    report.points_used = 0;
    for (const auto& points : kept.points) report.points_used += points.size();
  }
  report.residual_rms = found.fit.residual_rms;
  report.held_out_rms = found.fit.held_out_rms;
  report.held_out_error = found.fit.held_out_error;
  for (const scans::Damage& d : found.damage)
    report.damage.push_back({u_of(d.a), band.section.at(d.s).position.x(), d.length, d.width, d.depth, d.volume, d.s});
  report.y_min = band.section.at(found.fitted.s_min).position.x();
  report.y_max = band.section.at(found.fitted.s_max).position.x();
  report.closed = band.closed;
  report.u_min = band.closed ? -std::numbers::pi : found.fitted.u_at(0.0);
  report.u_max = band.closed ? std::numbers::pi : found.fitted.u_at(band.length());
  fill_residuals(found, report);
  fill_cloud(found, report);
  fill_maps(found, report);
  fill_sections(found, report);
}

io::ImportReport::Distances distances_of(std::vector<float> values) {
  io::ImportReport::Distances out;
  if (values.empty()) return out;
  double sum = 0.0, squares = 0.0;
  for (float& value : values) {
    sum += value;
    squares += static_cast<double>(value) * value;
    value = std::fabs(value);
  }
  const auto count = static_cast<double>(values.size());
  out.mean = sum / count;
  out.rms = std::sqrt(squares / count);
  // of few numbers the next greater one
  const auto at = [&](double share) { return values.begin() + to_whole<std::ptrdiff_t>(std::ceil(share * count)) - 1; };
  const auto at_95 = at(0.95), at_99 = at(0.99);
  std::nth_element(values.begin(), at_95, values.end());
  out.within_95 = *at_95;
  std::nth_element(at_95, at_99, values.end());
  out.within_99 = *at_99;
  out.largest = *std::max_element(at_99, values.end());
  return out;
}

}  // namespace treadmark::app
