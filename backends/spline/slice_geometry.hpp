// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/backends/spline/slice_net.hpp"
#include "treadmark/backends/spline/surface_derivatives.hpp"
#include "treadmark/backends/spline/wheel_view.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// One coordinate of the surface in a plane frame and its derivatives by u and v.
struct PlaneCoordinate {
  double value, by_u, by_v;
};

/// Rail: p = (u, y, w).
class RailGeometry {
 public:
  static constexpr double kStepU = 2e-8;  // [m]
  static constexpr double kLargestStepU = 1.0;

  class Axis {
   public:
    Axis(const Vec3& direction, const Vec3& origin) : d_(direction), origin_(direction.dot(origin)) {}
    void set_reference(double) {}
    PlaneCoordinate of(double u, double, double, const NetValue& p) const {
      return {d_.x() * u + d_.y() * p.value.y + d_.z() * p.value.w - origin_, d_.x() + d_.y() * p.by_u.y + d_.z() * p.by_u.w,
              d_.y() * p.by_v.y + d_.z() * p.by_v.w};
    }

   private:
    Vec3 d_;
    double origin_;
  };
  // Nothing to prepare for an argument.
  static void sine_cosine(double, double& sine, double& cosine) { sine = cosine = 0.0; }

  explicit RailGeometry(double) {}

  static bool lines_along_y(const Mat3& axes) { return std::abs(axes(0, 0)) >= std::abs(axes(0, 1)); }
  /// u near the cut "across . (p - origin) = c" for a first guess.
  double guess_u(const Vec3& across, const Vec3&, const Vec3& origin, double c) const {
    return (c + across.dot(origin)) / across.x();
  }
  SurfaceDerivatives derivatives(double u, const NetValue& p, const NetSecond& s) const {
    return {{u, p.value.y, p.value.w},      {1.0, p.by_u.y, p.by_u.w},      {0.0, p.by_v.y, p.by_v.w},
            {0.0, s.by_uu.y, s.by_uu.w}, {0.0, s.by_uv.y, s.by_uv.w}, {0.0, s.by_vv.y, s.by_vv.w}};
  }
};

/// Wheel: p = (w sin u, y, w cos u), w the radius.
class WheelGeometry {
 public:
  static constexpr double kStepU = 4e-8;  // [rad]
  static constexpr double kLargestStepU = 0.2;

  /// Angles near a reference need no trigonometric functions: reference + small.
  class Axis {
   public:
    Axis(const Vec3& direction, const Vec3& origin) : d_(direction), origin_(direction.dot(origin)) {}
    void set_reference(double u) {
      radial_ = d_.x() * std::sin(u) + d_.z() * std::cos(u);
      tangential_ = d_.x() * std::cos(u) - d_.z() * std::sin(u);
    }
    PlaneCoordinate of(double, double sine, double cosine, const NetValue& p) const {
      const double radial = radial_ * cosine + tangential_ * sine, tangential = tangential_ * cosine - radial_ * sine;
      return {radial * p.value.w + d_.y() * p.value.y - origin_,
              tangential * p.value.w + radial * p.by_u.w + d_.y() * p.by_u.y, radial * p.by_v.w + d_.y() * p.by_v.y};
    }

   private:
    Vec3 d_;
    double origin_, radial_ = 0.0, tangential_ = 0.0;
  };
  static void sine_cosine(double x, double& sine, double& cosine) {
    if (std::abs(x) < kSmallAngle) {
      const double q = x * x;
      sine = x * (1.0 - q * (1.0 / 6.0) * (1.0 - q * (1.0 / 20.0) * (1.0 - q * (1.0 / 42.0) * (1.0 - q * (1.0 / 72.0)))));
      cosine = 1.0 - q * 0.5 * (1.0 - q * (1.0 / 12.0) * (1.0 - q * (1.0 / 30.0) * (1.0 - q * (1.0 / 56.0))));
    } else {
      sine = std::sin(x);
      cosine = std::cos(x);
    }
  }

  explicit WheelGeometry(double nominal_radius) : radius_(nominal_radius) {}

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
  static constexpr double kSmallAngle = 0.05;  // series good to 1e-17
  double radius_;
};

}  // namespace treadmark::spline
