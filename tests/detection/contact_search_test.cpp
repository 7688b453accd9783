// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/detection/contact_frame.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::detection {
namespace {

constexpr double kSearchRadius = 0.4;

/// A ball (wheel of round meridian) over a plane that is rolled by an angle about x: contact at angle = roll.
struct BallOnPlane {
  std::shared_ptr<const Surface> plane = analytic::make_plane_surface(Facing::up);
  std::shared_ptr<const Surface> ball =
      analytic::make_revolved_surface(analytic::barrel_chain(kSearchRadius, 1.3), kSearchRadius);
  BodyPair bodies;

  BallOnPlane(double roll, double penetration, const Pose& everything = {}) {
    bodies.rail = plane.get();
    bodies.wheel = ball.get();
    bodies.X_TR = everything * Pose{Vec3::Zero(), rotation_x(roll)};
    const Vec3 centre = everything.apply(rotation_x(roll) * Vec3(0.0, 0.0, penetration - kSearchRadius));
    bodies.X_TW = {centre, everything.rotation};
  }
};

SearchSettings settings(const Vec3& middle = Vec3::Zero()) {
  SearchSettings s;
  s.grid_T = {middle.x() - 0.03, middle.y() - 0.03, 1e-3, 5e-4, 61, 121};
  s.refined_points = 80;
  return s;
}

class RolledPlane : public ::testing::TestWithParam<double> {};

TEST_P(RolledPlane, PatchFrameAndDistanceAreThoseOfTheBall) {
  const double roll = GetParam(), penetration = 1e-4;
  const BallOnPlane scene(roll, penetration);
  const SearchResult found = search_contact(scene.bodies, settings());
  ASSERT_EQ(found.patches.size(), 1u);
  const ContactPatch& patch = found.patches[0];
  // Seen vertically the deepest gap of a ball in an inclined plane is penetration / cos(roll), to first order.
  EXPECT_NEAR(found.least_gap, -penetration / std::cos(roll), 2e-3 * penetration);
  EXPECT_NEAR(patch.inclination, roll, 1e-12);
  EXPECT_NEAR(patch.x, 0.0, 1e-7);
  // Vertical depths of a ball are larger downhill: the centre shifts by a share of the depth.
  EXPECT_NEAR(patch.y, 0.0, 2e-6 + 0.6 * penetration * std::abs(std::tan(roll)));
  const double half_width = std::sqrt(2.0 * kSearchRadius * penetration - penetration * penetration);
  EXPECT_NEAR(patch.extent.box.x_max, half_width, 1e-4);
  EXPECT_NEAR(patch.extent.box.y_max, half_width * std::cos(roll), 1.5e-4);

  const ContactFrame frame = contact_frame(scene.bodies, patch);
  EXPECT_NEAR(frame.X_TC.rotation.col(2).y(), -std::sin(roll), 1e-12);
  const Grid2 grid = potential_contact_grid(scene.bodies, patch, frame, {5e-4, 5e-4, 20000});
  EXPECT_LT(grid.x0, -half_width);
  EXPECT_GT(grid.x(grid.nx - 1), half_width);
  EXPECT_LT(grid.y0, -half_width);
  EXPECT_GT(grid.y(grid.ny - 1), half_width);
  EXPECT_NEAR(std::remainder(grid.x0, grid.dx), 0.0, 1e-15)
      << "elements lie at whole multiples of dx from the reference";

  const UndeformedDistance undeformed = undeformed_distance(scene.bodies, frame.X_TC, grid);
  const double offset = frame.X_TC.origin.y() / std::cos(roll);  // of the reference along the plane
  double least = 1.0;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double s = grid.y(iy) + offset;
      const double h = kSearchRadius - std::sqrt(kSearchRadius * kSearchRadius - grid.x(ix) * grid.x(ix) - s * s);
      least = std::min(least, h);
    }
  EXPECT_NEAR(undeformed.approach, penetration - least, 1e-12);
  for (int iy = 0; iy < grid.ny; iy += 3)
    for (int ix = 0; ix < grid.nx; ix += 3) {
      const double s = grid.y(iy) + offset;
      const double h =
          kSearchRadius - std::sqrt(kSearchRadius * kSearchRadius - grid.x(ix) * grid.x(ix) - s * s) - least;
      EXPECT_NEAR(undeformed.distance[grid.index(ix, iy)], h, 1e-11);
    }
}

INSTANTIATE_TEST_SUITE_P(Rolls, RolledPlane, ::testing::Values(0.0, 0.03, -0.3, 0.8, -1.1));

TEST(ContactSearch, MovingEverythingRigidlyMovesTheResultWithIt) {
  const BallOnPlane scene(0.2, 8e-5);
  const Pose shift{{0.013, -0.7071, 0.25}, Mat3::Identity()};
  const BallOnPlane moved(0.2, 8e-5, shift);
  const auto a = search_contact(scene.bodies, settings());
  const auto b = search_contact(moved.bodies, settings(shift.origin));
  ASSERT_EQ(a.patches.size(), 1u);
  ASSERT_EQ(b.patches.size(), 1u);
  EXPECT_NEAR(b.patches[0].x - a.patches[0].x, shift.origin.x(), 1e-10);
  EXPECT_NEAR(b.patches[0].y - a.patches[0].y, shift.origin.y(), 1e-10);
  EXPECT_NEAR(b.patches[0].weight, a.patches[0].weight, 1e-6 * a.patches[0].weight);
  EXPECT_NEAR(b.least_gap, a.least_gap, 1e-14);
}

TEST(ContactSearch, ShiftedWheelEqualsSearchThere) {
  const BallOnPlane low(0.1, 1e-4), high(0.1, 1e-4);
  ContactSearch search(low.bodies, settings());
  for (const double dz : {-5e-5, 0.0, 3e-5, -2e-4}) {
    BodyPair there = low.bodies;
    there.X_TW.origin.z() += dz;
    const auto expected = search_contact(there, settings());
    const auto shifted = search.at(dz);
    ASSERT_EQ(shifted.patches.size(), expected.patches.size());
    EXPECT_NEAR(shifted.least_gap, expected.least_gap, 1e-15);
    for (std::size_t i = 0; i < shifted.patches.size(); ++i)
      EXPECT_NEAR(shifted.patches[i].y, expected.patches[i].y, 1e-9);
  }
}

TEST(ContactSearch, GrazingContactBetweenGridPointsIsFound) {
  BallOnPlane scene(0.0, 2e-8);
  scene.bodies.X_TW.origin += Vec3(4.7e-4, 2.3e-4, 0.0);
  const auto found = search_contact(scene.bodies, settings());
  ASSERT_EQ(found.patches.size(), 1u);
  EXPECT_NEAR(found.patches[0].x, 4.7e-4, 3e-5);
  EXPECT_NEAR(found.patches[0].y, 2.3e-4, 3e-5);
}

TEST(ContactSearch, NoContactKeepsTheGap) {
  const auto found = search_contact(BallOnPlane(0.0, -3e-4).bodies, settings());
  EXPECT_TRUE(found.patches.empty());
  EXPECT_NEAR(found.least_gap, 3e-4, 1e-9);
}

TEST(ContactSearch, BodiesThatNeverFaceEachOtherGiveNaN) {
  BallOnPlane scene(0.0, 1e-4);
  scene.bodies.X_TW.origin.y() += 5.0;
  const auto found = search_contact(scene.bodies, settings());
  EXPECT_TRUE(found.patches.empty());
  EXPECT_TRUE(std::isnan(found.least_gap));
}

TEST(ContactSearch, RefusesAbsurdGrids) {
  SearchSettings s = settings();
  s.grid_T.nx = s.grid_T.ny = 1'000'000;
  EXPECT_THROW(search_contact(BallOnPlane(0.0, 1e-4).bodies, s), Error);
}

TEST(PotentialContact, TooManyElementsAreCoarsened) {
  const BallOnPlane scene(0.0, 1e-4);
  const auto found = search_contact(scene.bodies, settings());
  const ContactFrame frame = contact_frame(scene.bodies, found.patches.at(0));
  const Grid2 fine = potential_contact_grid(scene.bodies, found.patches[0], frame, {1e-5, 1e-5, 20000});
  EXPECT_LT(fine.size(), 20000u);
  EXPECT_GT(fine.size(), 4000u);
  EXPECT_NEAR(std::log2(fine.dx / 1e-5), std::round(std::log2(fine.dx / 1e-5)), 1e-12);
}

}  // namespace
}  // namespace treadmark::detection
