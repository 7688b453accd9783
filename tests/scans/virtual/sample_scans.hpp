// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"

namespace treadmark::scans::testing {

inline constexpr double kHeadRadius = 0.05, kHeadAngle = 1.2, kRailHalf = 0.2, kBallRadius = 0.46, kBallAngle = 0.15;

/// The upper side of a cylinder along x, 0.4 m of it: y^2 + (z - R)^2 = R^2.
inline std::shared_ptr<const Surface> round_rail() {
  return analytic::make_prismatic_surface(analytic::cylinder_chain(kHeadRadius, kHeadAngle));
}
inline ScannerSettings rail_settings(std::size_t points) {
  ScannerSettings s;
  s.u_min = -kRailHalf;
  s.u_max = kRailHalf;
  s.points = points;
  return s;
}
inline double off_rail(const Vec3& p) { return std::hypot(p.y(), p.z() - kHeadRadius) - kHeadRadius; }
inline double rail_area() { return 2.0 * kRailHalf * 2.0 * kHeadAngle * kHeadRadius; }

/// The middle of a ball as a wheel: |p| = R.
inline std::shared_ptr<const Surface> ball_wheel() {
  return analytic::make_revolved_surface(analytic::barrel_chain(kBallRadius, kBallAngle), kBallRadius);
}
inline ScannerSettings wheel_settings(std::size_t points) {
  ScannerSettings s;
  s.body = Body::wheel;
  s.nominal_radius = kBallRadius;
  s.points = points;
  return s;
}
/// A zone of a sphere (Archimedes).
inline double wheel_area() {
  return 2.0 * 3.14159265358979323846 * kBallRadius * 2.0 * kBallRadius * std::sin(kBallAngle);
}

/// A rail given by a formula z(x, y), NaN where there is none. It knows heights over planes that are only shifted.
class FormulaRail : public Surface {
 public:
  using Formula = std::function<double(double, double)>;
  FormulaRail(Formula z, Box3 box) : z_(std::move(z)), box_(box) {}

  std::string_view backend() const override { return "formula"; }
  Facing facing() const override { return Facing::up; }
  Box3 bounds() const override { return box_; }
  std::size_t memory_bytes() const override { return sizeof *this; }

 private:
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override {
    const Grid2& g = plane_grid.grid;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const double x = plane_grid.X_SP.origin.x() + g.x0 + ix * g.dx,
                     y = plane_grid.X_SP.origin.y() + g.y0 + iy * g.dy;
        const auto i = static_cast<std::size_t>(ix + g.nx * iy);
        const double z = z_(x, y), h = 1e-7;
        if (!out.z.empty()) out.z[i] = z;
        if (!out.dzdx.empty()) out.dzdx[i] = (z_(x + h, y) - z_(x - h, y)) / (2.0 * h);
        if (!out.dzdy.empty()) out.dzdy[i] = (z_(x, y + h) - z_(x, y - h)) / (2.0 * h);
      }
  }
  void do_locate(const Pose&, std::span<const Vec2>, std::span<SurfacePoint>) const override {}
  HeightBounds do_height_bounds(const Pose&, const Rectangle&) const override { return {}; }

  Formula z_;
  Box3 box_;
};

}  // namespace treadmark::scans::testing
