// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/wheelrail/validate_problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::wheelrail {

namespace {

[[noreturn]] void refuse(std::string message, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), {}, std::move(advice));
}

void require_finite(double value, const char* name) {
  if (!std::isfinite(value)) refuse(std::string(name) + " is not a finite number");
}

void require_within(double value, double greatest, const char* name) {
  require_finite(value, name);
  if (!(std::abs(value) <= greatest))
    refuse(fmt::format("{} is {:g}, beyond the greatest magnitude that is taken, {:g}", name, value, greatest));
}

void require_positive(double value, const char* name) {
  require_finite(value, name);
  if (!(value > 0.0)) refuse(std::string(name) + " must be positive");
}

void check_motion(const SixMotion& m, const char* name, double greatest = kInfinity) {
  for (const double value : {m.x, m.y, m.z, m.roll, m.yaw, m.pitch}) require_within(value, greatest, name);
}

void check_track(const Track& t) {
  for (const double value :
       {t.gauge_height, t.gauge_width, t.rail_y0, t.rail_z0, t.cant, t.curvature, t.dy, t.dz, t.roll})
    require_finite(value, "a number of the track");
  for (const double value : {t.vy, t.vz, t.vroll}) require_within(value, kMostSpeed, "a velocity of the track");
}

void check_bodies(const Material& m, const FrictionLaw& f) {
  require_positive(m.shear_modulus_1, "the rail's shear modulus");
  require_positive(m.shear_modulus_2, "the wheel's shear modulus");
  for (const double poisson : {m.poisson_1, m.poisson_2}) {
    require_finite(poisson, "Poisson's ratio");
    if (poisson < 0.0 || poisson > 0.5) refuse("Poisson's ratio must lie in 0 ... 0.5");
  }
  for (const double value : {m.layer_flexibility, m.layer_yield, m.layer_hardening, m.sheet_flexibility,
                             m.creep_ratio_1, m.creep_ratio_2, m.relaxation_time_1, m.relaxation_time_2})
    require_finite(value, "a number of the material");
  for (const double value : {f.half_velocity_1, f.half_velocity_2, f.memory_distance, f.memory_velocity})
    require_finite(value, "a number of the friction law");
  for (const double value : {f.kinetic, f.amplitude_1, f.amplitude_2, f.temperature_change})
    require_within(value, kMostFriction, "a coefficient of friction");
}

void check_forces(const Problem& p) {
  if (p.vertical_force) require_positive(*p.vertical_force, "the prescribed vertical force");
  if (p.longitudinal_force) {
    require_finite(*p.longitudinal_force, "the prescribed longitudinal force");
    if (p.regime == kalker::Regime::frictionless)
      refuse("a longitudinal force is prescribed without a tangential problem");
    const double running = p.roller ? p.roller->pitch_rate : p.state.velocity.x;
    if (running == 0.0 && p.regime != kalker::Regime::shift)
      refuse("a longitudinal force is prescribed for a wheel that stands still", "give a speed");
  }
  if (p.rail_springs) {
    const RailSprings& k = *p.rail_springs;
    require_positive(k.stiffness_y, "the lateral stiffness of the rail's springs");
    require_finite(k.stiffness_z, "the vertical stiffness of the rail's springs");
    if (k.stiffness_z < 0.0) refuse("the vertical stiffness of the rail's springs must not be negative");
    require_positive(k.first_step_y, "the first lateral step of the rail");
    require_finite(k.force_y, "the lateral force on the rail");
    require_finite(k.force_z, "the vertical force on the rail");
  }
  if (p.damping)
    for (const double value :
         {p.damping->normal, p.damping->tangential, p.damping->max_rate_normal, p.damping->max_rate_tangential}) {
      require_finite(value, "a number of the damping");
      if (value < 0.0) refuse("damping must not be negative");
    }
}

void check_discretisation(const Discretisation& d) {
  require_positive(d.dx, "the element size dx");
  require_positive(d.ds, "the element size ds");
  require_positive(d.dq_relative, "the rolling step over dx");
  require_within(d.dq_relative, kMostStep, "the rolling step over dx");
  for (const double value : {d.angle_separation, d.separation, d.combination, d.turning.value_or(0.0), d.near_miss})
    require_finite(value, "a rule for patches");
}

}  // namespace

void validate(const Problem& p) {
  check_track(p.track);
  const WheelsetDimensions& w = p.wheelset;
  require_positive(w.nominal_radius, "the nominal wheel radius");
  for (const double value : {w.flange_back_distance, w.flange_back_position, w.tape_line.value_or(0.0)})
    require_finite(value, "a dimension of the wheelset");
  check_motion(p.state.position, "a position of the wheelset");
  check_motion(p.state.velocity, "a velocity of the wheelset", kMostSpeed);
  check_motion(p.state.wheel_offset, "a deviation of the wheel");
  check_motion(p.state.wheel_velocity, "a velocity of the wheel's deviation", kMostSpeed);
  if (p.roller) {
    require_finite(p.roller->nominal_radius, "the roller's radius");
    require_within(p.roller->pitch_rate, kMostSpeed, "the roller's pitch rate");
    if (p.roller->nominal_radius == 0.0) refuse("the roller's radius must not be zero");
  }
  check_bodies(p.material, p.friction);
  check_forces(p);
  check_discretisation(p.discretisation);
  if (!(p.solver.eps > 0.0)) refuse("the accuracy eps must be positive");
}

namespace {

/// Calls visit(index) for the up to eight neighbours of an element.
template <class Visit>
void neighbours(const Grid2& g, std::size_t i, Visit visit) {
  const int x = static_cast<int>(i % static_cast<std::size_t>(g.nx)),
            y = static_cast<int>(i / static_cast<std::size_t>(g.nx));
  for (int iy = std::max(0, y - 1); iy <= std::min(g.ny - 1, y + 1); ++iy)
    for (int ix = std::max(0, x - 1); ix <= std::min(g.nx - 1, x + 1); ++ix)
      if (ix != x || iy != y) visit(g.index(ix, iy));
}

bool on_border(const Grid2& g, std::size_t i) {
  const int x = static_cast<int>(i % static_cast<std::size_t>(g.nx)),
            y = static_cast<int>(i / static_cast<std::size_t>(g.nx));
  return x == 0 || y == 0 || x == g.nx - 1 || y == g.ny - 1;
}

}  // namespace

MissingSurface missing_beside_contact(const Grid2& grid, std::span<const double> distance,
                                      std::span<const double> pressure) {
  MissingSurface found;
  std::vector<bool> seen(grid.size(), false);
  std::vector<std::size_t> part;
  for (std::size_t start = 0; start < grid.size(); ++start) {
    if (seen[start] || !std::isnan(distance[start])) continue;
    part.assign(1, start);
    seen[start] = true;
    bool border = false;
    int beside = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      border = border || on_border(grid, part[k]);
      bool touches = false;
      neighbours(grid, part[k], [&](std::size_t j) {
        touches = touches || pressure[j] > 0.0;
        if (seen[j] || !std::isnan(distance[j])) return;
        seen[j] = true;
        part.push_back(j);
      });
      beside += touches ? 1 : 0;
    }
    if (beside == 0) continue;
    if (border)
      found.edge += beside;
    else
      found.hole += static_cast<int>(part.size());
  }
  return found;
}

}  // namespace treadmark::wheelrail
