// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parametric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

/// A ball of radius 0.3 m that tells v = 2 y and nothing of its derivatives.
class Ball final : public Surface {
 public:
  static constexpr double kR = 0.3;
  std::string_view backend() const override { return "ball"; }
  Facing facing() const override { return Facing::up; }
  Box3 bounds() const override { return {{-0.2, -0.2, 0.0}, {0.2, 0.2, kR}}; }
  std::size_t memory_bytes() const override { return 0; }

 private:
  void do_heights(const PlaneGrid&, const HeightsOut&) const override {}
  void do_locate(const Pose& X, std::span<const Vec2> points, std::span<SurfacePoint> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out[i] = {};
      const Vec3 p = X.apply({points[i].x(), points[i].y(), 0.0});
      const double d = kR * kR - p.x() * p.x() - p.y() * p.y();
      if (std::fabs(p.x()) > 0.2 || std::fabs(p.y()) > 0.2) continue;
      out[i].status = LocateStatus::converged;
      out[i].position_S = {p.x(), p.y(), kR - std::sqrt(d)};
      out[i].normal_S = (out[i].position_S - Vec3(0.0, 0.0, kR)) / kR;
      out[i].u = p.x();
      out[i].v = 2.0 * p.y();
    }
  }
  HeightBounds do_height_bounds(const Pose&, const Rectangle&) const override { return {}; }
};

/// A torus: radii R round the axle (y) and r of its section.
SurfaceJet torus(double R, double r, double theta, double phi) {
  const Vec3 e(std::sin(theta), 0.0, std::cos(theta)), along(e.z(), 0.0, -e.x()), axle(0.0, 1.0, 0.0);
  const double s = std::sin(phi), c = std::cos(phi), w = R + r * c;
  return {w * e + r * s * axle,    w * along, r * (-s * e + c * axle), -w * e, -r * s * along,
          -r * (c * e + s * axle), 1.0};
}

TEST(SurfaceShapeOfJets, IsThatOfATorus) {
  constexpr double kR = 0.46, kSection = 0.08;
  for (const double phi : {-0.7, 0.0, 0.4}) {
    const SurfaceShape s = shape_of(torus(kR, kSection, 0.3, phi));
    const double round = std::cos(phi) / (kR + kSection * std::cos(phi));
    EXPECT_NEAR(s.curvature_1, 1.0 / kSection, 1e-12);
    EXPECT_NEAR(s.curvature_2, round, 1e-13);
    const Vec3 e(std::sin(0.3), 0.0, std::cos(0.3)), along(std::cos(0.3), 0.0, -std::sin(0.3));
    EXPECT_NEAR(std::fabs(s.direction_2.dot(along)), 1.0, 1e-13);
    EXPECT_NEAR(s.direction_1.dot(along), 0.0, 1e-13);
    EXPECT_NEAR((s.normal - (std::cos(phi) * e + std::sin(phi) * Vec3::UnitY())).norm(), 0.0, 1e-13);
    // Euler: half-way between the two
    EXPECT_NEAR(normal_curvature(s, s.direction_1 + s.direction_2), 0.5 * (1.0 / kSection + round), 1e-12);
  }
}

TEST(SurfaceShapeOfJets, EqualCurvaturesHaveADirectionToo) {
  // the equator of a ball as a torus of no radius
  const SurfaceShape s = shape_of(torus(0.0, 0.2, 0.1, 0.2));
  EXPECT_NEAR(s.curvature_1, 5.0, 1e-12);
  EXPECT_NEAR(s.curvature_2, 5.0, 1e-12);
  EXPECT_NEAR(s.direction_1.norm(), 1.0, 1e-13);
  EXPECT_NEAR(s.direction_1.dot(s.normal), 0.0, 1e-13);
}

TEST(EvaluateByDifferences, FindsAParameterOfTheSurfacesOwn) {
  const Ball ball;
  EXPECT_FALSE(has_exact_derivatives(ball));
  const std::vector<Vec2> uv{{0.05, 0.12}, {-0.1, 0.0}, {0.0, -0.2}};
  std::vector<SurfaceJet> jets(uv.size());
  evaluate(ball, uv, jets);
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double x = uv[i].x(), y = 0.5 * uv[i].y(), root = std::sqrt(Ball::kR * Ball::kR - x * x - y * y);
    EXPECT_NEAR((jets[i].p - Vec3(x, y, Ball::kR - root)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((jets[i].pu - Vec3(1.0, 0.0, x / root)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((jets[i].pv - Vec3(0.0, 0.5, 0.5 * y / root)).norm(), 0.0, 1e-6);
    const SurfaceShape s = shape_of(jets[i]);
    EXPECT_NEAR(s.curvature_1, 1.0 / Ball::kR, 1e-4);
    EXPECT_NEAR(s.curvature_2, 1.0 / Ball::kR, 1e-4);
    EXPECT_LT(s.normal.z(), 0.0) << "out of the material";
  }
}

TEST(EvaluateByDifferences, TellsWhereThereIsNothing) {
  const Ball ball;
  const std::vector<Vec2> uv{{0.3, 0.0}, {0.0, 1.0}, {SurfaceJet::kNone, 0.0}, {0.1, 0.4 - 1e-7}};
  std::vector<SurfaceJet> jets(uv.size());
  evaluate(ball, uv, jets);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(jets[i].found()) << i;
  ASSERT_TRUE(jets[3].found()) << "at the rim";
  EXPECT_NEAR(shape_of(jets[3]).curvature_2, 1.0 / Ball::kR, 1e-2) << "from one side";
  EXPECT_THROW(evaluate(ball, uv, std::span(jets).first(2)), Error);
}

}  // namespace
}  // namespace treadmark
