// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"

namespace treadmark::wheelrail {

inline long from_environment(const char* name, long usual) {
  const char* wanted = std::getenv(name);
  return wanted != nullptr ? std::atol(wanted) : usual;
}

struct RandomProblem {
  std::string rail, wheel;
  double radius = kStandardRadius;
  Problem problem;

  std::string words() const {
    const Problem& p = problem;
    return fmt::format("{} on {}, r = {} m, y = {:.6g} mm, {:.6g} N, cant {:.3g}, regime {}, model {}", wheel, rail,
                       radius, kMilli * p.state.position.y, *p.vertical_force, p.track.cant, static_cast<int>(p.regime),
                       static_cast<int>(p.tangential_model));
  }
};

inline RandomProblem random_problem(std::uint64_t number) {
  Random random(number);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const auto one_of = [&](auto... choices) {
    const std::array all{choices...};
    return all[random.bits() % all.size()];
  };
  RandomProblem r;
  r.rail = one_of("60E1", "54E1", "54E3", "50E6", "49E5", "33E1", "55E1", "UIC60");
  r.wheel = one_of("S1002", "EPS", "1:40");
  r.radius = one_of(0.42, 0.46, 0.5);
  Problem& p = r.problem;
  p.track.cant = one_of(0.0, 1e-3, 1.0 / 40.0, 1.0 / 20.0);
  p.wheelset.nominal_radius = r.radius;
  // Half of them where flange and tread touch at once.
  p.state.position = {0.0,
                      random.uniform() < 0.5 ? between(5.5e-3, 7.5e-3) : between(-0.01, 0.009),
                      0.0,
                      between(-1e-3, 1e-3),
                      between(-8e-3, 8e-3),
                      0.0};
  p.vertical_force = std::pow(10.0, between(3.0, 5.2));
  p.friction.kinetic = between(0.05, 0.6);
  p.regime = one_of(kalker::Regime::frictionless, kalker::Regime::steady, kalker::Regime::steady,
                    kalker::Regime::transient, kalker::Regime::shift);
  p.enforce_step_rule = false;
  if (p.regime == kalker::Regime::steady && random.uniform() < 0.3)
    p.tangential_model = kalker::TangentialModel::fastsim;
  const double slip = std::pow(10.0, between(-5.0, -2.0)), step = p.regime == kalker::Regime::shift ? 1e-2 : 10.0;
  p.state.velocity = {step, step * slip * between(-1.0, 1.0), 0.0,
                      0.0,  step * between(-0.02, 0.02),      -step / r.radius * (1.0 + slip * between(-1.0, 1.0))};
  p.discretisation.dx = between(0.8e-3, 1.2e-3);
  p.discretisation.ds = between(0.8e-3, 1.2e-3);
  return r;
}

inline Geometry surfaces_of(const RandomProblem& r) {
  static std::map<std::tuple<std::string, std::string, double>, Geometry> made;
  Geometry& g = made[{r.rail, r.wheel, r.radius}];
  if (!g.rail)
    g = {analytic::make_standard_surface({r.rail}, Body::rail, 0.0),
         analytic::make_standard_surface({r.wheel}, Body::wheel, r.radius), true, true};
  return g;
}

/// Displacement at (x, y) by a unit pressure on an element about the origin, times pi G / (1 - nu) (Love 1929).
inline double love(double x, double y, double dx, double dy) {
  double sum = 0.0;
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0}) {
      const double a = x + 0.5 * sx * dx, b = y + 0.5 * sy * dy, r = std::hypot(a, b);
      sum += sx * sy * (a * std::log(b + r) + b * std::log(a + r));
    }
  return sum;
}

/// Normal displacement of both half-spaces, alike, by the pressures of a patch [m].
inline std::vector<double> displacement(const Grid2& g, const std::vector<double>& pressure, const Material& material) {
  const double modulus = material.shear_modulus_1 / (1.0 - material.poisson_1);
  std::vector<double> of_unit(g.size()), u(g.size(), 0.0);
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix)
      of_unit[g.index(ix, iy)] = love(ix * g.dx, iy * g.dy, g.dx, g.dy) / (kPi * modulus);
  for (int ky = 0; ky < g.ny; ++ky)
    for (int kx = 0; kx < g.nx; ++kx) {
      const double p = pressure[g.index(kx, ky)];
      if (p == 0.0) continue;
      for (int iy = 0; iy < g.ny; ++iy)
        for (int ix = 0; ix < g.nx; ++ix)
          u[g.index(ix, iy)] += p * of_unit[g.index(std::abs(ix - kx), std::abs(iy - ky))];
    }
  return u;
}

/// What a solution for these surfaces breaks, in words.
class Violations {
 public:
  Violations(const RandomProblem& r, const Geometry& surfaces, const PairSolution& s)
      : surfaces_(surfaces), p_(r.problem), s_(s) {
    Vec3 force_T = Vec3::Zero();
    for (const PatchSolution& patch : s.patches) {
      contact_conditions(patch);
      friction(patch);
      force_T += patch.frame.X_TC.rotation * force_of_fields(patch);
    }
    const double load = *p_.vertical_force;
    const bool jumps = p_.tangential_model == kalker::TangentialModel::fastsim;
    limit("vertical force of the fields", std::abs(force_T.z() - load) / load, jumps ? kForceOfFastsim : kForce);
    limit("sum of the loads", (force_T - s.load.track.force).norm() / load, kRounding);
    penetration_without_patch(surfaces);
  }
  std::vector<std::string> found;

 private:
  static constexpr double kRounding = 1e-9;
  /// solver.eps is 1e-5: of forces and of the rms of pressures.
  static constexpr double kForce = 2e-5, kDepth = 1e-4, kFriction = 1e-4;
  /// It jumps with every element that comes into contact; more than that is no balance.
  static constexpr double kForceOfFastsim = 1e-3;

  void limit(const std::string& what, double amount, double most) {
    if (!(amount <= most)) found.push_back(fmt::format("{}: {:.3g}, {:.3g} at most", what, amount, most));
  }

  static Vec3 force_of_fields(const PatchSolution& patch) {
    Vec3 sum = Vec3::Zero();
    const kalker::ContactSolution& c = patch.contact;
    for (std::size_t i = 0; i < c.pressure.size(); ++i)
      sum += Vec3(c.traction_x.empty() ? 0.0 : c.traction_x[i], c.traction_y.empty() ? 0.0 : c.traction_y[i],
                  c.pressure[i]);
    return sum * patch.grid.cell_area();
  }

  /// p >= 0, e = h + u - approach >= 0, p e = 0.
  void contact_conditions(const PatchSolution& patch) {
    const std::vector<double>& pressure = patch.contact.pressure;
    const std::vector<double> u = displacement(patch.grid, pressure, p_.material),
                              by_own_part = patch.region.parts.size() > 1 ? displacement_by_own_part(patch) : u;
    double least = kInfinity, deepest = 0.0, farthest = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      least = std::min(least, pressure[i]);
      if (std::isnan(patch.distance[i])) {
        limit("pressure without a surface", pressure[i], 0.0);
        continue;
      }
      const double e = patch.distance[i] + u[i] - patch.approach;
      deepest = std::max(deepest, -e);
      if (pressure[i] > 0.0) farthest = std::max(farthest, e + by_own_part[i] - u[i]);
    }
    limit("tension", -least, 0.0);
    limit("penetration over the approach", deepest / patch.approach, kDepth);
    limit("pressure at a distance over the approach", farthest / patch.approach, kDepth);
  }

  /// Parts that lie apart feel each other by a factor from 0 to 1, as in the reference program: at least by 0.
  std::vector<double> displacement_by_own_part(const PatchSolution& patch) const {
    const Grid2& g = patch.grid;
    std::vector<double> rail(g.size()), sum(g.size(), 0.0);
    const Pose X_TP = patch.frame.X_TC * Pose{{-patch.reference_C.x(), -patch.reference_C.y(), 0.0}, Mat3::Identity()};
    surfaces_.rail->heights({s_.placement.X_TS.inverse() * X_TP, g}, {rail, {}, {}});
    const auto distance = [&](const Rectangle& box, const Vec3& p) {
      return std::hypot(std::max({0.0, box.x_min - p.x(), p.x() - box.x_max}),
                        std::max({0.0, box.y_min - p.y(), p.y() - box.y_max}));
    };
    std::vector<std::size_t> part(g.size());
    const auto& parts = patch.region.parts;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const std::size_t i = g.index(ix, iy);
        const Vec3 place = X_TP.apply({g.x(ix), g.y(iy), std::isnan(rail[i]) ? 0.0 : rail[i]});
        part[i] = static_cast<std::size_t>(
            ranges::min_element(parts, {}, [&](const auto& one) { return distance(one.box, place); }) - parts.begin());
      }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      std::vector<double> own = patch.contact.pressure;
      for (std::size_t i = 0; i < own.size(); ++i)
        if (part[i] != k) own[i] = 0.0;
      const std::vector<double> u = displacement(g, own, p_.material);
      for (std::size_t i = 0; i < u.size(); ++i)
        if (part[i] == k) sum[i] = u[i];
    }
    return sum;
  }

  void friction(const PatchSolution& patch) {
    const kalker::ContactSolution& c = patch.contact;
    double greatest = 0.0, excess = 0.0;
    for (std::size_t i = 0; i < c.traction_x.size(); ++i) {
      const double bound = p_.friction.kinetic * c.pressure[i];
      greatest = std::max(greatest, bound);
      excess = std::max(excess, std::hypot(c.traction_x[i], c.traction_y[i]) - bound);
    }
    if (greatest > 0.0) limit("traction beyond friction", excess / greatest, kFriction);
  }

  /// Where the rigid bodies lie in each other there is a patch. Depths are normal to the rail. Elements that stay
  /// aligned in time may lie on both sides of a shallow corner of 5 mm, which is said.
  void penetration_without_patch(const Geometry& g) {
    const bool said = ranges::any_of(s_.remarks, [](const Remark& remark) {
      return remark.kind == RemarkKind::coarse_elements && remark.patch == 0;
    });
    constexpr double kCorner = 5e-3, kBeside = 0.5e-3;  // [m]
    const double slight = said ? p_.discretisation.ds * p_.discretisation.ds / (8.0 * kCorner) : 2e-6;
    const LateralRange range = visible_range(*g.rail, s_.placement.X_TS.inverse(), 0.0);
    constexpr double kStepX = 2e-3, kStepY = 0.25e-3;
    const Grid2 grid{-10 * kStepX, range.y_min, kStepX,
                     kStepY,       21,          static_cast<int>((range.y_max - range.y_min) / kStepY)};
    std::vector<double> rail(grid.size()), slope(grid.size()), wheel(grid.size());
    g.rail->heights({s_.placement.X_TS.inverse(), grid}, {rail, {}, slope});
    g.wheel->heights({s_.placement.X_TA.inverse(), grid}, {wheel, {}, {}});
    double deepest = 0.0;
    Vec2 place = Vec2::Zero();
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) {
        const std::size_t i = grid.index(ix, iy);
        const double depth = (wheel[i] - rail[i]) / std::hypot(1.0, slope[i]), x = grid.x(ix), y = grid.y(iy);
        if (!(depth > deepest)) continue;
        const bool has_patch = ranges::any_of(s_.patches, [&](const PatchSolution& patch) {
          const Rectangle& box = patch.region.extent.box;
          return x > box.x_min - kBeside && x < box.x_max + kBeside && y > box.y_min - kBeside &&
                 y < box.y_max + kBeside;
        });
        if (!has_patch) deepest = depth, place = {x, y};
      }
    limit(fmt::format("penetration [m] without a patch at x = {:.3g} mm, y = {:.5g} mm", kMilli * place.x(),
                      kMilli * place.y()),
          deepest, slight);
  }

  const Geometry& surfaces_;
  const Problem& p_;
  const PairSolution& s_;
};

}  // namespace treadmark::wheelrail
