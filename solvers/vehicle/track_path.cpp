// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track_path.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::vehicle {

namespace {

/// A shape, its integral from 0, and its derivatives, at u in [0, 1].
struct ShapeAt {
  double integral, value, first, second;
};
ShapeAt shape_at(TransitionShape shape, double u) {
  switch (shape) {
    case TransitionShape::linear:
      return {0.5 * u * u, u, 1.0, 0.0};
    case TransitionShape::rising:
      return {u * u * u / 3.0, u * u, 2.0 * u, 2.0};
    case TransitionShape::easing:
      return {u * u * (1.0 - u / 3.0), u * (2.0 - u), 2.0 - 2.0 * u, -2.0};
    case TransitionShape::bloss:
      break;
  }
  return {u * u * u * (1.0 - 0.5 * u), u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u), 6.0 - 12.0 * u};
}

Along along(const FromTo& ends, const ShapeAt& shape, double length) {
  const double rise = ends.to - ends.from;
  return {ends.from + rise * shape.value, rise * shape.first / length, rise * shape.second / (length * length)};
}

double turned(const LayoutElement& e, double x) {
  const ShapeAt shape = shape_at(e.shape, x / e.length);
  return e.curvature.from * x + (e.curvature.to - e.curvature.from) * e.length * shape.integral;
}

Vec2 along_circle(double curvature, double heading, double x) {
  const double half = 0.5 * curvature * x;
  const double sinc = std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  return x * sinc * Vec2(std::cos(heading + half), std::sin(heading + half));
}

/// Way from the beginning of an element, which has this heading, to x on it.
Vec2 way(const LayoutElement& e, double heading, double x) {
  if (e.curvature.from == e.curvature.to) return along_circle(e.curvature.from, heading, x);
  constexpr double kNodes[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                               0.9739065285171717};
  constexpr double kWeights[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159821, 0.1494513491505806,
                                 0.0666713443086881};
  constexpr double kTurnOfPanel = 0.5;  // [rad], for which ten points give all digits
  const double most = std::max(std::abs(e.curvature.from), std::abs(e.curvature.to));
  const int panels = std::max(1, to_whole<int>(std::ceil(most * x / kTurnOfPanel)));
  const double half = 0.5 * x / panels;
  Vec2 sum = Vec2::Zero();
  for (int p = 0; p < panels; ++p) {
    const double middle = (2 * p + 1) * half;
    for (std::size_t k = 0; k < std::size(kNodes); ++k)
      for (const double sign : {-1.0, 1.0}) {
        const double psi = heading + turned(e, middle + sign * half * kNodes[k]);
        sum += half * kWeights[k] * Vec2(std::cos(psi), std::sin(psi));
      }
  }
  return sum;
}

Along angle_of(const Along& cant, double base) {
  const double angle = std::asin(cant.value / base), cosine = std::cos(angle), first = cant.first / (base * cosine);
  return {angle, first, cant.second / (base * cosine) + first * first * std::tan(angle)};
}

}  // namespace

Pose PathPoint::X_LT() const { return {origin_L, rotation_z(heading) * rotation_x(cant_angle.value)}; }

Vec3 PathPoint::tangent_L() const { return {std::cos(heading), std::sin(heading), height.first}; }

Vec3 PathPoint::turn() const {
  const double phi = cant_angle.value;
  return {cant_angle.first, curvature.value * std::sin(phi), curvature.value * std::cos(phi)};
}

Vec3 PathPoint::turn_first() const {
  const double sine = std::sin(cant_angle.value), cosine = std::cos(cant_angle.value),
               product = curvature.value * cant_angle.first;
  return {cant_angle.second, curvature.first * sine + product * cosine, curvature.first * cosine - product * sine};
}

TrackPath::TrackPath(TrackLayout layout) : layout_(std::move(layout)) {
  check(layout_);
  Start start;
  for (const LayoutElement& e : layout_.elements) {
    starts_.push_back(start);
    const Vec2 moved = way(e, start.heading, e.length);
    start = {start.distance + e.length, start.x + moved.x(), start.y + moved.y(), start.heading + turned(e, e.length)};
  }
  starts_.push_back(start);
}

std::size_t TrackPath::element_at(double distance) const {
  const auto behind = std::upper_bound(starts_.begin(), starts_.end() - 1, distance,
                                       [](double d, const Start& start) { return d < start.distance; });
  return behind == starts_.begin() ? 0 : static_cast<std::size_t>(behind - starts_.begin()) - 1;
}

PathPoint TrackPath::at(double distance) const {
  std::size_t i = element_at(distance);
  const LayoutElement& given = layout_.elements[i];
  LayoutElement e{given.length, given.curvature, given.cant, given.gauge, given.shape, {}};
  const auto constant = [&e](double FromTo::*end) {
    for (FromTo* value : {&e.curvature, &e.cant, &e.gauge}) *value = {value->*end, value->*end};
  };
  if (distance < 0.0)
    constant(&FromTo::from);
  else if (distance >= length()) {
    constant(&FromTo::to);
    ++i;
  }
  const Start& start = starts_[i];
  const double x = distance - start.distance;
  const ShapeAt shape = shape_at(e.shape, x / e.length);
  PathPoint point;
  point.distance = distance;
  point.curvature = along(e.curvature, shape, e.length);
  point.cant = along(e.cant, shape, e.length);
  point.gauge = along(e.gauge, shape, e.length);
  point.heading = start.heading + turned(e, x);
  point.cant_angle = angle_of(point.cant, layout_.cant_base);
  if (layout_.cant_axis == CantAxis::low_rail) {
    const double half = e.cant.from + e.cant.to >= 0.0 ? -0.5 : 0.5;
    point.height = {half * point.cant.value, half * point.cant.first, half * point.cant.second};
  }
  const Vec2 moved = way(e, start.heading, x);
  point.origin_L = {start.x + moved.x(), start.y + moved.y(), point.height.value};
  return point;
}

Vec3 TrackPath::to_space(const PathPlace& place) const {
  return at(place.distance).X_LT().apply({0.0, place.y, place.z});
}

std::optional<PathPlace> TrackPath::locate(const Vec3& point_L, double near) const {
  constexpr int kMostSteps = 60;
  constexpr double kLongestStep = 50.0;  // [m], that the method does not run away on nearly parallel planes
  double s = near;
  for (int k = 0; k < kMostSteps; ++k) {
    const PathPoint p = at(s);
    const Vec3 away = point_L - p.origin_L;
    const double sine = std::sin(p.heading), cosine = std::cos(p.heading);
    const double ahead = away.x() * cosine + away.y() * sine, aside = away.y() * cosine - away.x() * sine;
    const double slope = 1.0 - p.curvature.value * aside;
    if (!(slope > 0.0)) return std::nullopt;
    const double step = std::clamp(ahead / slope, -kLongestStep, kLongestStep);
    s += step;
    if (std::abs(step) > 1e-12 * (1.0 + std::abs(s))) continue;
    const Vec3 p_T = at(s).X_LT().apply_inverse(point_L);
    return PathPlace{s, p_T.y(), p_T.z()};
  }
  return std::nullopt;
}

std::optional<PathPlace> TrackPath::locate(const Vec3& point_L) const {
  constexpr double kSpacing = 20.0, kTurn = 0.2;  // [m], [rad]
  double nearest = 0.0, least = (point_L - at(0.0).origin_L).squaredNorm();
  for (std::size_t i = 0; i < layout_.elements.size(); ++i) {
    const LayoutElement& e = layout_.elements[i];
    const double most = std::max(std::abs(e.curvature.from), std::abs(e.curvature.to));
    const int parts = to_whole<int>(std::ceil(e.length * std::max(1.0 / kSpacing, most / kTurn)));
    for (int k = 1; k <= parts; ++k) {
      const double s = starts_[i].distance + e.length * k / parts;
      const double distance = (point_L - at(s).origin_L).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = s;
      }
    }
  }
  return locate(point_L, nearest);
}

double TrackPath::largest_curvature_step() const {
  double largest = 0.0;
  for (std::size_t i = 1; i < layout_.elements.size(); ++i)
    largest = std::max(largest, std::abs(layout_.elements[i].curvature.from - layout_.elements[i - 1].curvature.to));
  return largest;
}

}  // namespace treadmark::vehicle
