// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/position_picture.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::app {
namespace {

std::vector<Vec2> section(const Surface& surface, const Pose& X_TS, double x) {
  constexpr int kPoints = 600;
  const Pose X_ST = X_TS.inverse();
  const wheelrail::LateralRange range = wheelrail::visible_range(surface, X_ST, x);
  const double step = (range.y_max - range.y_min) / (kPoints - 1);
  std::vector<Vec2> out;
  if (!(step > 0.0)) return out;
  std::vector<double> z(kPoints);
  surface.heights({X_ST, {x, range.y_min, 1.0, step, 1, kPoints}}, {z, {}, {}});
  for (int i = 0; i < kPoints; ++i) out.emplace_back(range.y_min + i * step, z[static_cast<std::size_t>(i)]);
  return out;
}

}  // namespace

PositionSection position_section(const io::WheelRailCase& input, const wheelrail::Geometry& geometry) {
  wheelrail::Problem p = to_problem(input, geometry.constant_profiles());
  const bool left = p.side == Side::left, find_height = p.vertical_force.has_value();
  if (left) p = wheelrail::mirrored(std::move(p));
  p.side = Side::right;
  p.vertical_force.reset();
  p.longitudinal_force.reset();
  p.rail_springs.reset();
  p.damping.reset();
  p.thermal.reset();
  p.regime = Regime::frictionless;
  p.history = HistoryUse::start;
  if (find_height) p.state.position.z = 0.0;
  wheelrail::Placement placement = wheelrail::place(geometry, p);
  PositionSection out;
  out.least_gap = wheelrail::Pair(geometry).solve(p).least_gap;
  if (find_height && std::isfinite(out.least_gap)) {
    placement.X_TA.origin.z() += out.least_gap;
    out.least_gap = 0.0;
  }
  const double x = placement.X_TA.origin.x();
  out.rail = section(*geometry.rail, placement.X_TS, x);
  out.wheel = section(*geometry.wheel, placement.X_TA, x);
  if (left)
    for (auto* points : {&out.rail, &out.wheel}) {
      ranges::reverse(*points);
      for (Vec2& point : *points) point.x() = -point.x();
    }
  return out;
}

}  // namespace treadmark::app
