// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/bench_scene.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "treadmark/app/bench/bench_view.hpp"
#include "treadmark/app/read_surface.hpp"
#include "treadmark/app/wheelrail_case.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/search_window.hpp"

namespace treadmark::app {
namespace {

std::shared_ptr<const NaturalSurface> as_given(io::SurfaceSource source, Body body, double nominal_radius,
                                               double& seconds) {
  using Clock = std::chrono::steady_clock;
  source.backend.clear();
  source.resolution = 0.0;
  const auto start = Clock::now();
  auto natural = std::make_shared<const NaturalSurface>(read_surface(source, body, nominal_radius));
  seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return natural;
}

std::shared_ptr<const Surface> without_defects(const NaturalSurface& natural) {
  const auto& shape = natural.spec.shape;
  if (std::holds_alternative<SliceSet>(shape) || std::holds_alternative<TriangleMesh>(shape)) return nullptr;
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
  wheelrail::Problem problem = to_problem(*input, geometry.constant_profiles());
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

}  // namespace treadmark::app
