// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/surface_loads.hpp"

#include <cmath>
#include <vector>

namespace treadmark::wheelrail {
namespace {

/// A surface over the elements of a row that are in contact.
class Profile {
 public:
  void measure(const Surface& surface, const Pose& X_SL, const Grid2& row) {
    for (auto* field : {&z_, &by_x_, &by_y_}) field->resize(row.size());
    surface.heights({X_SL, row}, {z_, by_x_, by_y_});
  }
  /// In the plane where a surface has no height: distances need not come from these heights.
  Vec3 point(std::size_t i, double x) const { return {x, 0.0, std::isnan(z_[i]) ? 0.0 : z_[i]}; }
  /// Normal into the rail per area of the plane; that of the plane where a surface has none.
  Vec3 normal(std::size_t i) const {
    return std::isnan(by_x_[i] + by_y_[i]) ? Vec3(Vec3::UnitZ()) : Vec3(-by_x_[i], -by_y_[i], 1.0);
  }

 private:
  std::vector<double> z_, by_x_, by_y_;
};

/// Elements of a row from the first to the last one under pressure.
struct Span {
  int first = 0, count = 0;
};
Span pressed(const Grid2& grid, int iy, const std::vector<double>& pressure) {
  Span span;
  for (int ix = 0; ix < grid.nx; ++ix) {
    if (!(pressure[grid.index(ix, iy)] > 0.0)) continue;
    if (span.count == 0) span.first = ix;
    span.count = ix - span.first + 1;
  }
  return span;
}

Wrench moved(const Wrench& load, const Vec3& from_new_to_old) {
  return {load.force, load.moment + from_new_to_old.cross(load.force)};
}

}  // namespace

SurfaceLoads surface_loads(const Geometry& bodies, const Placement& placed, const MaterialVelocity& material,
                           const PatchSolution& s, const detection::ReferenceRows& rows, const SlipHeights& heights) {
  const kalker::ContactSolution& c = s.contact;
  const Grid2& g = s.grid;
  const Pose &X_TC = s.frame.X_TC, X_ST = placed.X_TS.inverse(), X_AT = placed.X_TA.inverse();
  const Vec3 axle_C = X_TC.apply_inverse(placed.X_TWs.origin);
  const bool tangential = !c.traction_x.empty();
  const double area = g.cell_area();
  SurfaceLoads out;
  Wrench traction, pressure_on_wheel, traction_on_wheel;  // the latter two about the axle
  Profile rail, wheel;
  for (int iy = 0; iy < g.ny; ++iy) {
    const auto [first, count] = pressed(g, iy, c.pressure);
    if (count == 0) continue;
    const Pose X_CL = rows.X_CL(iy), X_TL = X_TC * X_CL;
    const Grid2 row{g.x(first), 0.0, g.dx, g.dy, count, 1};
    rail.measure(*bodies.rail, X_ST * X_TL, row);
    wheel.measure(*bodies.wheel, X_AT * X_TL, row);
    const auto add = [&](Wrench& sum, const Vec3& about_C, const Vec3& point_L, const Vec3& force_L) {
      const Vec3 force = X_CL.rotation * force_L;
      sum += {force, (X_CL.apply(point_L) - about_C).cross(force)};
    };
    for (int k = 0; k < count; ++k) {
      const auto i = g.index(first + k, iy);
      const auto at = static_cast<std::size_t>(k);
      if (!(c.pressure[i] > 0.0)) continue;
      const double x = row.x(k), force = c.pressure[i] * area;
      add(out.pressure, Vec3::Zero(), rail.point(at, x), force * rail.normal(at));
      add(pressure_on_wheel, axle_C, wheel.point(at, x), force * wheel.normal(at));
      if (!tangential) continue;
      const Vec3 t = area * Vec3(c.traction_x[i], c.traction_y[i], 0.0),
                 by_rail(x, 0.0, heights.rail.empty() ? 0.0 : heights.rail[i]),
                 by_wheel(x, 0.0, heights.wheel.empty() ? s.approach : heights.wheel[i]);
      add(traction, Vec3::Zero(), by_rail, t);
      add(traction_on_wheel, axle_C, by_wheel, t);
      const Vec3 slip = material.rail.at(X_TL.apply(by_rail)) - material.wheel.at(X_TL.apply(by_wheel));
      out.slip_power -= t.dot(X_TL.rotation.transpose() * slip);
    }
  }
  out.rail = out.pressure;
  out.rail += traction;
  out.pressure_on_wheel = moved({out.pressure.force, pressure_on_wheel.moment}, axle_C);
  out.wheel = out.pressure_on_wheel;
  out.wheel += moved({traction.force, traction_on_wheel.moment}, axle_C);
  return out;
}

}  // namespace treadmark::wheelrail
