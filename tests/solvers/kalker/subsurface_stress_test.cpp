// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "treadmark/core/constants.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/tests/solvers/kalker/subsurface_load.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::kalker {
namespace {

using testing::at;
using testing::kDissimilar;
using testing::Load;
using testing::one_element;
using testing::patch;

/// Johnson 1985, eq. (3.19, 3.20) in cylindrical coordinates: unit force along z.
Mat3 boussinesq(const Vec3& p, double nu) {
  const double r2 = p.x() * p.x() + p.y() * p.y(), rho = p.norm(), z = p.z(), c = 0.5 / kPi;
  const double radial = c * ((1 - 2 * nu) * (1 / r2 - z / (rho * r2)) - 3 * z * r2 / std::pow(rho, 5));
  const double hoop = -c * (1 - 2 * nu) * (1 / r2 - z / (rho * r2) - z / std::pow(rho, 3));
  const Vec3 er(p.x() / std::sqrt(r2), p.y() / std::sqrt(r2), 0.0), et(-er.y(), er.x(), 0.0), ez(0.0, 0.0, 1.0);
  const double axial = -3 * c * std::pow(z, 3) / std::pow(rho, 5),
               shear = -3 * c * std::sqrt(r2) * z * z / std::pow(rho, 5);
  return radial * er * er.transpose() + hoop * et * et.transpose() + axial * ez * ez.transpose() +
         shear * (er * ez.transpose() + ez * er.transpose());
}

/// Johnson 1985, eq. (3.76): unit force along x.
Mat3 cerruti(const Vec3& p, double nu) {
  const double x = p.x(), y = p.y(), z = p.z(), s = p.norm(), c = 0.5 / kPi, k = 1 - 2 * nu, t = s + z;
  const double s2 = s * s, s3 = s2 * s, s5 = s2 * s3, t2 = t * t, t3 = t2 * t;
  Mat3 out;
  out(0, 0) = -3 * x * x * x / s5 + k * (x / s3 - 3 * x / (s * t2) + x * x * x / (s3 * t2) + 2 * x * x * x / (s2 * t3));
  out(1, 1) = -3 * x * y * y / s5 + k * (x / s3 - x / (s * t2) + x * y * y / (s3 * t2) + 2 * x * y * y / (s2 * t3));
  out(2, 2) = -3 * x * z * z / s5;
  out(0, 1) = out(1, 0) = -3 * x * x * y / s5 + k * (-y / (s * t2) + x * x * y / (s3 * t2) + 2 * x * x * y / (s2 * t3));
  out(1, 2) = out(2, 1) = -3 * x * y * z / s5;
  out(0, 2) = out(2, 0) = -3 * x * x * z / s5;
  return c * out;
}

const std::vector<Vec3> kDirections{
    {0.6, 0.3, 0.7}, {-0.5, 0.8, 0.2}, {-0.1, -0.9, 0.05}, {0.9, -0.2, 0.4}, {0.02, 0.01, 1.0}};

TEST(Subsurface, FarFromAnElementItIsAPointLoad) {
  const double size = 1e-3, distance = 0.3, nu = kDissimilar.poisson_1;
  const Mat3 swap = (Mat3() << 0, 1, 0, 1, 0, 0, 0, 0, 1).finished();
  for (const Vec3& direction : kDirections) {
    const Vec3 point = distance * direction.normalized();
    const Mat3 along_z = boussinesq(point, nu), along_x = cerruti(point, nu);
    const Mat3 along_y = swap * cerruti(swap * point, nu) * swap;
    const double force = size * size, tolerance = 5e-5 / (distance * distance);  // the load is not quite a point
    EXPECT_LT((at(one_element(size, 1, 0, 0), kDissimilar, point).stress / force - along_z).norm(), tolerance);
    EXPECT_LT((at(one_element(size, 0, 1, 0), kDissimilar, point).stress / force - along_x).norm(), tolerance);
    EXPECT_LT((at(one_element(size, 0, 0, 1), kDissimilar, point).stress / force - along_y).norm(), tolerance);
    // Johnson 1985, eq. (3.19c): the sinking of a point on the surface and below.
    const double rho = distance, z = point.z();
    const double uz = (z * z / std::pow(rho, 3) + 2 * (1 - nu) / rho) / (4 * kPi * kDissimilar.shear_modulus_1);
    EXPECT_NEAR(at(one_element(size, 1, 0, 0), kDissimilar, point).displacement.z() / force / uz, 1.0, 5e-5);
  }
}

/// A sphere on the axis, Johnson 1985, eq. (3.45).
struct HertzAxis {
  double axial, radial;
};
HertzAxis hertz_axis(double zeta, double nu) {
  const double axial = -1 / (1 + zeta * zeta);
  return {axial, -(1 + nu) * (1 - zeta * std::atan(1 / zeta)) - 0.5 * axial};
}

double hertz_error(int n, const std::vector<double>& depths) {
  const Material material{82e9, 82e9, 0.3, 0.3};
  const double a = 5e-3;
  const HertzShape shape = hertz_from_semi_axes(a, a, {true, 1e5}, combine(material));
  Load load{hertz_grid(shape, n, n, 1.05), {}, {}, {}};
  for (int iy = 0; iy < n; ++iy)
    for (int ix = 0; ix < n; ++ix) load.pn.push_back(hertz_pressure(shape, load.grid.x(ix), load.grid.y(iy)));
  const double p0 = hertz_max_pressure(shape);
  double error = 0.0;
  for (const double zeta : depths) {
    const Mat3 stress = at(load, material, {0, 0, zeta * a}).stress / p0;
    const HertzAxis exact = hertz_axis(zeta, 0.3);
    EXPECT_NEAR(stress(0, 0), stress(1, 1), 1e-12);
    error = std::max({error, std::abs(stress(2, 2) - exact.axial), std::abs(stress(0, 0) - exact.radial)});
  }
  return error;
}

TEST(Subsurface, StressesBelowASphereConvergeToHertz) {
  const std::vector<double> depths{0.2, 0.48, 1.0, 2.0, 4.0};
  const double coarse = hertz_error(21, depths), fine = hertz_error(81, depths);
  EXPECT_LT(coarse, 2e-2);
  EXPECT_LT(fine, 2.5e-3);
  EXPECT_LT(fine, coarse / 4);
}

TEST(Subsurface, GreatestShearBelowASphereLiesAtHalfTheRadius) {
  const Material material{82e9, 82e9, 0.3, 0.3};
  const HertzShape shape = hertz_from_semi_axes(1.0, 1.0, {true, 1e9}, combine(material));
  Load load{hertz_grid(shape, 81, 81, 1.05), {}, {}, {}};
  for (int iy = 0; iy < 81; ++iy)
    for (int ix = 0; ix < 81; ++ix) load.pn.push_back(hertz_pressure(shape, load.grid.x(ix), load.grid.y(iy)));
  double greatest = 0.0, depth = 0.0;
  for (double z = 0.3; z < 0.7; z += 0.01) {
    const SubsurfacePoint point = at(load, material, {0, 0, z});
    if (point.tresca > 2 * greatest) greatest = 0.5 * point.tresca, depth = z;
    EXPECT_NEAR(point.von_mises, point.tresca, 1e-9 * point.tresca) << "two principal stresses are equal";
  }
  EXPECT_NEAR(depth, 0.48, 0.011);  // Johnson 1985, section 3.4
  EXPECT_NEAR(greatest / hertz_max_pressure(shape), 0.31, 1e-3);
}

TEST(Subsurface, StressesAreInEquilibrium) {
  const Load load = patch(9, 7);
  const double h = 2e-6;
  for (const Vec3& point :
       {Vec3(1e-3, 0.5e-3, 1e-3), Vec3(-2e-3, 1e-3, 0.4e-3), Vec3(0.3e-3, -2e-3, -1.5e-3), Vec3(5e-3, 1e-3, -0.3e-3)}) {
    Vec3 divergence = Vec3::Zero();
    double scale = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      const Mat3 slope =
          (at(load, kDissimilar, point + step).stress - at(load, kDissimilar, point - step).stress) / (2 * h);
      divergence += slope.col(k);
      scale = std::max(scale, slope.norm());
    }
    EXPECT_LT(divergence.norm(), 1e-4 * scale);
  }
}

TEST(Subsurface, GradientsAreThoseOfTheDisplacementsAndHookesLawHolds) {
  const Load load = patch(9, 7);
  const double h = 2e-6;
  for (const Vec3& point :
       {Vec3(1e-3, 0.5e-3, 1e-3), Vec3(-2e-3, 1e-3, 0.4e-3), Vec3(0.3e-3, -2e-3, -1.5e-3), Vec3(5e-3, 1e-3, -0.3e-3)}) {
    const SubsurfacePoint here = at(load, kDissimilar, point);
    Mat3 numerical;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      numerical.col(k) =
          (at(load, kDissimilar, point + step).displacement - at(load, kDissimilar, point - step).displacement) /
          (2 * h);
    }
    EXPECT_LT((numerical - here.gradient).norm(), 1e-5 * here.gradient.norm());

    const bool second = point.z() < 0.0;
    const double g = second ? kDissimilar.shear_modulus_2 : kDissimilar.shear_modulus_1;
    const double nu = second ? kDissimilar.poisson_2 : kDissimilar.poisson_1;
    const Mat3 strain = 0.5 * (here.gradient + here.gradient.transpose());
    const Mat3 stress = 2 * g * (strain + nu / (1 - 2 * nu) * strain.trace() * Mat3::Identity());
    EXPECT_LT((stress - here.stress).norm(), 1e-11 * stress.norm());
  }
}

TEST(Subsurface, TractionsAreMetOnBothSidesOfTheSurface) {
  const Load load = patch(9, 7);
  std::vector<Vec3> points;
  for (const double z : {0.0, 1e-10, -1e-10})
    for (int iy = 0; iy < load.grid.ny; ++iy)
      for (int ix = 0; ix < load.grid.nx; ++ix) points.emplace_back(load.grid.x(ix), load.grid.y(iy), z);
  const auto results = subsurface_stress(load.view(), kDissimilar, points);
  for (std::size_t k = 0; k < results.size(); ++k) {
    const std::size_t i = k % load.grid.size();
    const Vec3 traction(load.px[i], load.py[i], load.pn[i]);
    // The outer normal of body 1 is -z. Body 2 hands the same stress across the surface.
    EXPECT_LT((results[k].stress * -Vec3::UnitZ() - traction).norm(), 1e3) << k;  // of 1e9
  }
  const SubsurfacePoint beside = at(load, kDissimilar, {6e-3, 0.2e-3, 0.0});
  EXPECT_LT(beside.stress.col(2).norm(), 1e-3);
  EXPECT_GT(beside.stress.norm(), 1e6);
}

TEST(Subsurface, SurfaceDisplacementsAreThoseOfTheContactProblem) {
  const double dx = 0.4e-3, dy = 0.7e-3;
  const CombinedMaterial combined = combine(kDissimilar);
  const auto difference = [&](const Load& load, const Vec3& point) -> Vec3 {
    const Vec3 below(point.x(), point.y(), -1e-15);
    return at(load, kDissimilar, point).displacement - at(load, kDissimilar, below).displacement;
  };
  for (const Vec3& point : {Vec3(0, 0, 0), Vec3(dx, 0, 0), Vec3(-3 * dx, 2 * dy, 0), Vec3(0.1 * dx, -0.3 * dy, 0)}) {
    const auto coefficient = [&](Component c) {
      return influence(c, point.x(), point.y(), dx, dy, combined.poisson) / combined.shear_modulus;
    };
    Load load{{0, 0, dx, dy, 1, 1}, {1.0}, {0.0}, {0.0}};
    EXPECT_NEAR(difference(load, point).z() / coefficient(Component::nn), 1.0, 1e-10);
    load.pn = {0.0}, load.px = {1.0};
    const Vec3 by_x = difference(load, point);
    EXPECT_NEAR(by_x.x() / coefficient(Component::xx), 1.0, 1e-10);
    EXPECT_NEAR(by_x.y(), coefficient(Component::xy), 1e-10 * coefficient(Component::xx));
    load.px = {0.0}, load.py = {1.0};
    const Vec3 by_y = difference(load, point);
    EXPECT_NEAR(by_y.y() / coefficient(Component::yy), 1.0, 1e-10);
    EXPECT_NEAR(by_y.x(), coefficient(Component::xy), 1e-10 * coefficient(Component::yy));
  }
}

TEST(Subsurface, ApproachOfTheReferenceExample) {
  TREADMARK_REQUIRE_SHARED();
  const auto cases = nlohmann::json::parse(std::ifstream(*shared / "reference" / "subsurf.json"));
  const double approach_mm = cases.at(0).at("patches").at(0).at("approach_mm");
  const Material material{1e6, 1e6, 0.28, 0.28};
  const Load load{{0, 0, 1e-3, 1e-3, 1, 1}, {1e6}, {}, {}};
  const double rail = at(load, material, {0, 0, 0}).displacement.z(),
               wheel = at(load, material, {0, 0, -1e-15}).displacement.z();
  EXPECT_NEAR(1e3 * (rail - wheel), approach_mm, 6e-7);
  EXPECT_NEAR(rail, -wheel, 1e-12 * rail);
}

TEST(Subsurface, BodyTwoMirrorsBodyOne) {
  Load load = patch(9, 7);
  const Material swapped{kDissimilar.shear_modulus_2, kDissimilar.shear_modulus_1, kDissimilar.poisson_2,
                         kDissimilar.poisson_1};
  Load opposite = load;
  for (double& p : opposite.px) p = -p;
  for (double& p : opposite.py) p = -p;
  const Mat3 mirror = Vec3(1, 1, -1).asDiagonal();
  for (const Vec3& direction : kDirections) {
    const Vec3 point = 2e-3 * direction;
    const SubsurfacePoint wheel = at(load, kDissimilar, mirror * point), rail = at(opposite, swapped, point);
    EXPECT_LT((wheel.stress - mirror * rail.stress * mirror).norm(), 1e-12 * rail.stress.norm());
    EXPECT_LT((wheel.displacement - mirror * rail.displacement).norm(), 1e-12 * rail.displacement.norm());
    EXPECT_LT((wheel.gradient - mirror * rail.gradient * mirror).norm(), 1e-12 * rail.gradient.norm());
    EXPECT_NEAR(wheel.von_mises, rail.von_mises, 1e-12 * rail.von_mises);
  }
}

TEST(Subsurface, InvariantsAgreeWithTheStress) {
  const SubsurfacePoint point = at(patch(9, 7), kDissimilar, {0.7e-3, -0.4e-3, 0.9e-3});
  const Mat3& s = point.stress;
  const double squares =
      std::pow(s(0, 0) - s(1, 1), 2) + std::pow(s(1, 1) - s(2, 2), 2) + std::pow(s(2, 2) - s(0, 0), 2);
  const double shears = s(0, 1) * s(0, 1) + s(1, 2) * s(1, 2) + s(0, 2) * s(0, 2);
  EXPECT_NEAR(point.von_mises, std::sqrt(0.5 * squares + 3 * shears), 1e-12 * point.von_mises);
  EXPECT_GE(point.principal[0], point.principal[1]);
  EXPECT_GE(point.principal[1], point.principal[2]);
  EXPECT_NEAR(point.principal.sum(), 3 * point.hydrostatic, 1e-9 * std::abs(point.hydrostatic));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR((s - point.principal[k] * Mat3::Identity()).determinant(), 0.0, 1e-12 * std::pow(s.norm(), 3));
  EXPECT_NEAR(point.tresca, point.principal[0] - point.principal[2], 1e-9 * point.tresca);
}

TEST(Subsurface, BordersOfElementsAtTheSurfaceHaveTheMeanOfTheSides) {
  const Load load = one_element(1e-3, 1e9, 3e8, -1e8);
  const auto zz = [&](double x, double y) { return at(load, kDissimilar, {x, y, 0}).stress.col(2).eval(); };
  const Vec3 inside = zz(0.2e-3, -0.1e-3);
  EXPECT_LT((inside + Vec3(3e8, -1e8, 1e9)).norm(), 1.0);
  EXPECT_LT((zz(0.5e-3, 0.1e-3) - 0.5 * inside).norm(), 1e-6 * inside.norm());
  EXPECT_LT((zz(0.1e-3, -0.5e-3) - 0.5 * inside).norm(), 1e-6 * inside.norm());
  EXPECT_LT((zz(0.5e-3, -0.5e-3) - 0.25 * inside).norm(), 1e-6 * inside.norm());
  for (const double z : {0.0, 1e-14, 1e-9, 1e-4, -1e-14})
    for (const double x : {-0.5e-3, 0.0, 0.5e-3})
      for (const double y : {-0.5e-3, 0.5e-3}) {
        const SubsurfacePoint point = at(load, kDissimilar, {x, y, z});
        EXPECT_TRUE(point.stress.allFinite() && point.gradient.allFinite() && point.displacement.allFinite());
        EXPECT_LT(point.stress.norm(), 50e9);
      }
}

TEST(Subsurface, AnIncompressibleBodyKeepsItsVolume) {
  const Material rubber{1e6, 1e6, 0.5, 0.5};
  const Load load = one_element(1e-3, 1e4, 2e3, 0.0);
  const SubsurfacePoint surface = at(load, rubber, {0.1e-3, 0.2e-3, 0.0}),
                        below = at(load, rubber, {0.1e-3, 0.2e-3, 0.4e-3});
  EXPECT_NEAR(surface.stress(2, 2), -1e4, 1e-6);
  EXPECT_NEAR(surface.stress(0, 2), -2e3, 1e-6);
  EXPECT_NEAR(below.gradient.trace(), 0.0, 1e-14);
  EXPECT_LT(below.hydrostatic, -1e3);
}

}  // namespace
}  // namespace treadmark::kalker
