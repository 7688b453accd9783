// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/backends/spline/slices/slice_net.hpp"
#include "treadmark/backends/spline/surface_derivatives.hpp"
#include "treadmark/backends/spline/wheel_view.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// Position and derivatives by u and v in a frame that suits the geometry; see point() of each.
struct TurnedPoint {
  double p[3], by_u[3], by_v[3];
};

/// A plane axis in the turned frame: its coordinate of a point p is direction . p - origin.
struct TurnedAxis {
  double x = 0.0, y = 0.0, z = 0.0, origin = 0.0;

  double of(const double (&p)[3]) const { return x * p[0] + y * p[1] + z * p[2]; }
};

/// Rail: p = (u, y, w).
class RailGeometry {
 public:
  static constexpr double kStepU = 1e-7;  // [m]
  static constexpr double kLargestStepU = 1.0;
  static constexpr double kLargestPrediction = 0.1;  // from one cut to the next
  static constexpr double kTurnsNormal = 0.0;
  static constexpr bool kTurns = false;

  explicit RailGeometry(double) {}

  /// The turned frame is the surface frame, whatever the reference.
  static TurnedAxis turned(const Vec3& axis, const Vec3& origin, double) {
    return {axis.x(), axis.y(), axis.z(), axis.dot(origin)};
  }
  static TurnedPoint point(double u, double, const NetValue& n) {
    return {{u, n.value.y, n.value.w}, {1.0, n.by_u.y, n.by_u.w}, {0.0, n.by_v.y, n.by_v.w}};
  }
  static bool lines_along_y(const Mat3& axes) { return std::abs(axes(0, 0)) >= std::abs(axes(0, 1)); }
  /// u near the cut "across . (p - origin) = c" for a first guess.
  double guess_u(const Vec3& across, const Vec3&, const Vec3& origin, double c) const {
    return (c + across.dot(origin)) / across.x();
  }
  SurfaceDerivatives derivatives(double u, const NetValue& p, const NetSecond& s) const {
    return {{u, p.value.y, p.value.w},   {1.0, p.by_u.y, p.by_u.w},   {0.0, p.by_v.y, p.by_v.w},
            {0.0, s.by_uu.y, s.by_uu.w}, {0.0, s.by_uv.y, s.by_uv.w}, {0.0, s.by_vv.y, s.by_vv.w}};
  }
};

/// Wheel: p = (w sin u, y, w cos u), w the radius.
class WheelGeometry {
 public:
  static constexpr double kStepU = 2e-7;  // [rad]
  static constexpr double kLargestStepU = 0.2;
  static constexpr double kLargestPrediction = 0.1;
  static constexpr double kTurnsNormal = 1.0;  // the radius turns with u
  static constexpr bool kTurns = true;

  explicit WheelGeometry(double nominal_radius) : radius_(nominal_radius) {}

  /// The turned frame has z towards the reference angle, so that the angle to it is small and needs no trigonometry.
  static TurnedAxis turned(const Vec3& axis, const Vec3& origin, double reference) {
    const double sine = std::sin(reference), cosine = std::cos(reference);
    return {axis.x() * cosine - axis.z() * sine, axis.y(), axis.x() * sine + axis.z() * cosine, axis.dot(origin)};
  }
  static TurnedPoint point(double u, double reference, const NetValue& n) {
    double sine, cosine;
    sine_cosine(u - reference, sine, cosine);
    const double x = n.value.w * sine, z = n.value.w * cosine;
    return {{x, n.value.y, z},
            {z + n.by_u.w * sine, n.by_u.y, n.by_u.w * cosine - x},
            {n.by_v.w * sine, n.by_v.y, n.by_v.w * cosine}};
  }

  static bool lines_along_y(const Mat3& axes) { return wheel_lines_along_y(axes); }
  /// On the half turned towards the plane; NaN if the cut misses the wheel.
  double guess_u(const Vec3& across, const Vec3& normal, const Vec3& origin, double c) const {
    const WheelView view(across, across, normal, origin);
    const double a = (c + view.across_origin) / view.across_e;
    return view.angle(a, std::sqrt(radius_ * radius_ - a * a));
  }
  SurfaceDerivatives derivatives(double u, const NetValue& p, const NetSecond& s) const {
    const Vec3 out(std::sin(u), 0.0, std::cos(u)), forward(out.z(), 0.0, -out.x()), axle(0.0, 1.0, 0.0);
    const double r = p.value.w;
    return {r * out + p.value.y * axle,
            r * forward + p.by_u.w * out + p.by_u.y * axle,
            p.by_v.w * out + p.by_v.y * axle,
            (s.by_uu.w - r) * out + 2.0 * p.by_u.w * forward + s.by_uu.y * axle,
            s.by_uv.w * out + p.by_v.w * forward + s.by_uv.y * axle,
            s.by_vv.w * out + s.by_vv.y * axle};
  }

 private:
  static constexpr double kSmallAngle = 0.02;  // series good to 1e-17
  static void sine_cosine(double x, double& sine, double& cosine) {
    if (std::abs(x) < kSmallAngle) {
      const double q = x * x;
      sine = x * (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q * (1.0 / 5040.0))));
      cosine = 1.0 - q * (0.5 - q * (1.0 / 24.0 - q * (1.0 / 720.0 - q * (1.0 / 40320.0))));
    } else {
      sine = std::sin(x);
      cosine = std::cos(x);
    }
  }

  double radius_;
};

}  // namespace treadmark::spline
