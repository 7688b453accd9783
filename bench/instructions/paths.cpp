// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/instructions/paths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_scene.hpp"
#include "treadmark/app/bench/check_surface.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/bench/instructions/import_paths.hpp"
#include "treadmark/bench/solvers/solver_cases.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/undeformed_distance.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::bench {
namespace {

// Small, because all of it is set up under a simulator.
constexpr double kResolution = 2e-3;  // of samples [m]
constexpr app::BenchGrid kGrid{0.5e-3, 6000};
constexpr const char* kDetectionBackends[] = {"analytic", "spline", "mesh", "offset"};

const app::BenchScene& scene() {
  static const app::BenchScene the_scene = app::make_bench_scene(app::bench_case(), kGrid);
  return the_scene;
}

double resolution_of(const std::string& backend) { return backend_of(backend).resample ? kResolution : 0.0; }

const Surface& surface(const std::string& backend, Body body) {
  static std::map<std::pair<std::string, Body>, std::shared_ptr<const Surface>> known;
  auto& entry = known[{backend, body}];
  const Region& region = body == Body::rail ? scene().regions.rail : scene().regions.wheel;
  if (!entry) entry = represent(scene().natural(body), {backend, resolution_of(backend), region}).surface;
  return *entry;
}

detection::BodyPair bodies(const std::string& backend) {
  detection::BodyPair pair = scene().bodies;
  pair.rail = &surface(backend, Body::rail);
  pair.wheel = &surface(backend, Body::wheel);
  return pair;
}

MeasuredPath heights(const std::string& backend, Body body, bool tilted) {
  const Surface* s = &surface(backend, body);
  const app::BenchView* view = &scene().view(body);
  const PlaneGrid plane{tilted ? view->tilted.X_SP : view->level.X_SP, view->grid};
  const auto z = std::make_shared<std::vector<double>>(view->grid.size());
  return {"point", z->size(),
          [s, plane, z] {
            s->heights(plane, {*z, {}, {}});
          },
          [s, view, backend] { return app::check_surface(*s, *view, resolution_of(backend)).reason; }};
}

MeasuredPath search(const std::string& backend, bool cold) {
  const detection::BodyPair pair = bodies(backend);
  const auto check = [pair] { return app::check_search(pair, scene().search); };
  if (cold) return {"search", 1, [pair] { detection::ContactSearch(pair, scene().search).at(0.0); }, check};
  const auto made = std::make_shared<detection::ContactSearch>(pair, scene().search);
  made->at(0.0);
  const auto further = std::make_shared<bool>(false);  // never twice the same position
  const auto run = [made, further] {
    *further = !*further;
    made->at(*further ? app::kWarmStep : 2.0 * app::kWarmStep);
  };
  return {"search", 1, run, check};
}

MeasuredPath distance(const std::string& backend) {
  const detection::BodyPair pair = bodies(backend);
  return {"element", scene().contact_grid.size(),
          [pair] { detection::undeformed_distance(pair, scene().X_TC, scene().contact_grid); },
          [pair] { return app::check_distance(pair, scene().X_TC, scene().contact_grid); }};
}

/// What is wrong with a solution of the normal problem.
std::string check_normal(const kalker::ContactProblem& problem, const kalker::ContactSolution& solution) {
  const double room = 1e-4 * problem.approach;
  for (std::size_t i = 0; i < solution.pressure.size(); ++i) {
    const double deformed = problem.gap[i] - problem.approach + solution.displacement_n[i];
    if (solution.pressure[i] < 0.0 || deformed < -room || (solution.pressure[i] > 0.0 && deformed > room))
      return "contact conditions are violated";
  }
  return solution.elements_contact > 0 ? "" : "no contact";
}

MeasuredPath normal() {
  const auto distance = std::make_shared<const detection::UndeformedDistance>(
      detection::undeformed_distance(scene().bodies, scene().X_TC, scene().contact_grid));
  kalker::ContactProblem problem;
  problem.grid = scene().contact_grid;
  problem.gap = distance->distance;
  problem.force_prescribed = false;
  problem.approach = distance->approach;
  const auto solve = [distance, problem] { return kalker::ContactSolver().solve_normal(problem); };
  return {"solve", 1, [solve] { solve(); }, [problem, solve] { return check_normal(problem, solve()); }};
}

/// A contact of many elements, cold: a Hertzian one, whose pressures are known.
MeasuredPath large(bool tangential) {
  constexpr int kAcross = 142;
  const auto hertz =
      std::make_shared<const HertzCase>(tangential ? kAcross / 2 : kAcross, creepage_regimes()[1].creepage);
  const auto check = [hertz, tangential]() -> std::string {
    kalker::ContactSolver solver;
    kalker::ContactSolution s = solver.solve_normal(hertz->problem);
    const kalker::HertzShape& h = hertz->shape;
    const double highest = 1.5 * h.force / (std::numbers::pi * h.semi_axis_x * h.semi_axis_y);
    if (!(std::abs(s.max_pressure / highest - 1.0) < 0.01)) return "not the pressure of Hertz";
    if (!tangential) return "";
    solver.solve_tangential(hertz->problem, s);
    return s.status == Status::ok && s.elements_slip > 0 && hertz->saturation(s) < 1.0 ? "" : "friction is not bounded";
  };
  if (!tangential) return {"solve", 1, [hertz] { kalker::ContactSolver().solve_normal(hertz->problem); }, check};
  const auto normal =
      std::make_shared<const kalker::ContactSolution>(kalker::ContactSolver().solve_normal(hertz->problem));
  const auto run = [hertz, normal] {
    kalker::ContactSolution s = *normal;
    kalker::ContactSolver().solve_tangential(hertz->problem, s);
  };
  return {"solve", 1, run, check};
}

/// Building a mesh of a body.
MeasuredPath build(Body body) {
  const auto run = [body] {
    const Region& region = body == Body::rail ? scene().regions.rail : scene().regions.wheel;
    return represent(scene().natural(body), {"mesh", kResolution, region}).surface;
  };
  const auto check = [run, body] { return app::check_surface(*run(), scene().view(body), kResolution).reason; };
  return {"surface", 1, [run] { run(); }, check};
}

/// The scene without the rail's damage, the wheel with its flat or round, on elements of 0.5 mm.
struct PairScene {
  explicit PairScene(bool flat) {
    auto input = std::get<io::WheelRailCase>(app::bench_case().cases.front().content);
    input.rail.defects = {};
    if (!flat) input.wheel.defects = {};
    input.discretisation.dx = input.discretisation.ds = 0.5e-3;
    const auto surface_of = [&](const auto& source, Body body) {
      return app::read_surface(source, body, app::profile_radius(input, body)).surface;
    };
    geometry = {surface_of(input.rail, Body::rail), surface_of(input.wheel, Body::wheel), true, !flat};
    problem = app::to_problem(input, !flat);
  }
  wheelrail::Geometry geometry;
  wheelrail::Problem problem;
};

/// A case with a prescribed vertical force by a pair that has its coefficients. after_another: from the solution
/// before.
MeasuredPath whole_case(bool flat, bool after_another) {
  const PairScene made(flat);
  const auto pair = std::make_shared<wheelrail::Pair>(made.geometry);
  wheelrail::Problem problem = made.problem;
  pair->solve(problem);
  if (after_another) problem.history = kalker::HistoryUse::keep_going;
  const auto check = [pair, problem]() -> std::string {
    const wheelrail::PairSolution solution = pair->solve(problem);
    const double force = *problem.vertical_force, miss = solution.load.track.force.z() - force;
    return solution.status == Status::ok && std::abs(miss) <= 1e-4 * force ? "" : "the force is not the prescribed one";
  };
  // Never twice the same problem.
  const auto further = std::make_shared<bool>(false);
  const auto run = [pair, problem, further, after_another] {
    wheelrail::Problem p = problem;
    *further = !*further;
    if (*further) p.state.position.y += after_another ? 1e-5 : 1e-4;
    pair->solve(p);
  };
  return {"case", 1, run, check};
}

/// Steps of transient rolling over the flat at a given height, as simulations take them.
MeasuredPath rolling() {
  constexpr int kSteps = 5;
  const PairScene made(true);
  wheelrail::Problem problem = made.problem;
  problem.state.position.z = wheelrail::Pair(made.geometry).solve(problem).z;
  problem.regime = kalker::Regime::transient;
  problem.vertical_force.reset();
  problem.discretisation.usual_dq_relative = 1.0;
  const auto pair = std::make_shared<wheelrail::Pair>(made.geometry);
  const auto roll = [pair, problem] {
    wheelrail::Problem p = problem;
    std::vector<wheelrail::PairSolution> steps;
    for (int i = 0; i < kSteps; ++i) {
      steps.push_back(pair->solve(p));
      p.history = kalker::HistoryUse::keep_going;
      p.discretisation.dq_relative = 1.0 + 1e-4 * i;
      const double travelled = p.discretisation.dq_relative * p.discretisation.dx;
      p.state.position.x += travelled;
      p.state.position.pitch -= travelled / p.wheelset.nominal_radius;
    }
    return steps;
  };
  const auto check = [roll, load = *made.problem.vertical_force]() -> std::string {
    for (const wheelrail::PairSolution& step : roll())
      if (step.status != Status::ok || !(std::abs(step.load.track.force.z() - load) < 0.5 * load))
        return "a step has an unlikely force";
    return "";
  };
  return {"step", kSteps, [roll] { roll(); }, check};
}

/// Not left out of this build.
bool has_backend(std::string_view backend) { return ranges::count(backend_names(), backend) != 0; }

struct Entry {
  std::string name;
  std::function<MeasuredPath()> make;
};

std::vector<Entry> make_entries() {
  std::vector<Entry> all;
  for (const Body body : {Body::wheel, Body::rail})
    for (const std::string_view name : backend_names()) {
      if (backend_of(name).one_place) continue;  // elsewhere its heights are those of another shape
      for (const bool tilted : {false, true}) {
        const std::string backend(name);
        all.push_back({std::string("heights/") + (body == Body::rail ? "rail/" : "wheel/") + backend +
                           (tilted ? "/tilted" : "/level"),
                       [=] { return heights(backend, body, tilted); }});
      }
    }
  for (const std::string backend : kDetectionBackends) {
    if (!has_backend(backend)) continue;
    all.push_back({"search/cold/" + backend, [=] { return search(backend, true); }});
    all.push_back({"search/warm/" + backend, [=] { return search(backend, false); }});
    all.push_back({"distance/" + backend, [=] { return distance(backend); }});
  }
  all.push_back({"normal", normal});
  all.push_back({"large/normal", [] { return large(false); }});
  all.push_back({"large/tangential", [] { return large(true); }});
  for (const Body body : {Body::wheel, Body::rail})
    if (has_backend("mesh"))
      all.push_back(
          {std::string("build/mesh/") + (body == Body::rail ? "rail" : "wheel"), [=] { return build(body); }});
  for (const std::string& kind : import_kinds())
    all.push_back({"import/" + kind, [=] { return import_path(*scene().rail->surface, kind); }});
  for (const bool flat : {false, true})
    for (const bool after : {false, true})
      all.push_back({std::string("case/") + (flat ? "flat" : "round") + (after ? "/after_another" : ""),
                     [=] { return whole_case(flat, after); }});
  all.push_back({"rolling", rolling});
  return all;
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = make_entries();
  return all;
}

}  // namespace

const std::vector<std::string>& path_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Entry& e : entries()) out.push_back(e.name);
    return out;
  }();
  return names;
}

MeasuredPath make_path(const std::string& name) {
  const auto found = std::find_if(entries().begin(), entries().end(), [&](const Entry& e) { return e.name == name; });
  if (found == entries().end()) throw std::invalid_argument("no path is named " + name);
  return found->make();
}

}  // namespace treadmark::bench
