// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/curved_reference.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::detection {
namespace {

// The mean of two unit normals is shorter than 0.9 when they differ by more than this [rad].
constexpr double kDisagreement = 0.902;
constexpr double kLongestStep = 0.25e-3;
constexpr double kFar = 1.0;  // [m] where one side of it has no section, the other has none either

/// A point of the curve and its direction, in C.
struct CurvePoint {
  double y = 0.0, n = 0.0, angle = 0.0;
  bool straight = false;  ///< no surfaces to follow here
};

class MidCurve {
 public:
  MidCurve(const BodyPair& bodies, const Pose& X_TC)
      : bodies_(bodies), X_RC_(bodies.X_TR.inverse() * X_TC), X_WC_(bodies.X_TW.inverse() * X_TC) {}

  /// The curve at y in the frame of a point of it.
  CurvePoint beside(const CurvePoint& from, double y) const {
    const Pose X_CL{{0.0, from.y, from.n}, rotation_x(from.angle)};
    double n_rail = 0.0, slope_rail = 0.0, n_wheel = 0.0, slope_wheel = 0.0;
    const Vec2 point(0.0, y);
    bodies_.rail->heights_at(X_RC_ * X_CL, {&point, 1}, {{&n_rail, 1}, {}, {&slope_rail, 1}});
    bodies_.wheel->heights_at(X_WC_ * X_CL, {&point, 1}, {{&n_wheel, 1}, {}, {&slope_wheel, 1}});
    const double angle_rail = std::atan(slope_rail), angle_wheel = std::atan(slope_wheel);
    CurvePoint found = from;
    found.straight = !(std::abs(n_rail - n_wheel) >= 0.0) || !(std::abs(angle_rail - angle_wheel) <= kDisagreement);
    const double n = found.straight ? 0.0 : 0.5 * (n_rail + n_wheel);
    const Vec3 point_C = X_CL.apply({0.0, y, n});
    found.y = point_C.y();
    found.n = point_C.z();
    if (!found.straight) found.angle += 0.5 * (angle_rail + angle_wheel);
    return found;
  }

  /// The point of the curve at an arc length from another.
  CurvePoint at_arc_length(const CurvePoint& from, double length) const {
    CurvePoint found = beside(from, length);
    if (found.straight) return found;
    // The curve over the step is nearly a parabola: its length exceeds the step by half the mean squared slope.
    const double excess = excess_length(from, found, length);
    return beside(from, length * length / (length + excess));
  }

 private:
  static double excess_length(const CurvePoint& a, const CurvePoint& b, double step) {
    const double dy = b.y - a.y, dn = b.n - a.n, c = std::cos(a.angle), s = std::sin(a.angle);
    const double rise = -s * dy + c * dn, slope = std::tan(b.angle - a.angle);
    // Integral of the squared slope of the cubic with these ends, which starts along the step.
    const double squared = 1.2 * rise * rise / step - 0.2 * rise * slope + 2.0 / 15.0 * step * slope * slope;
    return 0.5 * squared;
  }

  BodyPair bodies_;
  Pose X_RC_, X_WC_;
};

}  // namespace

Pose ReferenceRows::X_CL(int iy) const {
  const ReferenceRow& row = rows[static_cast<std::size_t>(iy)];
  return {{-reference_C.x(), row.y, row.n}, rotation_x(row.angle)};
}

std::vector<double> ReferenceRows::angles() const {
  std::vector<double> result;
  for (const ReferenceRow& row : rows) result.push_back(row.angle);
  return result;
}

ReferenceRows plane_reference(const Grid2& grid, const Vec2& reference_C) {
  ReferenceRows plane{reference_C, {}};
  for (int iy = 0; iy < grid.ny; ++iy) plane.rows.push_back({grid.y(iy) - reference_C.y(), 0.0, 0.0});
  return plane;
}

ReferenceRows curved_reference(const BodyPair& bodies, const ContactFrame& frame, const Grid2& grid,
                               const Vec2& reference_C) {
  const MidCurve curve(bodies, frame.X_TC);
  ReferenceRows result{reference_C, std::vector<ReferenceRow>(static_cast<std::size_t>(grid.ny))};
  const CurvePoint start = curve.beside({}, 0.0);
  const auto arc_length = [&](int iy) { return grid.y(iy) - reference_C.y(); };
  const auto follow = [&](int first, int last, int direction) {
    CurvePoint point = start;
    double s = 0.0;
    for (int iy = first; iy != last; iy += direction) {
      const double way = arc_length(iy) - s;
      const int steps = std::max(1, to_whole<int>(std::ceil(std::abs(way) / kLongestStep - 1e-6)));
      for (int k = 0; k < steps && way != 0.0; ++k) {
        const double left = way * (steps - k) / steps;
        const bool at_once = point.straight && std::abs(left) > kFar;
        point = curve.at_arc_length(point, at_once ? left : way / steps);
        if (at_once) break;
      }
      s = arc_length(iy);
      result.rows[static_cast<std::size_t>(iy)] = {point.y, point.n, point.angle};
    }
  };
  int first_positive = 0;
  while (first_positive < grid.ny && arc_length(first_positive) < 0.0) ++first_positive;
  follow(first_positive, grid.ny, 1);
  follow(first_positive - 1, -1, -1);
  return result;
}

}  // namespace treadmark::detection
