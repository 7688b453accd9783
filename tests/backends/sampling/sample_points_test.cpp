// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/sample_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::sampling {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.46;

std::shared_ptr<const Surface> cylinder_rail() {
  return analytic::make_prismatic_surface(analytic::cylinder_chain(0.1, 1.2));
}
std::shared_ptr<const Surface> s1002() { return analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius); }

TEST(LateralNodes, AreSpacedAlongTheArcOfACircle) {
  const std::vector<double> station{0.0};
  constexpr double kSpacing = 1e-3;
  const auto y = lateral_nodes(*cylinder_rail(), Body::rail, station, kSpacing, -1e30, 1e30);
  EXPECT_NEAR(y.front(), -0.1 * std::sin(1.2), 1e-9);
  EXPECT_NEAR(y.back(), 0.1 * std::sin(1.2), 1e-9);
  // equal angles, to the error of arc lengths measured as chords of a quarter step
  const double steps = static_cast<double>(y.size() - 1), angle = 2.4 / steps;
  EXPECT_LE(0.1 * angle, kSpacing * (1.0 + 1e-9));
  EXPECT_GT(0.1 * angle, 0.95 * kSpacing);
  for (std::size_t i = 1; i < y.size(); ++i)
    EXPECT_NEAR(std::asin(std::min(1.0, y[i] / 0.1)) - std::asin(std::max(-1.0, y[i - 1] / 0.1)), angle, 1e-3 * angle)
        << i;
}

TEST(LateralNodes, FollowAVerticalEndOfAProfile) {
  // the back of the flange of S1002 ends vertically: equal steps of y would leave the last one 4 mm long
  const std::vector<double> station{0.3};
  const auto y = lateral_nodes(*s1002(), Body::wheel, station, 1e-3, -1e30, 1e30);
  std::vector<double> r(y.size());
  section_heights(*s1002(), Body::wheel, 0.3, y, {r, {}, {}});
  for (std::size_t i = 1; i < y.size(); ++i) {
    ASSERT_FALSE(std::isnan(r[i]));
    EXPECT_LE(std::hypot(y[i] - y[i - 1], r[i] - r[i - 1]), 1.001e-3) << y[i];
  }
}

TEST(LateralNodes, KeepToTheGivenRange) {
  const std::vector<double> station{0.0};
  const auto y = lateral_nodes(*s1002(), Body::wheel, station, 1e-3, -0.01, 0.02);
  EXPECT_DOUBLE_EQ(y.front(), -0.01);
  EXPECT_DOUBLE_EQ(y.back(), 0.02);
}

TEST(LateralNodes, RefuseWhatCannotBeSampled) {
  const std::vector<double> station{0.0};
  const auto plane = analytic::make_plane_surface(Facing::up);
  EXPECT_THROW(lateral_nodes(*plane, Body::rail, station, 1e-3, -1e30, 1e30), Error);
  EXPECT_THROW(lateral_nodes(*s1002(), Body::wheel, station, 0.0, -1e30, 1e30), Error);
  EXPECT_THROW(lateral_nodes(*s1002(), Body::wheel, station, 1e-9, -1e30, 1e30), Error);
  EXPECT_THROW(lateral_nodes(*s1002(), Body::wheel, station, 1e-3, 0.2, 0.3), Error);
  EXPECT_EQ(lateral_nodes(*plane, Body::rail, station, 1e-3, 0.0, 0.01).size(), 11u);
}

TEST(SamplePoints, LieOnTheSurface) {
  const PointGrid grid = sample_points(*s1002(), Body::wheel, kRadius, {5e-3, 0.0, {0.1, 0.3, -1e30, 1e30}});
  EXPECT_FALSE(grid.closed);
  EXPECT_DOUBLE_EQ(grid.u.front(), 0.1);
  EXPECT_DOUBLE_EQ(grid.u.back(), 0.3);
  EXPECT_LE((grid.u[1] - grid.u[0]) * kRadius, 5e-3);
  for (std::size_t iu = 0; iu < grid.u.size(); iu += 7)
    for (std::size_t iy = 1; iy + 1 < grid.y.size(); ++iy) {
      // seen in another plane
      const Vec3 p = grid.point(iu, iy);
      const Pose X{{0.0, 0.0, 0.0}, rotation_y(0.2)};
      const Vec3 q = X.apply_inverse(p);
      EXPECT_NEAR(height_at(*s1002(), X, {q.x(), q.y()}), q.z(), 1e-10);
    }
}

TEST(SamplePoints, CloseAWholeWheel) {
  const PointGrid grid = sample_points(*s1002(), Body::wheel, kRadius, {20e-3, 0.0, {}});
  ASSERT_TRUE(grid.closed);
  const double step = 2.0 * kPi / static_cast<double>(grid.u.size());
  EXPECT_NEAR(grid.u.back() + step, grid.u.front() + 2.0 * kPi, 1e-12);
}

TEST(SamplePoints, AreTheSameForAnyNumberOfThreads) {
  const SampleSettings settings{4e-3, 0.0, {-0.1, 0.1, -1e30, 1e30}};
  std::vector<double> one, many;
  {
    ThreadLimit limit(1);
    one = sample_points(*s1002(), Body::wheel, kRadius, settings).h;
  }
  {
    ThreadLimit limit(4);
    many = sample_points(*s1002(), Body::wheel, kRadius, settings).h;
  }
  EXPECT_EQ(one, many);
}

TEST(SamplePoints, FollowASectionThatMovesAside) {
  // a head of one circle that moves by 1:10: common nodes would be as dense everywhere as on its steep sides
  constexpr double kHead = 0.03, kHalfAngle = 1.4, kSlope = 0.1, kSpacing = 1e-3;
  SliceSet slices;
  for (int i = 0; i <= 40; ++i) {
    slices.u.push_back(0.01 * i);
    Profile profile;
    for (int k = 0; k <= 200; ++k) {
      const double angle = kHalfAngle * (k - 100) / 100.0;
      profile.y.push_back(kHead * std::sin(angle) + kSlope * slices.u.back());
      profile.z.push_back(kHead * (1.0 - std::cos(angle)));
    }
    slices.profiles.push_back(std::move(profile));
  }
  const auto rail = spline::make_slice_surface(slices, 0.0);
  for (const bool staggered : {true, false})
    for (const bool common : {true, false}) {
      SampleSettings settings{kSpacing, 0.0, {0.0, 0.4, -1.0, 1.0}};
      settings.staggered = staggered;
      settings.common = common;
      const PointGrid grid = sample_points(*rail, Body::rail, 0.0, settings);
      const double steps = static_cast<double>(grid.y.size() - 1), angle = 2.0 * kHalfAngle / steps;
      const double step = (staggered ? 0.75 : 1.0) * kSpacing;  // height of the triangles
      EXPECT_LE(kHead * angle, step);
      EXPECT_GT(kHead * angle, 0.85 * step) << "a tenth more points than the section is long";
      for (std::size_t iu = 0; iu < grid.u.size(); iu += 7)
        for (std::size_t iy = 0; iy < grid.y.size(); ++iy) {
          if (staggered && iu + 1 == grid.u.size() && iy % 2 == 1) continue;  // behind the end of the region
          ASSERT_TRUE(grid.present(iu, iy)) << iu << ' ' << iy;
          const Vec3 p = grid.point(iu, iy);
          const double beside = p.y() - kSlope * p.x();
          EXPECT_NEAR(std::hypot(beside, p.z() - kHead), kHead, 1e-7);
          // at equal angles, to the error of arc lengths measured as chords of a quarter step
          EXPECT_NEAR(std::atan2(beside, kHead - p.z()), -kHalfAngle + angle * static_cast<double>(iy), 0.01 * angle);
        }
      settings.follow = false;
      EXPECT_TRUE(sample_points(*rail, Body::rail, 0.0, settings).own_y.empty());
    }
}

TEST(SamplePoints, NeedEndsOfARail) {
  EXPECT_THROW(sample_points(*cylinder_rail(), Body::rail, 0.0, {1e-3, 0.0, {}}), Error);
  EXPECT_THROW(sample_points(*cylinder_rail(), Body::rail, 0.0, {1e-3, 1e-9, {0.0, 1.0, -1e30, 1e30}}), Error);
  EXPECT_NO_THROW(sample_points(*cylinder_rail(), Body::rail, 0.0, {1e-2, 0.0, {0.0, 1.0, -1e30, 1e30}}));
}

/// A sector of a wheel: nothing outside of some angles, here across theta = pi.
class Sector final : public Surface {
 public:
  std::string_view backend() const override { return "sector"; }
  Facing facing() const override { return Facing::down; }
  Box3 bounds() const override { return {{-0.5, -0.02, -0.5}, {0.5, 0.02, 0.5}}; }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  void do_heights(const PlaneGrid& p, const HeightsOut& out) const override {
    const Vec3 n = p.X_SP.rotation.col(2);
    const double theta = std::atan2(n.x(), n.z()), from_back = kPi - std::fabs(theta);
    for (double& z : out.z) z = from_back < 0.5 ? 0.46 : std::nan("");
  }
  void do_locate(const Pose&, std::span<const Vec2>, std::span<SurfacePoint>) const override {}
  HeightBounds do_height_bounds(const Pose&, const Rectangle&) const override { return {0.46, 0.46, false}; }
};

TEST(SamplePoints, KeepThePartOfAWheelThatIsThere) {
  const PointGrid grid = sample_points(Sector(), Body::wheel, 0.46, {5e-3, 0.0, {}});
  EXPECT_FALSE(grid.closed);
  EXPECT_NEAR(grid.u.front(), kPi - 0.5, 5e-3 / 0.46);
  EXPECT_NEAR(grid.u.back(), kPi + 0.5, 5e-3 / 0.46);
  for (std::size_t i = 1; i < grid.u.size(); ++i) EXPECT_NEAR(grid.u[i] - grid.u[i - 1], grid.u[1] - grid.u[0], 1e-12);
  for (const double h : grid.h) EXPECT_EQ(h, 0.46);
}

}  // namespace
}  // namespace treadmark::sampling
