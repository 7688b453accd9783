// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/stress_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <vector>

#include "treadmark/analysis/damage/fatigue.hpp"
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

namespace treadmark::damage {
namespace {

constexpr double kPoisson = 0.28;

/// Below a line contact of half width 1 with the largest pressure 1 that slips all over, at x along and z deep (McEwen
/// 1949, Smith and Liu 1953; Johnson 1985, sections 4.2 and 7.1), plane strain.
Mat3 line_contact(double x, double z, double friction, double poisson = kPoisson) {
  const double e = 1.0 - x * x + z * z, root = std::hypot(e, 2.0 * x * z);
  const double m = std::sqrt(0.5 * (root + e)), n = std::copysign(std::sqrt(std::max(0.0, 0.5 * (root - e))), x);
  const double share = (z * z + n * n) / (m * m + n * n), other = (z * z - m * m) / (m * m + n * n);
  const double sx = -(m * (1.0 + share) - 2.0 * z), sz = -m * (1.0 - share), shear = n * other;
  Mat3 s = Mat3::Zero();
  s(0, 0) = sx + friction * (n * (2.0 - other) - 2.0 * x);
  s(2, 2) = sz + friction * shear;
  s(0, 2) = s(2, 0) = shear + friction * sx;
  s(1, 1) = poisson * (s(0, 0) + s(2, 2));
  return s;
}

/// Below a circular contact of radius 1 with the largest pressure 1, without traction (Huber 1904).
Mat3 circular_contact(double x, double y, double z) {
  const double r = std::max(std::hypot(x, y), 1e-4), e = r * r + z * z - 1.0, u = 0.5 * (e + std::hypot(e, 2.0 * z));
  const double root = std::sqrt(u), q = z / root, turn = (1.0 + kPoisson) * root * std::atan(1.0 / root);
  const double ring = (1.0 - 2.0 * kPoisson) / 3.0 / (r * r) * (1.0 - q * q * q), below = u / (u * u + z * z);
  const double level = (1.0 - kPoisson) * u / (1.0 + u);
  const double radial = ring + q * q * q * below + q * (level + turn - 2.0),
               round = -ring - q * (2.0 * kPoisson + level - turn);
  const double axial = -q * q * q * below, shear = -r * z * z / (u * u + z * z) * root / (1.0 + u);
  const double c = x / r, s = std::hypot(x, y) < r ? std::sqrt(1.0 - c * c) : y / r;
  Mat3 stress;
  stress << radial * c * c + round * s * s, (radial - round) * c * s, shear * c, (radial - round) * c * s,
      radial * s * s + round * c * c, shear * s, shear * c, shear * s, axial;
  return stress;
}

template <class Stress>
std::vector<Mat3> passage(Stress stress) {
  constexpr int kSteps = 400;
  constexpr double kFar = 6.0;
  std::vector<Mat3> out;
  for (int i = 0; i <= kSteps; ++i) out.push_back(stress(kFar * (2.0 * i / kSteps - 1.0) + 1e-6));
  return out;
}

/// The least k, over depths, that keeps a passage elastic.
template <class Stress>
double hardest(Stress stress, double shallowest) {
  double k = 0.0;
  for (double z = shallowest; z < 1.2; z += 0.02)
    k = std::max(k, stress_measures(passage([&](double x) { return stress(x, z); }), 0.0).shakedown);
  return k;
}

TEST(StressMeasures, PureShearThereAndBack) {
  Mat3 shear = Mat3::Zero();
  shear(0, 2) = shear(2, 0) = 3.0;
  const std::vector<Mat3> both{shear, -shear};
  const StressMeasures m = stress_measures(both, 0.3);
  EXPECT_NEAR(m.von_mises, 3.0 * std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(m.shear, 3.0, 1e-9);
  EXPECT_NEAR(m.dang_van, 3.0, 1e-6);
  EXPECT_NEAR(m.shakedown, 3.0, 1e-6);
}

TEST(StressMeasures, OneWayTensionHasItsMiddleAtHalf) {
  Mat3 tension = Mat3::Zero();
  tension(0, 0) = 2.0;
  const std::vector<Mat3> once{tension};
  const StressMeasures m = stress_measures(once, 0.3);
  EXPECT_NEAR(m.von_mises, 2.0, 1e-12);
  EXPECT_NEAR(m.shear, 0.5, 1e-12);
  EXPECT_NEAR(m.dang_van, 0.5 + 0.3 * 2.0 / 3.0, 1e-6);
  // a residual stress along x takes half of it: sqrt(J2) of the other half
  EXPECT_NEAR(m.shakedown, 1.0 / std::sqrt(3.0), 1e-6);
}

/// What equilibrium leaves to residual stresses does not take shear in planes parallel to the surface.
TEST(StressMeasures, ResidualStressesTakeNoShearOfTheLayers) {
  Mat3 across = Mat3::Zero(), layer = Mat3::Zero();
  across(0, 1) = across(1, 0) = layer(0, 2) = layer(2, 0) = 1.0;
  const std::vector<Mat3> a{across}, b{layer};
  EXPECT_NEAR(stress_measures(a, 0.0).shakedown, 0.5, 1e-6);
  EXPECT_NEAR(stress_measures(b, 0.0).shakedown, 1.0, 1e-6);
  EXPECT_NEAR(stress_measures(b, 0.0).dang_van, 0.5, 1e-6);
}

/// Johnson's map without friction: p0 / k = 4.0 below a line, 4.7 below a circle.
TEST(Shakedown, LimitsWithoutFrictionAreThoseOfTheMap) {
  const double line = 1.0 / hardest([](double x, double z) { return line_contact(x, z, 0.0); }, 0.1);
  const double point = 1.0 / hardest([](double x, double z) { return circular_contact(x, 0.0, z); }, 0.1);
  std::cout << "p0/k: line " << line << ", point " << point << '\n';
  EXPECT_NEAR(line, 4.0, 0.02 * 4.0);
  EXPECT_NEAR(point, 4.7, 0.02 * 4.7);
}

/// The least k of a whole track below a circular contact at a depth, without the library: residual stresses yy are the
/// same all over the layer, xx of every row is its own, and both need no others for their balance (Melan 1938).
double track_yield(double z) {
  std::vector<std::vector<Mat3>> rows;
  for (double y = 0.0; y <= 1.0; y += 0.25)
    rows.push_back(passage([&](double x) { return circular_contact(x, y, z); }));
  const auto least = [](auto f, double low, double high) {
    for (int step = 0; step < 25; ++step) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
    }
    return f(0.5 * (low + high));
  };
  const auto yield = [](const std::vector<Mat3>& row, double xx, double yy) {
    double k = 0.0;
    for (Mat3 s : row) {
      s(0, 0) += xx, s(1, 1) += yy;
      s.diagonal().array() -= s.trace() / 3.0;
      k = std::max(k, std::sqrt(0.5) * s.norm());
    }
    return k;
  };
  return least(
      [&](double yy) {
        double k = 0.0;
        for (const auto& row : rows) k = std::max(k, least([&](double xx) { return yield(row, xx, yy); }, -1.0, 1.0));
        return k;
      },
      -0.5, 0.5);
}

TEST(Shakedown, OneFieldForTheWholeTrackIsNearlyAsGood) {
  double track = 0.0, middle = 0.0;
  for (const double z : {0.3, 0.35}) {
    track = std::max(track, track_yield(z));
    middle = std::max(middle,
                      stress_measures(passage([&](double x) { return circular_contact(x, 0.0, z); }), 0.0).shakedown);
  }
  std::cout << "p0/k of a whole track: " << 1.0 / track << ", of its middle alone: " << 1.0 / middle << '\n';
  EXPECT_GE(track, 0.9999 * middle);
  EXPECT_NEAR(1.0 / track, 4.7, 0.02 * 4.7);
}

/// The branch of the surface, p0 / k = 1 / mu, in plane strain of a body that keeps its volume.
TEST(Shakedown, TractionBranchIsThatOfTheMap) {
  for (const double friction : {0.4, 0.5, 0.7, 1.0})
    EXPECT_NEAR(1.0 / hardest([&](double x, double z) { return line_contact(x, z, friction, 0.5); }, 1e-4),
                1.0 / friction, 0.02 / friction)
        << friction;
}

TEST(Shakedown, LimitOfTheMapIsThatOfTheElasticStresses) {
  std::vector<double> frictions{0.36, 0.365, 0.37, 0.38, 0.5, 1.3};
  for (int k = 0; k <= 14; ++k) frictions.push_back(0.025 * k);  // at every knot and between any two
  for (const double friction : frictions) {
    const double expected = 1.0 / hardest([&](double x, double z) { return line_contact(x, z, friction, 0.5); }, 1e-4);
    EXPECT_NEAR(shakedown_limit(friction), expected, 0.005 * expected) << friction;
  }
}

/// Stresses of the elements of a moving circular contact against the closed form, below its middle and beside it.
TEST(StressHistory, OfElementsIsThatOfTheMovingHertzContact) {
  constexpr int kAcross = 41;
  const double d = 2.0 / kAcross;
  Grid2 grid{-3.0 + 0.5 * d, -1.0 + 0.5 * d, d, d, 3 * kAcross - 2, kAcross};
  std::vector<double> pressure;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix)
      pressure.push_back(std::sqrt(std::max(0.0, 1.0 - std::pow(grid.x(ix), 2) - std::pow(grid.y(iy), 2))));
  const std::vector<double> depths{0.2, 0.3, 0.5, 1.0};
  const auto points =
      kalker::subsurface_stress_on_grid({grid, pressure, {}, {}}, {82e9, 82e9, kPoisson, kPoisson}, depths);
  double largest = 0.0;
  for (std::size_t iz = 0; iz < depths.size(); ++iz)
    for (const int iy : {kAcross / 2, kAcross / 2 + 8, kAcross / 2 + 15}) {
      std::vector<Mat3> found, expected;
      for (int ix = 0; ix < grid.nx; ++ix) {
        found.push_back(points[iz * grid.size() + grid.index(ix, iy)].stress);
        expected.push_back(circular_contact(grid.x(ix), grid.y(iy), depths[iz]));
        largest = std::max(largest, (found.back() - expected.back()).cwiseAbs().maxCoeff());
      }
      const StressMeasures a = stress_measures(found, 0.3), b = stress_measures(expected, 0.3);
      EXPECT_NEAR(a.von_mises, b.von_mises, 0.01 * b.von_mises) << iz << ' ' << iy;
      EXPECT_NEAR(a.shear, b.shear, 0.01 * b.shear) << iz << ' ' << iy;
      EXPECT_NEAR(a.shakedown, b.shakedown, 0.01 * b.shakedown) << iz << ' ' << iy;
      EXPECT_NEAR(a.dang_van, b.dang_van, 0.01 * b.shear) << iz << ' ' << iy;
    }
  std::cout << "largest difference of a component, of the largest pressure: " << largest << '\n';
  EXPECT_LT(largest, 0.01);
}

}  // namespace
}  // namespace treadmark::damage
