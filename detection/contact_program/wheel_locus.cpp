// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_program/wheel_locus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/contact_locus.hpp"
#include "treadmark/detection/contact_program/natural_curve.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"

namespace treadmark::detection {
namespace {

constexpr double kKinkHigh = 18.0 * std::numbers::pi / 180.0, kKinkLow = 0.1 * kKinkHigh, kKinkWidth = 2e-3;

/// The profile's data and the points of their circles, in T; by increasing y.
struct Line {
  std::vector<Vec2> profile;
  std::vector<Vec3> points;
};

/// Points of circles, in the frame of the axle without pitch, where wheel and rail have one slope along x of T: of each
/// circle the one that a bracketed Newton method finds from x. slope: dr/dy.
class CommonSlope {
 public:
  CommonSlope(const BodyPair& bodies, const Pose& X_TU, std::span<const double> y, std::span<const double> radius,
              std::span<const double> slope)
      : bodies_(bodies), X_TU_(X_TU), y_(y), radius_(radius), slope_(slope) {}

  void find(std::vector<double>& x, double farthest) {
    constexpr int kMost = 150;
    constexpr double kClose = 1e-6;  // [m]
    std::vector<double> low(x.size(), -farthest), high(x.size(), farthest), x_last = x, rail_last = rail_slope(x);
    for (int step = 0; step < kMost; ++step) {
      const std::vector<double> rail = rail_slope(x);
      double most = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (std::isnan(radius_[i]) || std::isnan(slope_[i])) continue;
        const double next = better(i, x[i], rail[i], x_last[i], rail_last[i], low[i], high[i]);
        most = std::max(most, std::abs(next - x[i]));
        x_last[i] = std::exchange(x[i], next);
      }
      rail_last = rail;
      if (most < kClose) return;
    }
  }

 private:
  /// Of the rail below [-]; level where there is none.
  std::vector<double> rail_slope(const std::vector<double>& x) const {
    std::vector<Vec2> below(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec3 p = X_TU_.apply({x[i], y_[i], std::sqrt(std::max(0.0, radius_[i] * radius_[i] - x[i] * x[i]))});
      below[i] = std::isnan(p.z()) ? Vec2(0.0, 0.0) : Vec2(p.x(), p.y());
    }
    std::vector<double> z(x.size()), dzdx(x.size());
    bodies_.rail->heights_at(bodies_.X_TR.inverse(), below, {z, dzdx, {}});
    for (double& s : dzdx)
      if (std::isnan(s)) s = 0.0;
    return dzdx;
  }

  double better(std::size_t i, double x, double rail, double x_last, double rail_last, double& low,
                double& high) const {
    const Mat3& M = X_TU_.rotation;
    const double across = radius_[i] * slope_[i], down = std::sqrt(std::max(0.0, radius_[i] * radius_[i] - x * x));
    // The wheel's normal in T is (along, ., up): along + up * slope of the rail vanishes.
    const double up = x * M(2, 0) - across * M(2, 1) + down * M(2, 2);
    const double mismatch = x * M(0, 0) - across * M(0, 1) + down * M(0, 2) + up * rail;
    (mismatch > 0.0 ? high : low) = x;
    const double limit = 0.5 / up;  // a rail as strongly bent as that is an edge
    const double bend = x != x_last ? std::clamp((rail - rail_last) / (x - x_last), -limit, limit) : 0.0;
    const double next = x - mismatch / (M(0, 0) + up * bend);
    return next > low && next < high ? next : 0.5 * (low + high);
  }

  const BodyPair& bodies_;
  const Pose& X_TU_;
  std::span<const double> y_, radius_, slope_;
};

Line line_of(const BodyPair& bodies, double nominal_radius) {
  const double lowest = lowest_angle(bodies.X_TW);
  const std::shared_ptr<const ProfileLines> lines =
      bodies.wheel_lines ? bodies.wheel_lines : std::make_shared<ProfileLines>(profile_lines(*bodies.wheel, lowest));
  const auto& [y, radius, slope] = *lines;

  const Pose X_TU = bodies.X_TW * Pose{Vec3::Zero(), rotation_y(lowest)};
  const Mat3& M = X_TU.rotation;
  const double farthest = 0.5 * nominal_radius;
  std::vector<double> x(y.size(), 0.0);
  for (std::size_t i = 0; i < y.size(); ++i)
    if (!std::isnan(radius[i]) && !std::isnan(slope[i]))
      x[i] = std::clamp((radius[i] * slope[i] * M(0, 1) - nominal_radius * M(0, 2)) / M(0, 0), -farthest, farthest);
  if (bodies.rail && !ContactLocus::applies(bodies)) CommonSlope(bodies, X_TU, y, radius, slope).find(x, farthest);
  Line line;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (std::isnan(radius[i]) || std::isnan(slope[i])) continue;
    line.profile.emplace_back(y[i], radius[i]);
    line.points.push_back(X_TU.apply({x[i], y[i], std::sqrt(radius[i] * radius[i] - x[i] * x[i])}));
  }
  return line;
}

/// Drops points that have jumped along the track away from their neighbours, as onto the steep flank of a section.
void drop_strays(Line& line) {
  constexpr std::size_t kBeside = 4;
  constexpr double kJump = 10e-3;  // [m]
  const std::vector<Vec3> all = line.points;
  std::vector<double> near;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    near.clear();
    for (std::size_t k = i - std::min(i, kBeside); k <= std::min(i + kBeside, all.size() - 1); ++k)
      near.push_back(all[k].x());
    if (std::abs(all[i].x() - median_of(near)) > kJump) continue;
    line.profile[kept] = line.profile[i];
    line.points[kept++] = all[i];
  }
  line.profile.resize(kept);
  line.points.resize(kept);
}

/// Keeps the points from the middle outwards over which y of T increases, and passes over few that go back.
void keep_increasing(Line& line) {
  constexpr std::size_t kPassedOver = 10;
  const std::size_t n = line.points.size();
  if (n < 2) return;
  double mean = 0.0;
  for (const Vec3& p : line.points) mean += p.y() / static_cast<double>(n);
  const auto nearest = ranges::min_element(line.points, {}, [&](const Vec3& p) { return std::abs(p.y() - mean); });
  const auto middle = static_cast<std::size_t>(nearest - line.points.begin());
  std::vector<char> keep(n, 0);
  keep[middle] = 1;
  const auto walk = [&](std::size_t count, double sign, auto index) {
    double last = line.points[middle].y();
    for (std::size_t k = 1, passed = 0; k <= count && passed <= kPassedOver; ++k) {
      const std::size_t i = index(k);
      const bool goes_on = sign * (line.points[i].y() - last) > 0.0;
      passed = goes_on ? 0 : passed + 1;
      if (goes_on) keep[i] = 1, last = line.points[i].y();
    }
  };
  walk(middle, -1.0, [&](std::size_t k) { return middle - k; });
  walk(n - 1 - middle, 1.0, [&](std::size_t k) { return middle + k; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (keep[i] == 0) continue;
    line.profile[kept] = line.profile[i];
    line.points[kept++] = line.points[i];
  }
  line.profile.resize(kept);
  line.points.resize(kept);
}

/// Ends of the line and sharp corners with nothing but gentle turns about them.
std::vector<std::size_t> section_ends(const std::vector<Vec2>& profile, const std::vector<double>& steps) {
  const std::size_t n = profile.size();
  std::vector<double> turn(n, 0.0), s(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) s[i] = s[i - 1] + steps[i - 1];
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec2 a = profile[i] - profile[i - 1], b = profile[i + 1] - profile[i];
    turn[i] = std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  }
  std::vector<std::size_t> ends{0};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (!(turn[i] > kKinkHigh)) continue;
    bool alone = true;
    for (std::size_t k = i; k-- > 0 && s[i] - s[k] <= kKinkWidth;) alone = alone && turn[k] <= kKinkLow;
    for (std::size_t k = i + 1; k < n && s[k] - s[i] <= kKinkWidth; ++k) alone = alone && turn[k] <= kKinkLow;
    if (alone) ends.push_back(i);
  }
  ends.push_back(n - 1);
  return ends;
}

}  // namespace

WheelLocus::WheelLocus(const BodyPair& bodies, double nominal_radius) {
  Line line = line_of(bodies, nominal_radius);
  drop_strays(line);
  keep_increasing(line);
  if (line.points.size() < 2) return;
  for (std::size_t i = 0; i + 1 < line.profile.size(); ++i)
    steps_.push_back((line.profile[i + 1] - line.profile[i]).norm());
  points_ = std::move(line.points);
  const std::vector<std::size_t> ends = section_ends(line.profile, steps_);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const std::size_t first = ends[k], steps = ends[k + 1] - ends[k];
    const std::vector<Vec3> bends =
        natural_bends<Vec3>(std::span(points_).subspan(first, steps + 1), std::span(steps_).subspan(first, steps));
    bends_start_.insert(bends_start_.end(), bends.begin(), bends.end() - 1);
    bends_end_.insert(bends_end_.end(), bends.begin() + 1, bends.end());
  }
}

std::vector<Vec2> WheelLocus::over(const std::vector<double>& y) const {
  constexpr int kMost = 60;
  constexpr double kClose = 1e-15;
  std::vector<Vec2> found(y.size(), {kNaN, kNaN});
  std::size_t i = 0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    while (i + 2 < points_.size() && points_[i + 1].y() < y[k]) ++i;
    if (steps_.empty() || y[k] < points_[i].y() || y[k] > points_[i + 1].y()) continue;
    const double start = points_[i].y(), end = points_[i + 1].y(), a = bends_start_[i].y(), b = bends_end_[i].y();
    double low = 0.0, high = 1.0, f = (y[k] - start) / (end - start);
    for (int step = 0; step < kMost; ++step) {
      const double g = 1.0 - f, h = steps_[i] * steps_[i] / 6.0,
                   miss = natural_point(start, end, a, b, steps_[i], f) - y[k];
      const double newton = miss / (end - start + h * ((1.0 - 3.0 * g * g) * a + (3.0 * f * f - 1.0) * b));
      if (std::abs(newton) <= kClose) break;
      (miss < 0.0 ? low : high) = f;
      const double next = f - newton;
      f = next > low && next < high ? next : 0.5 * (low + high);
    }
    const Vec3 p = natural_point(points_[i], points_[i + 1], bends_start_[i], bends_end_[i], steps_[i], f);
    found[k] = {p.x(), p.z()};
  }
  return found;
}

}  // namespace treadmark::detection
