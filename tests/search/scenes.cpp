// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/search/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "treadmark/backends/create.hpp"

namespace treadmark::testing {
namespace {

constexpr double kRadius = 0.46;

SurfaceSpec damaged_rail() {
  SurfaceSpec spec{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  Squat squat;
  squat.length = 0.03, squat.width = 0.02, squat.depth = 0.4e-3, squat.x_center = 0.01;
  spec.defects.squats = {squat};
  return spec;
}

SurfaceSpec corrugated_rail() {
  SurfaceSpec spec{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  Corrugation waves;
  waves.waves = {{0.013, 0.1e-3, 0.4}, {0.031, 0.1e-3, 0.0}};
  waves.x_start = -0.05, waves.x_end = 0.05, waves.ramp = 0.01, waves.width = 0.06;
  spec.defects.corrugations = {waves};
  return spec;
}

// Three humps across, the middle one rising by a step within 3 mm of track.
SurfaceSpec stepped_rail() {
  SliceSet slices;
  for (double x = -0.06; x < 0.0601; x += 1e-3) {
    Profile p;
    for (double y = -0.034; y < 0.03401; y += 0.5e-3) {
      const double step = 0.5 * (1.0 + std::tanh((x - 0.006) / 1.5e-3));
      const double hump = std::exp(-std::pow(y / 6e-3, 2));
      p.y.push_back(y);
      p.z.push_back(y * y / 0.5 + 0.15e-3 * std::cos(2.0 * std::numbers::pi * y / 0.013) - 0.7e-3 * step * hump);
    }
    slices.u.push_back(x);
    slices.profiles.push_back(p);
  }
  return {Body::rail, 0.0, slices, {}};
}

SurfaceSpec flat_wheel() {
  SurfaceSpec spec{Body::wheel, kRadius, StandardProfile{"S1002"}, {}};
  WheelFlat flat;
  flat.length = 0.06, flat.depth = 0.7e-3, flat.width = 0.05, flat.y_center = 3e-3;
  WheelFlat fresh = flat;
  fresh.shape = WheelFlat::Shape::fresh;
  fresh.length = 0.03, fresh.depth = 0.0, fresh.theta_center = 0.07, fresh.y_center = -5e-3;
  spec.defects.flats = {flat, fresh};
  return spec;
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
bool maybe(std::mt19937& random, double share) { return uniform(random, 0.0, 1.0) < share; }

}  // namespace

Bodies bodies_in(std::string_view backend) {
  Bodies bodies;
  const auto add = [&](auto& list, const SurfaceSpec& spec, double u_half) {
    Representation wanted{std::string(backend), backend == "analytic" ? 0.0 : 1e-3, {}};
    wanted.region.u_min = -u_half, wanted.region.u_max = u_half;
    list.push_back(represent(create_natural(spec), wanted).surface);
  };
  add(bodies.rails, damaged_rail(), 0.06);
  add(bodies.rails, corrugated_rail(), 0.06);
  if (backend != "analytic") add(bodies.rails, stepped_rail(), 0.055);
  add(bodies.wheels, flat_wheel(), 0.25);
  return bodies;
}

detection::BodyPair random_pair(const Bodies& bodies, std::mt19937& random) {
  detection::BodyPair pair;
  pair.rail = bodies.rails[random() % bodies.rails.size()].get();
  pair.wheel = bodies.wheels[random() % bodies.wheels.size()].get();
  pair.X_TR = {{uniform(random, -0.02, 0.02), uniform(random, -0.01, 0.01), 0.0},
               rotation_x(uniform(random, -0.06, 0.06))};
  // Some over the edge of the rail, most near the middle.
  const double reach = maybe(random, 0.15) ? 0.07 : 0.012;
  pair.X_TW = {{uniform(random, -0.005, 0.005), uniform(random, -reach, reach), -kRadius},
               rotation({uniform(random, -0.03, 0.03), uniform(random, -0.03, 0.03), uniform(random, -0.12, 0.12)})};
  return pair;
}

detection::SearchSettings random_settings(const detection::BodyPair& pair, std::mt19937& random) {
  detection::SearchSettings s;
  const double half = uniform(random, 0.03, 0.09);
  s.grid_T.nx = std::uniform_int_distribution<int>(31, 81)(random);
  s.grid_T.ny = std::uniform_int_distribution<int>(31, 91)(random);
  s.grid_T.x0 = -half, s.grid_T.dx = 2.0 * half / (s.grid_T.nx - 1);
  const double y_half = uniform(random, 0.02, 0.04);
  s.grid_T.y0 = pair.X_TR.origin.y() - y_half, s.grid_T.dy = 2.0 * y_half / (s.grid_T.ny - 1);
  s.weight = maybe(random, 0.5) ? detection::PenetrationWeight::squared : detection::PenetrationWeight::linear;
  s.refine = maybe(random, 0.6);
  s.refined_points = 18;
  s.reference_at_deepest = maybe(random, 0.2);
  if (maybe(random, 0.3)) s.rules.near_miss = uniform(random, 1e-5, 1e-4);
  if (maybe(random, 0.7)) s.rules.separation = 1e-3, s.rules.combination = 0.5e-3;
  return s;
}

std::string difference(const detection::SearchResult& a, const detection::SearchResult& b, double tolerance) {
  std::ostringstream out;
  const auto compare = [&](const char* what, double x, double y, double factor = 1.0) {
    if (std::isnan(x) && std::isnan(y)) return;
    if (!(std::abs(x - y) <= factor * tolerance)) out << what << ": " << x << " and " << y << " (" << x - y << "); ";
  };
  compare("least gap", a.least_gap, b.least_gap);
  if (a.patches.size() != b.patches.size()) {
    out << a.patches.size() << " and " << b.patches.size() << " patches";
    return out.str();
  }
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    const detection::ContactPatch &p = a.patches[i], &q = b.patches[i];
    compare("x", p.x, q.x);
    compare("y", p.y, q.y);
    compare("inclination", p.inclination, q.inclination,
            1000.0);  // next to a jump of curvature slopes of offsets are good to 1e-4 at single points
    compare("weight", p.weight, q.weight);
    compare("deepest gap", p.least_gap, q.least_gap);
    if (p.parts.size() != q.parts.size()) {
      out << "parts: " << p.parts.size() << " and " << q.parts.size();
      return out.str();
    }
    const auto boxes = [&](const detection::PatchExtent& e, const detection::PatchExtent& f) {
      compare("x_min", e.box.x_min, f.box.x_min);
      compare("x_max", e.box.x_max, f.box.x_max);
      compare("y_min", e.box.y_min, f.box.y_min);
      compare("y_max", e.box.y_max, f.box.y_max);
      compare("z at y_min", e.z_at_y_min, f.z_at_y_min);
      compare("z at y_max", e.z_at_y_max, f.z_at_y_max);
    };
    boxes(p.extent, q.extent);
    for (std::size_t k = 0; k < p.parts.size(); ++k) boxes(p.parts[k], q.parts[k]);
  }
  return out.str();
}

}  // namespace treadmark::testing
