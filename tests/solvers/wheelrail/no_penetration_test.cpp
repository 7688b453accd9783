// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// No element outside contact lies deeper than the elastic bodies let it, contacts on flange and tread included, which
// are parts of one patch on a steep plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

/// Displacement at (x, y) by a unit pressure on an element about the origin, times pi G / (1 - nu) (Love 1929).
double love(double x, double y, double dx, double dy) {
  double sum = 0.0;
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0}) {
      const double a = x + 0.5 * sx * dx, b = y + 0.5 * sy * dy, r = std::hypot(a, b);
      sum += sx * sy * (a * std::log(b + r) + b * std::log(a + r));
    }
  return sum;
}

/// Of elements without pressure the greatest approach that gap and elastic displacement leave, over the rigid one.
double deepest_outside(const PatchSolution& s, double modulus) {
  const Grid2& g = s.grid;
  const std::vector<double>& p = s.contact.pressure;
  double most = 0.0;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, iy);
      if (p[i] > 0.0 || !(s.distance[i] < s.approach)) continue;
      double displacement = 0.0;
      for (int ky = 0; ky < g.ny; ++ky)
        for (int kx = 0; kx < g.nx; ++kx)
          if (const double by = p[g.index(kx, ky)]; by > 0.0)
            displacement += by / (kPi * modulus) * love((ix - kx) * g.dx, (iy - ky) * g.dy, g.dx, g.dy);
      most = std::max(most, (s.approach - s.distance[i] - displacement) / s.approach);
    }
  return most;
}

struct Flange {
  const char *rail, *wheel;
  double y_mm, force, radius = 0.46, cant = 1.0 / 40.0;
};

double deepest_outside(const Flange& how) {
  Pair pair({analytic::make_standard_surface({how.rail}, Body::rail, 0.0),
             analytic::make_standard_surface({how.wheel}, Body::wheel, how.radius), true, true});
  Problem p;
  p.track.cant = how.cant;
  p.state.position.y = 1e-3 * how.y_mm;
  p.wheelset.nominal_radius = how.radius;
  p.vertical_force = how.force;
  p.regime = kalker::Regime::frictionless;
  p.discretisation.dx = p.discretisation.ds = 1e-3;
  const PairSolution s = pair.solve(p);
  if (s.status != Status::ok) return 0.0;
  const double modulus = p.material.shear_modulus_1 / (1.0 - p.material.poisson_1);
  double most = 0.0;
  for (const PatchSolution& patch : s.patches) most = std::max(most, deepest_outside(patch, modulus));
  return most;
}

/// Parts that are far from each other feel each other by a factor below 1, as in the reference program.
constexpr double kLoosePart = 0.08;

TEST(NoPenetration, BesidePatchesOfFlangeAndTread) {
  for (const Flange& how : {Flange{"50E6", "EPS", 6.92, 47.36e3},
                            {"55E1", "EPS", 6.878, 12e3, 0.46, 1e-3},
                            {"54E3", "EPS", 6.909, 40.9e3, 0.42}})
    EXPECT_LT(deepest_outside(how), kLoosePart) << how.rail << ' ' << how.wheel;
}

TEST(NoPenetration, OnFlangesOfEveryKind) {
  Random random(4);
  const char *rails[] = {"60E1", "54E1", "50E6", "33E1", "UIC60", "49E5"}, *wheels[] = {"S1002", "EPS", "1:40"};
  for (int k = 0; k < 60; ++k) {
    const Flange how{rails[k % 6], wheels[k / 6 % 3], 5.5 + 2.0 * random.uniform(), 5e3 + 9e4 * random.uniform()};
    EXPECT_LT(deepest_outside(how), kLoosePart) << how.rail << ' ' << how.wheel << ' ' << how.y_mm << ' ' << how.force;
  }
}

}  // namespace
}  // namespace treadmark::wheelrail
