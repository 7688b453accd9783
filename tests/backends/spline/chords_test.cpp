// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/chords.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::spline {
namespace {

Profile crown(double step) {
  Profile p;
  p.name = "crown";
  for (int k = -20; k <= 20; ++k) {
    p.y.push_back(k * step);
    p.z.push_back(0.08 - std::sqrt(0.08 * 0.08 - p.y.back() * p.y.back()));
  }
  return p;
}

double between(const Profile& p, double y) {
  std::size_t k = 0;
  while (p.y[k + 1] < y) ++k;
  const double t = (y - p.y[k]) / (p.y[k + 1] - p.y[k]);
  return (1.0 - t) * p.z[k] + t * p.z[k + 1];
}

TEST(Chords, OfAProfileAreStraightLines) {
  const Profile points = crown(1e-3);
  const auto rail = make_chord_surface(points, 0.0);
  ASSERT_TRUE(rail->constant_profile());
  for (double y = -0.0199; y < 0.02; y += 0.37e-3) {
    EXPECT_NEAR(height_at(*rail, {{2.0, 0.0, 0.0}, Mat3::Identity()}, {0.0, y}), between(points, y), 1e-13) << y;
    SurfacePoint p;
    const Vec2 place(0.0, y);
    rail->locate({}, {&place, 1}, {&p, 1});
    EXPECT_EQ(p.curvature_1, 0.0);
    EXPECT_EQ(p.curvature_2, 0.0);
  }
}

TEST(Chords, TurnAtThePointsOnly) {
  const auto rail = make_chord_surface(crown(1e-3), 0.0);
  const auto slope = [&](double y) {
    double dzdy = 0.0;
    const Vec2 place(0.0, y);
    rail->heights_at({}, {&place, 1}, {{}, {}, {&dzdy, 1}});
    return dzdy;
  };
  EXPECT_NEAR(slope(5.05e-3), slope(5.95e-3), 1e-12);
  EXPECT_NEAR(slope(6.05e-3) - slope(5.95e-3), 1e-3 / 0.08, 2e-4);
}

TEST(Chords, OfAWheelAreConesOfOrderTwo) {
  double error[2] = {};
  for (int fine = 0; fine < 2; ++fine) {
    Profile p = crown(fine ? 0.5e-3 : 1e-3);
    p.body = Body::wheel;
    std::reverse(p.y.begin(), p.y.end());
    std::reverse(p.z.begin(), p.z.end());
    for (double& z : p.z) z = -z;
    const auto wheel = make_chord_surface(p, 0.46);
    for (double y = -9.9e-3; y < 9.9e-3; y += 0.13e-3) {
      const double r = 0.46 - (0.08 - std::sqrt(0.08 * 0.08 - y * y));
      error[fine] = std::max(error[fine], std::fabs(height_at(*wheel, {}, {0.0, y}) - r));
    }
  }
  EXPECT_NEAR(error[0], 1e-6 / (8.0 * 0.08), 0.15e-6);  // h^2/(8 R)
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.3);
}

sampling::PointGrid wavy(int stations) {
  sampling::PointGrid g;
  for (int i = 0; i < stations; ++i) g.u.push_back(1e-3 * i);
  for (int k = 0; k <= 10; ++k) g.y.push_back(1e-3 * k);
  for (const double u : g.u)
    for (const double y : g.y) g.h.push_back(1e-4 * std::sin(200.0 * u) * std::cos(300.0 * y));
  return g;
}

// Between two neighbouring nodes of wavy(), t from the first to the second.
double wavy_at(const sampling::PointGrid& g, double x, std::size_t k, double t) {
  return 1e-4 * std::sin(200.0 * x) * ((1.0 - t) * std::cos(300.0 * g.y[k]) + t * std::cos(300.0 * g.y[k + 1]));
}

TEST(ChordsOfChangingSections, AreStraightAcrossAndSmoothAlong) {
  const sampling::PointGrid g = wavy(60);
  const auto rail = make_chord_surface(g, 0.0);
  for (std::size_t k = 0; k < 10; ++k)
    for (const double x : {20.3e-3, 31.7e-3}) {
      for (const double t : {0.2, 0.5, 0.9})
        EXPECT_NEAR(height_at(*rail, {}, {x, 1e-3 * (static_cast<double>(k) + t)}), wavy_at(g, x, k, t), 2e-9) << k;
      if (k > 0) {
        EXPECT_NEAR(height_at(*rail, {}, {x, g.y[k] + 1e-9}), height_at(*rail, {}, {x, g.y[k] - 1e-9}), 1e-10);
      }
    }
}

TEST(ChordsOfChangingSections, TellDerivativesOfTheirOwn) {
  const sampling::PointGrid g = wavy(60);
  const auto rail = make_chord_surface(g, 0.0);
  ASSERT_TRUE(has_exact_derivatives(*rail));
  for (const double t : {0.0, 0.3, 0.8}) {
    const double x = 31.7e-3;
    const Vec2 place(x, 4.0 + t);  // the fourth chord
    SurfaceJet jet;
    evaluate(*rail, {&place, 1}, {&jet, 1});
    const double across = std::cos(300.0 * g.y[4]) - std::cos(300.0 * g.y[3]);
    const double here = (1.0 - t) * std::cos(300.0 * g.y[3]) + t * std::cos(300.0 * g.y[4]);
    EXPECT_NEAR(jet.p.y(), 1e-3 * (3.0 + t), 1e-15);
    EXPECT_NEAR(jet.p.z(), wavy_at(g, x, 3, t), 2e-9);
    EXPECT_NEAR(jet.pu.z(), 1e-4 * 200.0 * std::cos(200.0 * x) * here, 1e-6);
    EXPECT_NEAR(jet.pv.y(), 1e-3, 1e-15);
    EXPECT_NEAR(jet.pv.z(), 1e-4 * std::sin(200.0 * x) * across, 1e-9);
    EXPECT_NEAR(jet.puv.z(), 1e-4 * 200.0 * std::cos(200.0 * x) * across, 1e-6);
    EXPECT_NEAR(jet.puu.z(), -1e-4 * 4e4 * std::sin(200.0 * x) * here, 2e-3);
    EXPECT_EQ(jet.pvv, Vec3::Zero());
  }
}

TEST(ChordsOfChangingSections, EndWhereTheSectionDoes) {
  sampling::PointGrid g = wavy(40);
  for (std::size_t iu = 0; iu < 20; ++iu) g.h[g.index(iu, 10)] = std::nan("");
  for (std::size_t iu = 20; iu < 40; ++iu) g.h[g.index(iu, 5)] = std::nan("");  // a gap amid the section
  const auto rail = make_chord_surface(g, 0.0);
  const auto there = [&](double x, double y) { return !std::isnan(height_at(*rail, {}, {x, y})); };
  EXPECT_FALSE(there(10e-3, 9.5e-3));
  EXPECT_TRUE(there(30e-3, 9.5e-3));
  EXPECT_TRUE(there(10e-3, 8.5e-3));
  EXPECT_TRUE(there(10e-3, 4.5e-3));
  EXPECT_FALSE(there(30e-3, 4.5e-3));
  EXPECT_FALSE(there(30e-3, 5.5e-3));
  EXPECT_TRUE(there(30e-3, 3.5e-3));
  EXPECT_NEAR(height_at(*rail, {}, {30e-3, 6.5e-3}), wavy_at(g, 30e-3, 6, 0.5), 2e-9);
}

TEST(ChordsOfChangingSections, OfAWheelRunRound) {
  sampling::PointGrid g;
  g.body = Body::wheel;
  g.closed = true;
  constexpr int kStations = 720;
  for (int i = 0; i < kStations; ++i) g.u.push_back(2.0 * 3.14159265358979 / kStations * i);
  for (int k = 0; k <= 10; ++k) g.y.push_back(-5e-3 + 1e-3 * k);
  for (const double u : g.u)
    for (const double y : g.y) g.h.push_back(0.46 - 1.5 * y * y + 1e-4 * std::cos(6.0 * u));
  const auto wheel = make_chord_surface(g, 0.46);
  for (const double turn : {0.0, 1.234, 3.2})
    for (const double y : {-4.7e-3, 0.3e-3, 3.5e-3}) {
      const double below = std::floor(y / 1e-3) * 1e-3, t = (y - below) / 1e-3;
      const double wanted =
          0.46 - 1.5 * ((1.0 - t) * below * below + t * (below + 1e-3) * (below + 1e-3)) + 1e-4 * std::cos(6.0 * turn);
      const Pose X{Vec3::Zero(), rotation_y(turn)};
      EXPECT_NEAR(height_at(*wheel, X, {0.0, y}), wanted, 1e-9) << turn << ' ' << y;
    }
}

TEST(ChordsOfChangingSections, NeedFourStations) {
  EXPECT_THROW(make_chord_surface(wavy(3), 0.0), Error);
  sampling::PointGrid g = wavy(10);
  for (std::size_t iu = 0; iu < 10; ++iu)
    if (iu % 4 == 3)
      for (std::size_t iy = 0; iy < g.y.size(); ++iy) g.h[g.index(iu, iy)] = std::nan("");
  EXPECT_THROW(make_chord_surface(g, 0.0), Error) << "three in a row at most";
}

}  // namespace
}  // namespace treadmark::spline
