// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_locus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/closest_gap.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"

namespace treadmark::detection {
namespace {

constexpr int kFineRows = 240;
constexpr double kCurveReach = 8e-3;  ///< from a row's lowest point to where its curve is measured [m]
/// Where only the least gap is wanted: a parabola between these is good to a nanometre, on steep flanges too.
constexpr int kFewRows = 96;

/// The silhouette of the wheel along x of T, at one point of its profile.
struct SilhouettePoint {
  double x, y, z, slope, radius, wheel_y;
};

/// Silhouettes of circles of the wheel: R (sin t, -r', cos t) has no x part.
class Silhouette {
 public:
  explicit Silhouette(const Pose& X_TW)
      : X_(X_TW), length_(std::hypot(R(0, 0), R(0, 2))), cosine_(R(0, 0) / length_), sine_(R(0, 2) / length_) {
    side_ = R(2, 2) * cosine_ - R(2, 0) * sine_ >= 0.0 ? 1.0 : -1.0;  // of the two, the point that faces down
  }

  SilhouettePoint at(double y, double r, double by_y, double by_yy) const {
    const double turned_sine = R(0, 1) * by_y / length_, square = 1.0 - turned_sine * turned_sine;
    if (!(square > 0.0)) return {kNaN, kNaN, kNaN, kNaN, kNaN, y};
    const double turned_cosine = side_ * std::sqrt(square);
    const double sine = turned_sine * cosine_ - turned_cosine * sine_,
                 cosine = turned_cosine * cosine_ + turned_sine * sine_;
    const Vec3 p = X_.apply({r * sine, y, r * cosine}), n = X_.rotation * Vec3(sine, -by_y, cosine);
    // Second derivative of the distance to the surface along x, over the normal's z part: the curve z(x) at one y.
    const double bend = length_ * length_ * square / r - by_yy * R(0, 1) * R(0, 1);
    return {p.x(), p.y(), p.z(), -n.y() / n.z(), n.z() / bend, y};
  }

 private:
  double R(int i, int j) const { return X_.rotation(i, j); }

  Pose X_;
  double length_, cosine_, sine_, side_;
};

/// A wheel of revolution from samples of its profile at equal steps, cubic between them.
class SampledWheel {
 public:
  SampledWheel(const Pose& X_TW, double first, double step, const std::vector<double>& r,
               const std::vector<double>& by_y)
      : X_(X_TW),
        down_(X_TW.rotation.row(2)),
        first_(first),
        inverse_step_(1.0 / step),
        step_(step),
        r_(r),
        by_y_(by_y) {}

  /// Height over (x, y) by Newton's method from a near one; NaN off the profile.
  double height(double x, double y, double z) const {
    constexpr int kSteps = 3;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3 q = X_.apply_inverse({x, y, z});
      const double place = (q.y() - first_) * inverse_step_;
      if (!(place >= 0.0 && place <= static_cast<double>(r_.size() - 1))) return kNaN;
      const std::size_t k = std::min(to_whole<std::size_t>(place), r_.size() - 2);
      const double f = place - static_cast<double>(k), rise = r_[k + 1] - r_[k], a = by_y_[k] * step_,
                   b = by_y_[k + 1] * step_;
      const double c2 = 3.0 * rise - 2.0 * a - b, c3 = a + b - 2.0 * rise;
      const double radius = r_[k] + f * (a + f * (c2 + f * c3)),
                   slope = (a + f * (2.0 * c2 + 3.0 * f * c3)) * inverse_step_;
      const double distance = std::sqrt(q.x() * q.x() + q.z() * q.z());
      z -= (distance - radius) / ((q.x() * down_.x() + q.z() * down_.z()) / distance - slope * down_.y());
    }
    return z;
  }

 private:
  Pose X_;
  Vec3 down_;
  double first_, inverse_step_, step_;
  const std::vector<double>&r_, &by_y_;
};

/// The samples of a profile but for those at either end whose circles lie aside of [low, high] of y in T altogether;
/// one of these stays at each end.
std::pair<std::size_t, std::size_t> samples_over(const Pose& X_TW, const SampledProfile& s, double low, double high) {
  const double along = X_TW.rotation(1, 1), swing = std::hypot(X_TW.rotation(1, 0), X_TW.rotation(1, 2));
  const std::size_t n = s.radius.size();
  const auto side = [&](std::size_t i) {
    const double middle = X_TW.origin.y() + along * s.y(i), reach = swing * s.radius[i];
    return middle + reach < low ? -1 : middle - reach > high ? 1 : 0;
  };
  std::size_t begin = 0, end = n;
  for (const int first = side(0); first != 0 && begin + 1 < n && side(begin + 1) == first;) ++begin;
  for (const int last = side(n - 1); last != 0 && end > begin + 1 && side(end - 2) == last;) --end;
  return {begin, end};
}

/// Whether the rail runs along x of T.
bool runs_along(const Pose& X_TR) {
  constexpr double kStraight = 1e-12;
  const Vec3 along = X_TR.rotation.col(0);
  return std::hypot(along.y(), along.z()) < kStraight;
}

/// Whether all of the wheel that is over the extent of a grid is its one profile.
bool wheel_is_round(const BodyPair& bodies, const Grid2& g) {
  if (bodies.wheel->constant_profile()) return true;
  if (!bodies.wheel_profile) return false;
  // Parts with less than the profile's least radius, and then some, are seen at other angles only if they are defects.
  constexpr double kShare = 0.95;
  double least = kInfinity;
  for (const double r : bodies.wheel_profile->radius)
    if (!std::isnan(r)) least = std::min(least, r);
  // Forwards, square to the axle and without a part along z of T: how far ahead of the axle a point is tells its angle.
  const Vec3 axle = bodies.X_TW.rotation.col(1), forwards = axle.cross(Vec3::UnitZ()).normalized();
  double low = kInfinity, high = -kInfinity;
  for (const double x : {g.x(0), g.x(g.nx - 1)})
    for (const double y : {g.y(0), g.y(g.ny - 1)}) {
      const Vec3 p = Vec3(x, y, 0.0) - bodies.X_TW.origin;
      const double ahead = (forwards.x() * p.x() + forwards.y() * p.y()) / (kShare * least);
      low = std::min(low, ahead), high = std::max(high, ahead);
    }
  if (!(low > -1.0 && high < 1.0)) return false;
  const double lowest = lowest_angle(bodies.X_TW);
  return bodies.wheel->constant_between(lowest + std::asin(low), lowest + std::asin(high));
}

/// Shift of a row's weighted middle over that of its ends: moments of the cubic part.
double middle_share(PenetrationWeight weight) { return weight == PenetrationWeight::squared ? 3.0 / 7.0 : 3.0 / 5.0; }

/// Integral over x of the penetration c - x^2 / (2 radius), or of its square; half: half the width.
double row_weight(PenetrationWeight weight, double c, double half) {
  return weight == PenetrationWeight::squared ? 16.0 / 15.0 * c * c * half : 4.0 / 3.0 * c * half;
}

}  // namespace

bool ContactLocus::applies(const BodyPair& bodies) {
  return bodies.rail->constant_profile() && bodies.wheel->constant_profile() && runs_along(bodies.X_TR);
}

bool ContactLocus::applies_over(const BodyPair& bodies, const Grid2& g) {
  if (!runs_along(bodies.X_TR)) return false;
  const double from = bodies.X_TR.origin.x(), along = bodies.X_TR.rotation(0, 0);  // -1: the rail runs backwards
  const auto [u_min, u_max] = std::minmax({along * (g.x(0) - from), along * (g.x(g.nx - 1) - from)});
  return bodies.rail->constant_between(u_min, u_max) && wheel_is_round(bodies, g);
}

ContactLocus::ContactLocus(const BodyPair& bodies, const Grid2& g)
    : bodies_(bodies), x_low_(g.x(0)), x_high_(g.x(g.nx - 1)) {
  const auto profile = bodies.wheel_profile ? bodies.wheel_profile : whole_profile(*bodies.wheel);
  wheel_angle_ = profile->angle;
  outline_ = trace({g.y0, g.dy, g.ny}, *profile);
}

ContactLocus::Outline ContactLocus::trace(const Rows& rows, const SampledProfile& s) {
  const auto n = s.radius.size(), m = static_cast<std::size_t>(rows.count);
  const std::vector<double>&r = s.radius, &by_y = s.slope;
  Outline line;
  line.rows = rows;
  line.rail_z.resize(m), line.rail_slope.resize(m);
  bodies_.rail->heights({bodies_.X_TR.inverse(), {0.5 * (x_low_ + x_high_), rows.first, 1.0, rows.step, 1, rows.count}},
                        {line.rail_z, {}, line.rail_slope});

  // Of several parts of the outline over one y the lowest one (greatest z) counts.
  std::vector<double>& wheel_z = line.wheel_z;
  wheel_z.assign(m, kNaN);
  line.gap.assign(m, kNaN), line.x.assign(m, kNaN), line.radius.assign(m, kNaN);
  std::vector<double> wheel_y(m, kNaN);
  const Silhouette silhouette(bodies_.X_TW);
  SilhouettePoint a{kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
  const auto [begin, end] = samples_over(bodies_.X_TW, s, rows.y(0), rows.y(rows.count - 1));
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t before = i > 0 && !std::isnan(r[i - 1]) ? i - 1 : i,
                      after = i + 1 < n && !std::isnan(r[i + 1]) ? i + 1 : i;
    const double by_yy =
        after > before ? (by_y[after] - by_y[before]) / (s.step * static_cast<double>(after - before)) : 0.0;
    const SilhouettePoint b = silhouette.at(s.y(i), r[i], by_y[i], by_yy);
    const double rise = b.y - a.y;
    if (std::abs(rise) > 1e-3 * s.step) {
      const double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
      const int first = to_whole<int>(std::ceil(std::max(0.0, (low - rows.first) / rows.step - 1e-9)));
      const int last = to_whole<int>(std::floor(std::min(rows.count - 1.0, (high - rows.first) / rows.step + 1e-9)));
      // Walls are straight: the cubic of their slopes would swing.
      constexpr double kWall = 6.0;
      const double secant = b.z - a.z;
      const bool wall = std::abs(a.slope) > kWall || std::abs(b.slope) > kWall;
      const double end_a = wall ? secant : a.slope * rise, end_b = wall ? secant : b.slope * rise;
      for (int row = first; row <= last; ++row) {
        const double f = std::clamp((rows.y(row) - a.y) / rise, 0.0, 1.0);
        const double z =
            a.z + f * (end_a + f * (3.0 * secant - 2.0 * end_a - end_b + f * (end_a + end_b - 2.0 * secant)));
        const auto k = static_cast<std::size_t>(row);
        const double x = a.x + f * (b.x - a.x);
        if (z <= wheel_z[k] || !(x >= x_low_ && x <= x_high_)) continue;
        wheel_z[k] = z;
        line.x[k] = x;
        line.radius[k] = a.radius + f * (b.radius - a.radius);
        wheel_y[k] = a.wheel_y + f * (b.wheel_y - a.wheel_y);
      }
    }
    a = b;
  }
  line.least = kNaN;
  std::size_t deepest = 0;
  for (std::size_t k = 0; k < m; ++k) {
    line.gap[k] = line.rail_z[k] - wheel_z[k];
    line.least = std::fmin(line.least, line.gap[k]);
    if (line.gap[k] == line.least) deepest = k;
  }
  line.closest = deepest > 0 && deepest + 1 < m
                     ? vertex(line.gap[deepest - 1], line.gap[deepest], line.gap[deepest + 1])
                     : line.least;
  if (wheel_y_.empty()) wheel_y_ = std::move(wheel_y);
  return line;
}

/// Of rows from one to another: the curve through its lowest point and one on either side, about as far as contact
/// reaches.
void ContactLocus::measure_curves(Fine& fine, int from, int to) const {
  constexpr double kReach = kCurveReach;
  Outline& line = fine.outline;
  const SampledProfile& s = fine.profile;
  const SampledWheel wheel(bodies_.X_TW, s.first, s.step, s.radius, s.slope);
  fine.measured.resize(line.x.size(), 0), fine.cubic.resize(line.x.size(), 0.0);
  for (auto k = static_cast<std::size_t>(from); k <= static_cast<std::size_t>(to); ++k) {
    if (std::isnan(line.wheel_z[k]) || fine.measured[k] != 0) continue;
    fine.measured[k] = 1;
    const double y = line.rows.y(static_cast<int>(k)), guess = line.wheel_z[k] - 0.5 * kReach * kReach / line.radius[k];
    const double before = wheel.height(line.x[k] - kReach, y, guess),
                 behind = wheel.height(line.x[k] + kReach, y, guess);
    const double drop = line.wheel_z[k] - 0.5 * (before + behind);
    if (!(drop > 0.0)) continue;
    fine.measured[k] = 2;
    line.radius[k] = 0.5 * (kReach * kReach + drop * drop) / drop;
    fine.cubic[k] = 0.5 * (behind - before) / (kReach * kReach * kReach);
  }
}

ContactLocus::Fine& ContactLocus::fine_outline(int first_row, int last_row, int count) {
  for (Fine& fine : fine_)
    if (fine.first_row == first_row && fine.last_row == last_row && fine.outline.rows.count == count) return fine;
  const Rows& coarse = outline_.rows;
  const double low = coarse.y(first_row), high = coarse.y(last_row);
  // The part of the profile that these rows show, and a little more.
  double y_min = std::numeric_limits<double>::infinity(), y_max = -y_min;
  for (int row = first_row; row <= last_row; ++row) {
    y_min = std::fmin(y_min, wheel_y_[static_cast<std::size_t>(row)]);
    y_max = std::fmax(y_max, wheel_y_[static_cast<std::size_t>(row)]);
  }
  constexpr double kMargin = 0.5e-3;  // [m]
  const double margin = coarse.step + kMargin;
  y_min -= margin, y_max += margin;
  constexpr std::size_t kKept = 8;
  if (fine_.size() >= kKept) fine_.erase(fine_.begin());
  SampledProfile profile = sample_profile(*bodies_.wheel, wheel_angle_, y_min, (y_max - y_min) / (count - 1), count);
  Outline outline = trace({low, (high - low) / (count - 1), count}, profile);
  fine_.push_back({first_row, last_row, std::move(outline), std::move(profile), {}, {}});
  return fine_.back();
}

void ContactLocus::weigh_fine(Fine& looked_at, double wheel_dz, double near_miss_gap, PenetrationWeight weight,
                              bool at_deepest, Found& found, ReferenceSum* sum) const {
  const Outline& fine = looked_at.outline;
  const Rows& rows = fine.rows;
  const auto gap = [&](int i) { return fine.gap[static_cast<std::size_t>(i)] - wheel_dz; };
  const auto rail_z = [&](double y) {
    const double place = std::clamp((y - rows.first) / rows.step, 0.0, rows.count - 1.0);
    const auto i = static_cast<std::size_t>(std::min(to_whole<int>(place), rows.count - 2));
    const double low = fine.rail_z[i], high = fine.rail_z[i + 1], f = place - static_cast<double>(i);
    return std::isnan(low) ? high : std::isnan(high) ? low : low + f * (high - low);
  };
  const auto add = [](std::vector<ContactPatch>& list, ContactPatch patch) {
    // Margins of neighbouring fine rows overlap: a region seen twice counts once.
    for (const ContactPatch& other : list)
      if (other.extent.box.y_min <= patch.extent.box.y_max && patch.extent.box.y_min <= other.extent.box.y_max)
        return false;
    patch.parts = {patch.extent};
    list.push_back(std::move(patch));
    return true;
  };
  for (int i = 0; i < rows.count; ++i) {
    const double here = gap(i);
    const auto k = static_cast<std::size_t>(i);
    if (here >= 0.0 && here < near_miss_gap) {
      if ((i > 0 && gap(i - 1) <= here) || (i + 1 < rows.count && gap(i + 1) < here)) continue;
      ContactPatch p;
      p.x = fine.x[k], p.y = rows.y(i);
      p.extent = {{p.x, p.x, p.y, p.y}, fine.rail_z[k], fine.rail_z[k]};
      p.deepest_T = {p.x, p.y, fine.rail_z[k]};
      p.inclination = std::atan(fine.rail_slope[k]);
      p.least_gap = here;
      add(found.near_misses, std::move(p));
    }
    if (!(here < 0.0)) continue;

    const int first = i;
    int last = i, deepest = i;
    ContactPatch p;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    p.extent.box = {kInfinity, -kInfinity, 0.0, 0.0};
    double total = 0.0, sum_x = 0.0, sum_y = 0.0, sum_a = 0.0;
    while (last + 1 < rows.count && gap(last + 1) < 0.0) ++last;
    measure_curves(looked_at, first, last);
    for (; i <= last; ++i) {
      const auto j = static_cast<std::size_t>(i);
      const double c = -gap(i), half = std::sqrt(c * std::max(0.0, 2.0 * fine.radius[j] - c)),
                   w = row_weight(weight, c, half);
      total += w;
      const double shift = looked_at.cubic[j] * half * half * fine.radius[j];  // of both ends
      sum_x += w * (fine.x[j] + middle_share(weight) * shift);
      sum_y += w * rows.y(i);
      sum_a += w * std::atan(fine.rail_slope[j]);
      p.extent.box.x_min = std::min(p.extent.box.x_min, fine.x[j] + shift - half);
      p.extent.box.x_max = std::max(p.extent.box.x_max, fine.x[j] + shift + half);
      if (gap(i) < gap(deepest)) deepest = i;
    }
    const auto end = [&](int inside, int outside) {
      if (outside < 0 || outside >= rows.count) return rows.y(inside);
      const double out = gap(outside), in = gap(inside);
      return std::isnan(out) ? rows.y(outside) : rows.y(inside) + (rows.y(outside) - rows.y(inside)) * in / (in - out);
    };
    p.extent.box.y_min = end(first, first - 1);
    p.extent.box.y_max = end(last, last + 1);
    p.extent.z_at_y_min = rail_z(p.extent.box.y_min);
    p.extent.z_at_y_max = rail_z(p.extent.box.y_max);
    const auto d = static_cast<std::size_t>(deepest);
    p.deepest_T = {fine.x[d], rows.y(deepest), fine.rail_z[d]};
    p.x = at_deepest ? p.deepest_T.x() : sum_x / total;
    p.y = at_deepest ? p.deepest_T.y() : sum_y / total;
    p.inclination = sum_a / total;
    p.extent.x = p.x, p.extent.y = p.y;
    p.weight = total * rows.step;
    p.least_gap = gap(deepest);
    const bool held = sum != nullptr && sum->holds(p.x, p.y);
    if (add(found.patches, std::move(p)) && held) add_rows(looked_at, first, last, wheel_dz, weight, *sum);
    --i;
  }
}

/// As the rows are weighed: each has the depth c of its lowest point at x, the radius r of the wheel's curve there and
/// its cubic part, both from heights at three places.
void ContactLocus::add_rows(const Fine& looked_at, int first, int last, double wheel_dz, PenetrationWeight weight,
                            ReferenceSum& sum) const {
  const Outline& fine = looked_at.outline;
  const double share = middle_share(weight), step = fine.rows.step;
  const auto scaled = [](double factor, ReferenceSum::Three by) {
    for (double& one : by) one *= factor;
    return by;
  };
  for (int i = first; i <= last; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double c = wheel_dz - fine.gap[k], r = fine.radius[k], cubic = looked_at.cubic[k],
                 square = c * std::max(0.0, 2.0 * r - c), half = std::sqrt(square), w = row_weight(weight, c, half);
    if (!(half > 0.0)) continue;
    const double half_by_c = (r - c) / half, half_by_r = c / half;
    const bool squared = weight == PenetrationWeight::squared;
    const double by_half = w / half, by_depth = squared ? 2.0 * w / c : w / c;  // of the weight
    const double x = fine.x[k], y = fine.rows.y(i), slope = fine.rail_slope[k];
    const ReferenceSum::Three values{x + share * cubic * square * r, y, std::atan(slope)};
    sum.count(step * w, values);
    const ReferenceSum::Three by_w = sum.by_weight(values);
    const double by_x = w / sum.total();  // of the middle of the row, on the reference's x
    ReferenceSum::Three by_c = scaled(by_depth + by_half * half_by_c, by_w), by_r = scaled(by_half * half_by_r, by_w);
    by_c[0] += by_x * share * cubic * 2.0 * r * (r - c);
    by_r[0] += by_x * share * cubic * (square + 2.0 * r * c);
    by_c = scaled(step, by_c), by_r = scaled(step, by_r);

    const Vec2 lowest(x, y);
    sum.add_rail(lowest, scaled(-1.0, by_c));
    sum.add_rail_slope(lowest, {0.0, 0.0, step * w / (sum.total() * (1.0 + slope * slope))});
    sum.add_wheel(lowest, by_c);
    // the lowest point moves to where the slope is 0, and with it the places where the curve is measured
    const double a = kCurveReach, fall = r - std::sqrt(std::max(0.0, r * r - a * a));
    const bool measured = looked_at.measured[k] == 2 && fall > 0.0;
    sum.add_wheel_slope(lowest, {step * by_x * r * (measured ? 1.0 - share * square / (a * a) : 1.0), 0.0, 0.0});
    if (!measured) continue;
    const ReferenceSum::Three by_fall = scaled(0.5 * (1.0 - a * a / (fall * fall)), by_r);
    const double by_rise =
        step * by_x * share * square * r * 0.5 / (a * a * a);  // of the point behind over that before
    sum.add_wheel(lowest, by_fall);
    for (const double side : {-1.0, 1.0}) {
      ReferenceSum::Three by = scaled(-0.5, by_fall);
      by[0] += side * by_rise;
      sum.add_wheel({x + side * a, y}, by);
    }
  }
}

ContactLocus::Found ContactLocus::at(double wheel_dz, double look_below, double near_miss_gap, PenetrationWeight weight,
                                     bool reference_at_deepest, ReferenceSum* sum) {
  const Rows& rows = outline_.rows;
  const auto gap = [&](int i) {
    return i >= 0 && i < rows.count ? outline_.gap[static_cast<std::size_t>(i)] - wheel_dz : kNaN;
  };
  // Where a rail is steep, curvatures of the gap along z are as many times larger.
  const auto steepness = [&](int i) {
    constexpr double kSteepest = 6.0;
    double slope = 0.0;
    for (int k = std::max(0, i - 1); k <= std::min(rows.count - 1, i + 1); ++k)
      slope = std::fmax(slope, std::abs(outline_.rail_slope[static_cast<std::size_t>(k)]));
    return std::pow(1.0 + std::min(slope, kSteepest) * std::min(slope, kSteepest), 1.5);
  };
  Found found;
  double closest = kNaN;
  // Where the bodies do not touch, all rows are looked at closely that may hold the least gap between them.
  const double may_be_closest = std::max(look_below, outline_.least - wheel_dz + look_below);
  for (int i = 0; i < rows.count; ++i) {
    check_cancelled();
    const double here = gap(i);
    const bool is_minimum = !(gap(i - 1) <= here || gap(i + 1) < here);
    if (!(here < may_be_closest) &&
        !(is_minimum && here < kInfinity && here < may_be_closest + (steepness(i) - 1.0) * look_below))
      continue;
    // A run of rows below zero, or a local minimum above it.
    const int first = i;
    if (gap(i) < 0.0) {
      while (gap(i + 1) < 0.0) ++i;
    } else if (!is_minimum) {
      continue;
    }
    const int from = std::max(0, first - 1), to = std::min(rows.count - 1, i + 1);
    if (!(gap(first) < look_below)) {
      // On steep flanks a shallow contact may lie deeper below the rows.
      const double here_closest = fine_outline(from, to, kFewRows).outline.closest;
      if (!(here_closest < wheel_dz)) {
        closest = std::fmin(closest, here_closest - wheel_dz);
        continue;
      }
    }
    Fine& fine = fine_outline(from, to, kFineRows);
    closest = std::fmin(closest, fine.outline.closest - wheel_dz);
    weigh_fine(fine, wheel_dz, near_miss_gap, weight, reference_at_deepest, found, sum);
  }
  // As in the grid search: deepest first, two near misses at most.
  const auto deeper = [](const ContactPatch& a, const ContactPatch& b) { return a.least_gap < b.least_gap; };
  ranges::stable_sort(found.patches, deeper);
  ranges::stable_sort(found.near_misses, deeper);
  constexpr std::size_t kMaxNearMisses = 2;
  if (found.near_misses.size() > kMaxNearMisses) found.near_misses.resize(kMaxNearMisses);
  found.closest = closest;
  found.least_gap = outline_.least - wheel_dz;
  for (const auto* list : {&found.patches, &found.near_misses})
    for (const ContactPatch& p : *list) found.least_gap = std::min(found.least_gap, p.least_gap);
  return found;
}

}  // namespace treadmark::detection
