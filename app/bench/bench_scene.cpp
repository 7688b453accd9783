// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/bench/bench_scene.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/stopwatch.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/search_window.hpp"

namespace treadmark::app {

namespace {

std::shared_ptr<const NaturalSurface> as_given(io::SurfaceSource source, Body body, double nominal_radius,
                                               double& seconds) {
  source.backend.clear();
  source.resolution = 0.0;
  const Stopwatch watch(seconds);
  return std::make_shared<const NaturalSurface>(read_surface(source, body, nominal_radius));
}

std::shared_ptr<const Surface> without_defects(const NaturalSurface& natural) {
  const auto& shape = natural.spec.shape;
  if (std::holds_alternative<SliceSet>(shape) || std::holds_alternative<TriangleMesh>(shape) ||
      std::holds_alternative<SplineSurface>(shape) || std::holds_alternative<SolidShape>(shape))
    return nullptr;
  SurfaceSpec spec = natural.spec;
  spec.defects = {};
  return create_natural(std::move(spec)).surface;
}

const wheelrail::PatchSolution& main_patch(const wheelrail::PairSolution& solution) {
  return *std::max_element(solution.patches.begin(), solution.patches.end(),
                           [](const auto& a, const auto& b) { return a.force_C.norm() < b.force_C.norm(); });
}

}  // namespace

BenchScene make_bench_scene(const io::CaseFile& file, const BenchGrid& grid) {
  const io::WheelRailCase* input = first_wheelrail_case(file);
  if (input == nullptr)
    throw Error(ErrorKind::configuration, "there is no case of a wheel on a rail to be measured", {file.path.string()});

  BenchScene s;
  s.rail = as_given(input->rail, Body::rail, profile_radius(*input, Body::rail), s.rail_build_seconds);
  s.wheel = as_given(input->wheel, Body::wheel, profile_radius(*input, Body::wheel), s.wheel_build_seconds);
  s.rail_base = without_defects(*s.rail);
  s.wheel_base = without_defects(*s.wheel);
  io::CaseFile first;
  first.cases.emplace_back().content = *input;
  s.regions = sampled_regions(first);

  const wheelrail::Geometry geometry{s.rail->surface, s.wheel->surface, s.rail->constant_profile(),
                                     s.wheel->constant_profile()};
  wheelrail::Problem problem = to_problem(*input, geometry.round_wheel);
  if (problem.side == wheelrail::Side::left) problem = wheelrail::mirrored(problem);
  const wheelrail::PairSolution solution = wheelrail::Pair(geometry).solve(problem);
  if (solution.patches.empty())
    throw Error(ErrorKind::numerical, "wheel and rail do not touch in the first case: there is nothing to measure",
                {file.path.string()}, solution.message);
  const wheelrail::PatchSolution& patch = main_patch(solution);
  s.bodies = {s.rail->surface.get(), s.wheel->surface.get(), solution.placement.X_TS, solution.placement.X_TA};
  s.search = wheelrail::search_settings(geometry, problem, solution.placement);
  s.X_TC = patch.frame.X_TC;
  s.contact_grid = patch.grid;

  const wheelrail::LateralRange head =
      wheelrail::visible_range(*s.rail->surface, s.bodies.X_TR.inverse(), s.X_TC.origin.x());
  const auto view = [&](const Surface& surface, const Pose& X_TS) {
    const Vec3 contact_S = X_TS.apply_inverse(s.X_TC.origin);
    return make_bench_view(surface, contact_S, head.y_min - s.X_TC.origin.y(), head.y_max - s.X_TC.origin.y(), grid);
  };
  s.rail_view = view(*s.rail->surface, s.bodies.X_TR);
  s.wheel_view = view(*s.wheel->surface, s.bodies.X_TW);
  return s;
}

namespace {

constexpr RollYawPitch kTilt{0.05, 0.03, 0.02};

/// Looks straight at the surface: along z of a rail, along the radius of a wheel.
Pose level_pose(const Surface& surface, const Vec3& contact_S) {
  Pose level{contact_S, Mat3::Identity()};
  if (surface.facing() == Facing::down) level.rotation = rotation_y(std::atan2(contact_S.x(), contact_S.z()));
  return level;
}

BenchView::Plane seen(const Surface& surface, const Pose& X_SP, const Grid2& grid) {
  BenchView::Plane plane{X_SP, {}, {}, {}};
  for (auto* values : {&plane.z, &plane.dzdx, &plane.dzdy}) values->resize(grid.size());
  surface.heights({X_SP, grid}, {plane.z, plane.dzdx, plane.dzdy});
  return plane;
}

double largest_curvature(const Surface& surface, const Pose& X_SP, const Grid2& grid) {
  constexpr int kEvery = 8;
  std::vector<Vec2> points;
  for (int iy = 0; iy < grid.ny; iy += kEvery)
    for (int ix = 0; ix < grid.nx; ix += 2 * kEvery) points.emplace_back(grid.x(ix), grid.y(iy));
  std::vector<SurfacePoint> found(points.size());
  surface.locate(X_SP, points, found);
  double largest = 0.0;
  for (const SurfacePoint& p : found)
    if (p.status != LocateStatus::outside)
      largest = std::fmax(largest, std::fmax(std::abs(p.curvature_1), std::abs(p.curvature_2)));
  return largest;
}

}  // namespace

BenchView make_bench_view(const Surface& surface, const Vec3& contact_S, double y_before, double y_after,
                          const BenchGrid& size) {
  BenchView view;
  Grid2& g = view.grid;
  g.dx = g.dy = size.step;
  g.ny = std::max(3, to_whole<int>((y_after - y_before) / g.dy));
  g.nx = std::max(3, size.points / g.ny);
  g.x0 = -0.5 * (g.nx - 1) * g.dx;
  g.y0 = 0.5 * (y_before + y_after) - 0.5 * (g.ny - 1) * g.dy;
  const Pose level = level_pose(surface, contact_S);
  view.level = seen(surface, level, g);
  view.tilted = seen(surface, {level.origin, level.rotation * rotation(kTilt)}, g);
  view.largest_curvature = largest_curvature(surface, level, g);
  return view;
}

}  // namespace treadmark::app
