// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Lines meet surfaces where curvature is so large that Newton's method alone goes astray.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"

namespace treadmark::testing {
namespace {

constexpr double kArc = 0.2e-3, kLedge = 1e-3, kFlank = 3e-3;  // [m]
constexpr double kSteep = 80.0 * std::numbers::pi / 180.0;
constexpr double kSpacing = 0.02e-3;

/// A ledge between two steep flanks, with edges of 0.2 mm radius.
SurfaceSpec ledge() {
  SurfaceSpec spec;
  ArcChain chain;
  chain.start_angle = -kSteep;
  chain.start_y = -(kFlank * std::cos(kSteep) + kArc * std::sin(kSteep) + 0.5 * kLedge);
  chain.segments = {
      {kFlank, 0.0}, {kArc * kSteep, 1.0 / kArc}, {kLedge, 0.0}, {kArc * kSteep, 1.0 / kArc}, {kFlank, 0.0}};
  spec.shape = chain;
  return spec;
}

/// How many of the lines Newton's method loses that begins in the middle of a flank and makes full steps.
int lost_by_newton(const spline::NurbsSurface& surface, const Pose& X, const std::vector<Vec2>& lines, double v_flank) {
  int lost = 0;
  const Mat3 turn = X.rotation.transpose();
  for (const Vec2& line : lines) {
    double u = 0.0, v = v_flank;
    bool converged = false;
    for (int step = 0; step < 50 && !converged; ++step) {
      const spline::SurfaceDerivatives d = surface.derivatives(u, v);
      const Vec3 at = turn * (d.p - X.origin), by_u = turn * d.pu, by_v = turn * d.pv;
      const double det = by_u.x() * by_v.y() - by_v.x() * by_u.y();
      const Vec2 off = line - at.head<2>();
      u += (off.x() * by_v.y() - by_v.x() * off.y()) / det;
      v += (by_u.x() * off.y() - off.x() * by_u.y()) / det;
      converged = off.norm() < 1e-10;
    }
    lost += converged ? 0 : 1;
  }
  return lost;
}

class Inversion : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Backends, Inversion, ::testing::Values("nurbs", "thb", "mesh"),
                         [](const auto& which) { return std::string(which.param); });

TEST_P(Inversion, ConvergesWhereCurvatureIsLarge) {
  constexpr double kOnLine = 1e-10;
  // chords of such arcs are off by spacing^2 / (8 radius)
  constexpr double kOff = 2.0 * kSpacing * kSpacing / (8.0 * kArc);
  const NaturalSurface natural = create_natural(ledge());
  const auto surface = represent(natural, {GetParam(), kSpacing, {-2e-3, 2e-3, -1.3e-3, 1.3e-3}}).surface;
  const Pose X{Vec3(0.0, 0.0, 1e-3), rotation({0.08, 0.0, 0.1})};
  std::vector<Vec2> lines;
  lines.reserve(std::size_t{21} * 201);
  for (int i = 0; i < 21; ++i)
    for (int j = 0; j < 201; ++j) lines.emplace_back((i - 10) * 0.15e-3, (j - 100) * 9e-6);
  std::vector<SurfacePoint> found(lines.size()), exact(lines.size());
  surface->locate(X, lines, found);
  natural.surface->locate(X, lines, exact);
  double sharpest = 0.0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    ASSERT_EQ(found[k].status, LocateStatus::converged) << lines[k].transpose();
    const Vec3 seen = X.apply_inverse(found[k].position_S);
    EXPECT_LT((seen.head<2>() - lines[k]).norm(), kOnLine);
    EXPECT_LT(std::abs(exact[k].normal_S.dot(found[k].position_S - exact[k].position_S)), kOff) << lines[k].transpose();
    sharpest = std::max(sharpest, found[k].curvature_1);
  }
  EXPECT_GT(sharpest, 0.5 / kArc);
  const auto* spline = dynamic_cast<const spline::NurbsSurface*>(surface.get());
  if (spline == nullptr) return;
  double v_end = 0.0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    EXPECT_LT((spline->point(found[k].u, found[k].v) - found[k].position_S).norm(), kOnLine);
    v_end = std::max(v_end, found[k].v);
  }
  EXPECT_GT(lost_by_newton(*spline, X, lines, v_end), 0) << "too easy";
}

}  // namespace
}  // namespace treadmark::testing
