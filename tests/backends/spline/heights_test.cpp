// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Heights, slopes, bounds and locate() of every surface against a brute-force search of sign changes along the line.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/backends/spline/prismatic_surface.hpp"
#include "treadmark/backends/spline/revolution_surface.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/backends/spline/slices/slice_surface.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

constexpr double kHeightTolerance = 1e-10;  // Newton's last correction squared, times curvature
constexpr double kSubjectRadius = 0.49;

// A surface with p(u, v), the range of v and a typical u: all that brute force needs.
struct HeightSubject {
  std::string name;
  std::shared_ptr<const Surface> surface;
  std::function<Vec3(double, double)> point;
  double v_begin, v_end;
  bool wheel;
  double u;  // where planes are put, on a wheel the angle
};

template <class S>
HeightSubject subject(std::string name, std::shared_ptr<const S> s, double v_begin, double v_end, bool wheel,
                      double u) {
  return {std::move(name), s, [s](double a, double b) { return s->point(a, b); }, v_begin, v_end, wheel, u};
}

std::vector<HeightSubject> height_subjects() {
  const auto rail = std::make_shared<const PrismaticSurface>(fit_profile(testing::rail_head()));
  const auto round = std::make_shared<const RevolutionSurface>(fit_profile(testing::flanged_wheel()), kSubjectRadius);
  const auto dent = std::make_shared<const SliceWheel>(fit_slices(testing::dented_wheel()), kSubjectRadius);
  const auto soft =
      std::make_shared<const SliceWheel>(fit_slices(testing::dented_wheel(2e-3, 0.6, true)), kSubjectRadius);
  const auto bend = std::make_shared<const SliceRail>(fit_slices(testing::bending_rail()), 0.0);
  return {subject<PrismaticSurface>("Prismatic", rail, rail->profile().begin(), rail->profile().end(), false, 0.0),
          subject<RevolutionSurface>("Revolution", round, round->profile().begin(), round->profile().end(), true, 0.3),
          subject<SliceWheel>("DentedWheel", dent, 1.0, dent->net().positions(), true, 0.6),
          subject<SliceWheel>("ApproximatedWheel", soft, 1.0, soft->net().positions(), true, 0.65),
          subject<SliceRail>("BendingRail", bend, 1.0, bend->net().positions(), false, 0.03)};
}

// Outermost height over (x, y), by walking along v in small steps. For every v the point of the surface with
// x_P = x is found by bisection in u, so that only y_P(v) - y changes sign at a hit.
struct BruteForce {
  const HeightSubject& s;
  Pose X_SP;

  Vec3 on_cut(double v, double x) const {
    double low = s.u - (s.wheel ? 1.2 : 2.0), high = s.u + (s.wheel ? 1.2 : 2.0);
    const auto miss = [&](double u) { return X_SP.apply_inverse(s.point(u, v)).x() - x; };
    const bool rising = miss(high) > miss(low);
    if ((miss(low) > 0.0) == (miss(high) > 0.0)) return Vec3::Constant(std::nan(""));
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((miss(middle) > 0.0) == rising ? high : low) = middle;
    }
    return X_SP.apply_inverse(s.point(0.5 * (low + high), v));
  }

  // all: every hit.
  std::vector<double> hits(double x, double y) const {
    constexpr int kSteps = 900;
    std::vector<double> all;
    double va = s.v_begin;
    Vec3 a = on_cut(va, x);
    for (int i = 1; i <= kSteps; ++i) {
      const double vb = s.v_begin + (s.v_end - s.v_begin) * i / kSteps;
      const Vec3 b = on_cut(vb, x);
      if ((a.y() - y) * (b.y() - y) <= 0.0) {
        double low = va, high = vb;
        const bool rising = b.y() > a.y();
        for (int k = 0; k < 50; ++k) {
          const double middle = 0.5 * (low + high);
          ((on_cut(middle, x).y() > y) == rising ? high : low) = middle;
        }
        all.push_back(on_cut(0.5 * (low + high), x).z());
      }
      va = vb, a = b;
    }
    return all;
  }

  double outermost(double x, double y) const {
    const auto all = hits(x, y);
    if (all.empty()) return std::nan("");
    return s.wheel ? *std::max_element(all.begin(), all.end()) : *std::min_element(all.begin(), all.end());
  }
};

// Planes that lie near the surface at u, in various positions.
Pose plane_near(const HeightSubject& s, std::mt19937& random, double roll) {
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  Pose pose = testing::random_pose(random, 0.1, 0.03, 0.02, 0.0);
  pose.rotation = rotation_x(roll) * pose.rotation;
  if (!s.wheel) {
    pose.origin = Vec3(s.u + 0.1 * d(random), 0.01 * d(random), 0.02 * d(random));
    return pose;
  }
  const Mat3 turn = rotation_y(s.u + 0.05 * d(random));
  pose.origin = turn * Vec3(0.0, 0.02 * d(random), kSubjectRadius);
  pose.rotation = turn * pose.rotation;
  return pose;
}

class Heights : public ::testing::TestWithParam<int> {
 protected:
  static const HeightSubject& subject() {
    static const std::vector<HeightSubject> all = height_subjects();
    return all[static_cast<std::size_t>(GetParam())];
  }
};

std::string subject_name(const ::testing::TestParamInfo<int>& info) {
  static const char* names[] = {"Prismatic", "Revolution", "DentedWheel", "ApproximatedWheel", "BendingRail"};
  return names[info.param];
}

INSTANTIATE_TEST_SUITE_P(Spline, Heights, ::testing::Range(0, 5), subject_name);

TEST_P(Heights, EqualBruteForceInTiltedPlanes) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  int hits = 0;
  for (const double roll : {0.0, 0.4, -0.4, -1.15, 0.9}) {
    const Pose pose = plane_near(subject(), random, roll);
    const BruteForce brute{subject(), pose};
    for (int i = 0; i < 6; ++i) {
      const double x = 0.05 * d(random), y = 0.05 * d(random);
      const double expected = brute.outermost(x, y), found = height_at(*subject().surface, pose, {x, y});
      ASSERT_EQ(std::isnan(expected), std::isnan(found))
          << "roll " << roll << " x " << x << " y " << y << ' ' << expected;
      if (std::isnan(expected)) continue;
      ++hits;
      EXPECT_NEAR(found, expected, kHeightTolerance) << "roll " << roll << " x " << x << " y " << y;
    }
  }
  EXPECT_GT(hits, 12);
}

TEST_P(Heights, OfAGridEqualThoseOfItsPoints) {
  std::mt19937 random(3);
  for (const double roll : {0.0, -1.0}) {
    PlaneGrid plane{plane_near(subject(), random, roll), {-0.02, -0.06, 1.3e-3, 0.9e-3, 33, 130}};
    std::vector<double> z(plane.grid.size());
    subject().surface->heights(plane, {z, {}, {}});
    int hits = 0;
    for (std::size_t k = 0; k < z.size(); k += 37) {
      const int ix = static_cast<int>(k) % plane.grid.nx, iy = static_cast<int>(k) / plane.grid.nx;
      const double alone = height_at(*subject().surface, plane.X_SP, {plane.grid.x(ix), plane.grid.y(iy)});
      ASSERT_EQ(std::isnan(alone), std::isnan(z[k]));
      if (std::isnan(alone)) continue;
      ++hits;
      EXPECT_NEAR(z[k], alone, kHeightTolerance);
    }
    EXPECT_GT(hits, 20);
  }
}

TEST_P(Heights, AreTheSameForPlanesTurnedByNinetyDegrees) {
  std::mt19937 random(5);
  const Pose pose = plane_near(subject(), random, 0.2);
  Pose turned = pose;  // x_turned = y, y_turned = -x
  turned.rotation.col(0) = pose.rotation.col(1);
  turned.rotation.col(1) = -pose.rotation.col(0);
  for (double x = -0.02; x < 0.03; x += 7e-3)
    for (double y = -0.02; y < 0.03; y += 6e-3)
      EXPECT_NEAR(height_at(*subject().surface, turned, {y, -x}), height_at(*subject().surface, pose, {x, y}),
                  kHeightTolerance);
}

TEST_P(Heights, SlopesEqualDifferences) {
  constexpr double kStep = 1e-6;
  constexpr double kSlopeTolerance = 2e-6;  // third derivative times step^2, and height errors divided by it
  std::mt19937 random(11);
  for (const double roll : {0.0, -0.5}) {
    PlaneGrid plane{plane_near(subject(), random, roll), {-0.02, -0.02, 4e-3, 3.1e-3, 11, 13}};
    std::vector<double> z(plane.grid.size()), dzdx(z), dzdy(z);
    subject().surface->heights(plane, {z, dzdx, dzdy});
    int compared = 0;
    for (int iy = 0; iy < plane.grid.ny; ++iy)
      for (int ix = 0; ix < plane.grid.nx; ++ix) {
        const double x = plane.grid.x(ix), y = plane.grid.y(iy);
        const auto at = [&](double a, double b) { return height_at(*subject().surface, plane.X_SP, {a, b}); };
        const double by_x = (at(x + kStep, y) - at(x - kStep, y)) / (2 * kStep);
        const double by_y = (at(x, y + kStep) - at(x, y - kStep)) / (2 * kStep);
        if (std::isnan(by_x) || std::abs(by_y) > 3.0) continue;
        ++compared;
        const std::size_t k = plane.grid.index(ix, iy);
        EXPECT_NEAR(dzdx[k], by_x, kSlopeTolerance * (1 + by_y * by_y));
        EXPECT_NEAR(dzdy[k], by_y, kSlopeTolerance * (1 + by_y * by_y));
      }
    EXPECT_GT(compared, 60);
  }
}

TEST_P(Heights, LieWithinTheirBounds) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  int hits = 0, empty = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Pose pose = plane_near(subject(), random, 1.2 * d(random));
    const double x = 0.05 * d(random), y = 0.08 * d(random), width = 0.01 * (1 + d(random)),
                 depth = 0.005 * (1 + d(random));
    const Rectangle rectangle{x, x + width, y, y + depth};
    const HeightBounds bounds = subject().surface->height_bounds(pose, rectangle);
    empty += bounds.empty;
    PlaneGrid plane{pose, {x, y, std::max(1e-6, width / 12), std::max(1e-6, depth / 12), 13, 13}};
    std::vector<double> z(plane.grid.size());
    subject().surface->heights(plane, {z, {}, {}});
    double low = 1e9, high = -1e9;
    for (const double value : z) {
      if (std::isnan(value)) continue;
      ++hits;
      low = std::min(low, value), high = std::max(high, value);
      ASSERT_FALSE(bounds.empty);
      ASSERT_GE(value, bounds.z_min);
      ASSERT_LE(value, bounds.z_max);
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(empty, 0);
}

TEST_P(Heights, BoundsOfASmallRectangleAreTight) {
  const HeightSubject& s = subject();
  Pose pose;
  if (s.wheel) pose = {rotation_y(s.u) * Vec3(0, 0, kSubjectRadius), rotation_y(s.u)};
  const HeightBounds bounds = s.surface->height_bounds(pose, {-1e-3, 1e-3, 5e-3, 6e-3});
  ASSERT_FALSE(bounds.empty);
  EXPECT_LT(bounds.z_max - bounds.z_min, 0.2e-3);  // the surface itself varies by up to 0.12 mm there
}

TEST_P(Heights, LocateInvertsEvaluation) {
  std::mt19937 random(29);
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  const HeightSubject& s = subject();
  Pose pose;
  if (s.wheel) pose = {rotation_y(s.u) * Vec3(0, 0, kSubjectRadius), rotation_y(s.u)};
  int found = 0;
  for (int i = 0; i < 40; ++i) {
    const double u = s.u + 0.04 * d(random), v = 0.5 * (s.v_begin + s.v_end) + 0.3 * (s.v_end - s.v_begin) * d(random);
    const Vec3 p = s.point(u, v), p_P = pose.apply_inverse(p);
    const Vec2 target(p_P.x(), p_P.y());
    SurfacePoint at;
    s.surface->locate(pose, {&target, 1}, {&at, 1});
    ASSERT_NE(at.status, LocateStatus::outside);
    if (at.status == LocateStatus::ambiguous) continue;
    ++found;
    EXPECT_NEAR(at.u, u, 1e-9);
    EXPECT_NEAR(at.v, v, 1e-6);  // [m] or cells
    EXPECT_LT((at.position_S - p).norm(), 1e-9);
    EXPECT_NEAR(at.normal_S.norm(), 1.0, 1e-14);
    // Out of the material, along the slopes.
    std::vector<double> z(1), dzdx(1), dzdy(1);
    s.surface->heights({pose, {target.x(), target.y(), 1, 1, 1, 1}}, {z, dzdx, dzdy});
    const Vec3 outward = (s.wheel ? -1.0 : 1.0) * Vec3(dzdx[0], dzdy[0], -1.0).normalized();
    EXPECT_LT((pose.rotation.transpose() * at.normal_S - outward).norm(), 1e-6);
    EXPECT_GE(at.curvature_1, at.curvature_2);
  }
  EXPECT_GT(found, 20);
}

TEST_P(Heights, LieInTheBox) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> d(0.0, 1.0);
  const HeightSubject& s = subject();
  const Box3 box = s.surface->bounds();
  for (int i = 0; i < 500; ++i) {
    const Vec3 p =
        s.point(s.u + (s.wheel ? 6.2 : 1.0) * (d(random) - 0.5), s.v_begin + (s.v_end - s.v_begin) * d(random));
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(p[k], box.min[k] - 1e-12);
      ASSERT_LE(p[k], box.max[k] + 1e-12);
    }
  }
}

TEST_P(Heights, MissBesideTheProfile) {
  Pose pose;
  EXPECT_TRUE(std::isnan(height_at(*subject().surface, pose, {0.0, 0.2})));
  SurfacePoint at;
  const Vec2 target(0.0, 0.2);
  subject().surface->locate(pose, {&target, 1}, {&at, 1});
  EXPECT_EQ(at.status, LocateStatus::outside);
  EXPECT_TRUE(subject().surface->height_bounds(pose, {-0.01, 0.01, 0.19, 0.2}).empty);
}

}  // namespace
}  // namespace treadmark::spline
