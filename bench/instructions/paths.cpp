// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/instructions/paths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_scene.hpp"
#include "treadmark/app/bench/check_surface.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
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

/// A case with a prescribed vertical force on elements of 0.5 mm, by a pair that has its coefficients: the scene
/// without the rail's damage, the wheel with its flat or round.
MeasuredPath whole_case(bool flat) {
  auto input = std::get<io::WheelRailCase>(app::bench_case().cases.front().content);
  input.rail.defects = {};
  if (!flat) input.wheel.defects = {};
  input.discretisation.dx = input.discretisation.ds = 0.5e-3;
  const auto surface_of = [&](const auto& source, Body body) {
    return app::read_surface(source, body, app::profile_radius(input, body)).surface;
  };
  const auto pair = std::make_shared<wheelrail::Pair>(
      wheelrail::Geometry{surface_of(input.rail, Body::rail), surface_of(input.wheel, Body::wheel), true, !flat});
  const wheelrail::Problem problem = app::to_problem(input, !flat);
  pair->solve(problem);
  const auto check = [pair, problem]() -> std::string {
    const wheelrail::PairSolution solution = pair->solve(problem);
    const double force = *problem.vertical_force, miss = solution.load.track.force.z() - force;
    return solution.status == Status::ok && std::abs(miss) <= 1e-4 * force ? "" : "the force is not the prescribed one";
  };
  // Never twice the same problem.
  const auto further = std::make_shared<bool>(false);
  const auto run = [pair, problem, further] {
    wheelrail::Problem p = problem;
    *further = !*further;
    if (*further) p.state.position.y += 1e-4;
    pair->solve(p);
  };
  return {"case", 1, run, check};
}

struct Entry {
  std::string name;
  std::function<MeasuredPath()> make;
};

std::vector<Entry> make_entries() {
  std::vector<Entry> all;
  for (const Body body : {Body::wheel, Body::rail})
    for (const std::string_view name : backend_names())
      for (const bool tilted : {false, true}) {
        const std::string backend(name);
        all.push_back({std::string("heights/") + (body == Body::rail ? "rail/" : "wheel/") + backend +
                           (tilted ? "/tilted" : "/level"),
                       [=] { return heights(backend, body, tilted); }});
      }
  for (const std::string backend : kDetectionBackends) {
    if (std::ranges::count(backend_names(), backend) == 0) continue;  // left out of this build
    all.push_back({"search/cold/" + backend, [=] { return search(backend, true); }});
    all.push_back({"search/warm/" + backend, [=] { return search(backend, false); }});
    all.push_back({"distance/" + backend, [=] { return distance(backend); }});
  }
  all.push_back({"normal", normal});
  all.push_back({"case/round", [] { return whole_case(false); }});
  all.push_back({"case/flat", [] { return whole_case(true); }});
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
