// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_program/reference_locus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/contact_program/wheel_locus.hpp"
#include "treadmark/detection/interpenetration.hpp"
#include "treadmark/detection/pruned_gap.hpp"

namespace treadmark::detection {
namespace {

// What rows and parabolas of the locus may miss of a gap [m].
constexpr double kSlight = 3e-6;

// Less of a gap than that is where its curve leaves the wheel [m].
constexpr double kInvented = 30e-6;

// Over what is as high as this and as far ahead or behind no wheel rolls, shares of its radius: such parts of a surface
// are artefacts between sections.
constexpr double kStep = 0.02, kAhead = 0.05;

/// Integral over x of c - a x^2, or of its square, where it is positive.
double parabola_weight(PenetrationWeight weight, double c, double a) {
  const double t = std::sqrt(c / a);
  if (weight == PenetrationWeight::linear) return 2.0 * c * t - 2.0 / 3.0 * a * t * t * t;
  return 2.0 * c * c * t - 4.0 / 3.0 * a * c * t * t * t + 2.0 / 5.0 * a * a * t * t * t * t * t;
}

/// [m]; NaN where a surface is missing.
double gap_over(const BodyPair& bodies, const Vec2& place) {
  double rail = 0.0, wheel = 0.0;
  bodies.rail->heights_at(bodies.X_TR.inverse(), {&place, 1}, {{&rail, 1}, {}, {}});
  bodies.wheel->heights_at(bodies.X_TW.inverse(), {&place, 1}, {{&wheel, 1}, {}, {}});
  return rail - wheel;
}

}  // namespace

ReferenceLocus::ReferenceLocus(const BodyPair& bodies, const LocusRows& rows)
    : rows_(rows), least_(std::numeric_limits<double>::quiet_NaN()) {
  const auto n = static_cast<std::size_t>(rows.count);
  std::vector<double> y(n);
  for (int i = 0; i < rows.count; ++i) y[static_cast<std::size_t>(i)] = rows.y(i);
  rail_z_.resize(n), inclination_.resize(n), x_.resize(n), gap_.resize(n);
  const bool prismatic = ContactLocus::applies(bodies);
  const double x_section = prismatic ? bodies.X_TW.origin.x() : 0.0;
  bodies.rail->heights({bodies.X_TR.inverse(), {x_section, rows.first, 1.0, rows.step, 1, rows.count}},
                       {rail_z_, {}, inclination_});
  const std::vector<Vec2> wheel = WheelLocus(bodies, rows.nominal_radius).over(y);
  if (!prismatic) {
    std::vector<Vec2> below(n);
    for (std::size_t i = 0; i < n; ++i) below[i] = {std::isnan(wheel[i].x()) ? x_section : wheel[i].x(), y[i]};
    bodies.rail->heights_at(bodies.X_TR.inverse(), below, {rail_z_, {}, {}});
  }
  for (std::size_t i = 0; i < n; ++i) {
    inclination_[i] = std::atan(inclination_[i]);
    x_[i] = wheel[i].x();
    gap_[i] = rail_z_[i] - wheel[i].y();
  }
  for (int i = 0; i < rows.count; ++i)
    if (is_minimum(i)) least_ = std::fmin(least_, vertex(i).gap);
}

double ReferenceLocus::gap(int row, double wheel_dz) const {
  return row >= 0 && row < rows_.count ? gap_[static_cast<std::size_t>(row)] - wheel_dz
                                       : std::numeric_limits<double>::quiet_NaN();
}

// Of a plateau one row remains; a missing neighbour never vetoes.
bool ReferenceLocus::is_minimum(int i) const {
  const double here = gap(i, 0.0);
  return !std::isnan(here) && !(gap(i - 1, 0.0) <= here) && !(gap(i + 1, 0.0) < here);
}

ReferenceLocus::Vertex ReferenceLocus::vertex(int i) const {
  constexpr double kJump = 1e-3;  // [m]
  const double here = gap(i, 0.0), before = gap(i - 1, 0.0) - here, after = gap(i + 1, 0.0) - here,
               bend = before + after;
  if (!(std::abs(before) <= kJump && std::abs(after) <= kJump && bend > 0.0)) return {0.0, here};
  const double slope = 0.5 * (after - before);
  return {-slope / bend, here - 0.5 * slope * slope / bend};
}

Vec3 ReferenceLocus::deepest_point(int i) const {
  const double f = vertex(i).offset;
  const auto at = [&](const std::vector<double>& values) {
    const auto k = static_cast<std::size_t>(i);
    return f < 0.0   ? values[k] + f * (values[k] - values[k - 1])
           : f > 0.0 ? values[k] + f * (values[k + 1] - values[k])
                     : values[k];
  };
  return {at(x_), rows_.y(i) + f * rows_.step, at(rail_z_)};
}

Vec2 ReferenceLocus::crossing(int inside, int guard, double wheel_dz) const {
  const auto i = static_cast<std::size_t>(inside);
  const double in = gap(inside, wheel_dz), out = gap(guard, wheel_dz);
  if (std::isnan(out)) return {rows_.y(inside), rail_z_[i]};
  const double f = in / (in - out);
  return {rows_.y(inside) + f * (rows_.y(guard) - rows_.y(inside)),
          rail_z_[i] + f * (rail_z_[static_cast<std::size_t>(guard)] - rail_z_[i])};
}

ContactPatch ReferenceLocus::near_miss(int row, double wheel_dz) const {
  ContactPatch p;
  p.deepest_T = deepest_point(row);
  p.x = p.deepest_T.x(), p.y = p.deepest_T.y();
  p.extent = {{p.x, p.x, p.y, p.y}, p.deepest_T.z(), p.deepest_T.z()};
  p.inclination = inclination_[static_cast<std::size_t>(row)];
  p.least_gap = gap(row, wheel_dz);
  p.parts = {p.extent};
  return p;
}

ContactPatch ReferenceLocus::patch(int first, int last, int deepest, double wheel_dz, PenetrationWeight weight,
                                   bool at_deepest) const {
  const double kappa = 0.5 / rows_.nominal_radius + (rows_.roller_radius != 0.0 ? 0.5 / rows_.roller_radius : 0.0);
  ContactPatch p;
  p.extent.box = {kInfinity, -kInfinity, 0.0, 0.0};
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0, sum_a = 0.0;
  for (int i = first; i <= last; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double c = -gap(i, wheel_dz), w = parabola_weight(weight, c, kappa), half = std::sqrt(c / kappa);
    sum += w;
    sum_x += w * x_[k];
    sum_y += w * rows_.y(i);
    sum_a += w * inclination_[k];
    p.extent.box.x_min = std::min(p.extent.box.x_min, x_[k] - half);
    p.extent.box.x_max = std::max(p.extent.box.x_max, x_[k] + half);
  }
  const Vec2 low = crossing(first, first - 1, wheel_dz), high = crossing(last, last + 1, wheel_dz);
  p.extent.box.y_min = low.x(), p.extent.box.y_max = high.x();
  p.extent.z_at_y_min = low.y(), p.extent.z_at_y_max = high.y();
  p.deepest_T = deepest_point(deepest);
  p.x = at_deepest ? p.deepest_T.x() : sum_x / sum;
  p.y = at_deepest ? p.deepest_T.y() : sum_y / sum;
  p.inclination = sum_a / sum;
  p.extent.x = p.x, p.extent.y = p.y;
  p.weight = sum * rows_.step;
  p.least_gap = vertex(deepest).gap - wheel_dz;
  p.parts = {p.extent};
  return p;
}

ContactLocus::Found ReferenceLocus::at(double wheel_dz, double near_miss_gap, PenetrationWeight weight,
                                       bool reference_at_deepest) const {
  ContactLocus::Found found;
  for (int i = 0; i < rows_.count; ++i) {
    const double here = gap(i, wheel_dz);
    if (here >= 0.0 && here < near_miss_gap && is_minimum(i)) found.near_misses.push_back(near_miss(i, wheel_dz));
    if (!(here < 0.0)) continue;
    const int first = i;
    int deepest = i;
    for (; gap(i + 1, wheel_dz) < 0.0; ++i)
      if (gap(i + 1, wheel_dz) < gap(deepest, wheel_dz)) deepest = i + 1;
    found.patches.push_back(patch(first, i, deepest, wheel_dz, weight, reference_at_deepest));
  }
  const auto deeper = [](const ContactPatch& a, const ContactPatch& b) { return a.least_gap < b.least_gap; };
  ranges::stable_sort(found.patches, deeper);
  ranges::stable_sort(found.near_misses, deeper);
  constexpr std::size_t kMaxNearMisses = 2;
  if (found.near_misses.size() > kMaxNearMisses) found.near_misses.resize(kMaxNearMisses);
  found.closest = found.least_gap = least_ - wheel_dz;
  return found;
}

bool LocusCheck::is_wrong_at_first(const ReferenceLocus& locus, PenetrationWeight weight, PrunedGap& gap) {
  const double least = locus.least(), touching = std::isnan(least) ? gap.least() + 2.0 * kSlight : least + kSlight;
  return is_wrong(touching, locus.at(touching, 0.0, weight, false).patches, gap);
}

bool LocusCheck::is_wrong(double wheel_dz, const std::vector<ContactPatch>& found, PrunedGap& gap) {
  wrong_.reset();
  if (wheel_dz <= agreed_) return false;
  const Grid2& g = gap.field().grid();
  const double deep = wheel_dz - kSlight;
  gap.reveal(deep);
  for (const Region& r : find_regions(gap.field(), deep, std::nullopt, 0.0)) {
    const auto covers_row = [&](const ContactPatch& p, double y) {
      return y > p.extent.box.y_min - g.dy && y < p.extent.box.y_max + g.dy;
    };
    const double x = g.x(r.ix_deepest), y = g.y(r.iy_deepest), z = gap.field().rail_z(r.ix_deepest, r.iy_deepest);
    const bool seen = ranges::any_of(found, [&](const ContactPatch& p) {
      return covers_row(p, y) && x > p.extent.box.x_min - g.dx && x < p.extent.box.x_max + g.dx &&
             p.least_gap < r.least_gap;
    });
    // Without guard rows.
    int low = seen ? r.iy_max : r.iy_deepest, high = seen ? r.iy_min : r.iy_deepest;
    for (int iy = r.iy_min + 1; iy < r.iy_max; ++iy) {
      if (seen && ranges::any_of(found, [&](const ContactPatch& p) { return covers_row(p, g.y(iy)); })) continue;
      low = std::min(low, iy), high = std::max(high, iy);
    }
    if (low > high) continue;
    const bool obstacle =
        -r.least_gap > kStep * nominal_radius_ && std::abs(x - bodies_.X_TW.origin.x()) > kAhead * nominal_radius_;
    wrong_ = {Vec3(x, g.y(low), z), Vec3(x, g.y(high), z), !obstacle};
    if (wrong_->grid_decides) return true;
  }
  if (wrong_) return false;
  for (const ContactPatch& p : found) {
    if (!(gap_over(bodies_, {p.deepest_T.x(), p.deepest_T.y()}) - wheel_dz > p.least_gap + kInvented)) continue;
    wrong_ = {p.deepest_T, p.deepest_T, true};
    return true;
  }
  agreed_ = wheel_dz;
  return false;
}

}  // namespace treadmark::detection
