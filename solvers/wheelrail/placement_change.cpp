// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/placement_change.hpp"

#include <cmath>
#include <optional>

#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {
namespace {

/// Where a section is highest, by halves between places where it rises and falls.
std::optional<double> top_of(const Surface& rail, const Pose& X_RT, double x, double near) {
  constexpr double kBeside = 2.5e-4;  // [m], more than points of sections are apart
  constexpr int kHalves = 60;
  const auto slope = [&](double y) {
    const Vec2 at(x, y);
    double dzdy = 0.0;
    rail.heights_at(X_RT, {&at, 1}, {{}, {}, {&dzdy, 1}});
    return dzdy;
  };
  double low = near - kBeside, high = near + kBeside;
  if (!(slope(low) < 0.0 && slope(high) > 0.0)) return std::nullopt;
  for (int i = 0; i < kHalves; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

PlacementChange placement_change(const Geometry& geometry, const Problem& p) {
  PlacementChange out;
  if (p.wheelset.tape_line) out.wheel_z.push_back({Pose{}, {Vec2(0.0, *p.wheelset.tape_line)}, {-1.0}});
  const Track& track = p.track;
  if (!track.gauge_based) return out;
  const Surface& rail = *geometry.rail;
  const Box3 box = rail.bounds();
  const double x = p.roller || (box.min.x() <= 0.0 && box.max.x() >= 0.0) ? 0.0 : p.state.position.x;
  const double cant = p.roller ? 0.0 : track.cant;
  const Pose X_RT{Vec3::Zero(), rotation_x(cant)};
  const GaugePoint gauge = gauge_point(rail, cant, track, x);
  const std::optional<double> top = top_of(rail, X_RT, x, gauge.near_top);
  if (!top) {
    out.message = "the rail is held by its top, which is not at one place";
    return out;
  }
  if (!p.roller) out.rail_z.push_back({X_RT, {Vec2(x, *top)}, {-1.0}});

  // the gauge point, seen from aside: its side moves along its normal, and on it the depth below the top stays
  constexpr double kTilt = 0.8, kSame = 1e-6, kUpright = 1e-3;
  const double z = height_at(rail, X_RT, {x, gauge.y});
  const Pose X_RG{X_RT.apply({x, gauge.y, z}), X_RT.rotation * rotation_x(-kTilt)};
  const Vec2 here = Vec2::Zero();
  SurfacePoint at;
  rail.locate(X_RG, {&here, 1}, {&at, 1});
  const Vec3 normal = X_RT.rotation.transpose() * at.normal_S;
  const bool at_depth = std::abs(z - gauge.z_top - track.gauge_height) < kSame,
             upright = std::abs(normal.z()) < kUpright;
  if (at.status == LocateStatus::outside || !((at.position_S - X_RG.origin).norm() < kSame) || !(at_depth || upright) ||
      !(std::abs(normal.y()) > kUpright)) {
    out.message = "the rail is held by its gauge point, which is no place on its side";
    return out;
  }
  out.rail_y.push_back({X_RG, {here}, {-X_RG.rotation.col(2).dot(at.normal_S) / normal.y()}});
  if (at_depth) out.rail_y.push_back({X_RT, {Vec2(x, *top)}, {normal.z() / normal.y()}});
  return out;
}

}  // namespace treadmark::wheelrail
