// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/contact_program/natural_curve.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"
#include "treadmark/detection/contact_program/search_mesh.hpp"
#include "treadmark/detection/contact_program/wheel_mesh.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::detection {
namespace {

constexpr double kMeshRadius = 0.46, kCrown = 0.3;

/// Rail of crown radius 300 mm whose slices move aside by 1:10; nine slices every 10 mm.
SliceSet crossing(Body body) {
  SliceSet slices;
  slices.body = body;
  for (int k = 0; k < 9; ++k) {
    slices.u.push_back(body == Body::rail ? 0.01 * (k - 4) : 0.02 * (k - 4));
    Profile profile;
    profile.body = body;
    const double aside = body == Body::rail ? 0.001 * (k - 4) : 0.0;
    for (int i = -60; i <= 60; ++i) {
      const double y = 0.5e-3 * (body == Body::rail ? i : -i);
      profile.y.push_back(y + aside);
      profile.z.push_back((body == Body::rail ? 1.0 : -1.0) * (kCrown - std::sqrt(kCrown * kCrown - y * y)));
    }
    slices.profiles.push_back(profile);
  }
  return slices;
}

/// A wheel over a rail's top, yawed and rolled a little; the contact frame leans.
struct Scene {
  std::shared_ptr<const Surface> rail, wheel;
  BodyPair bodies;
  Pose X_TC{{2e-3, 1e-3, 0.0}, rotation_x(-0.03)};
  Grid2 grid{-4e-3, -3e-3, 0.2e-3, 0.2e-3, 41, 31};

  Scene(std::shared_ptr<const Surface> r, std::shared_ptr<const Surface> w) : rail(std::move(r)), wheel(std::move(w)) {
    bodies.rail = rail.get();
    bodies.wheel = wheel.get();
    bodies.X_TW = {{0.0, 0.0, -kMeshRadius}, rotation_x(0.01) * rotation_z(0.02) * rotation_y(0.7)};
    bodies.distance_mesh = DistanceMesh{kMeshRadius};
  }

  std::vector<double> on_mesh(const Grid2& g) const {
    std::vector<double> rows, rail_n(g.size()), wheel_n(g.size());
    for (int iy = 0; iy < g.ny; ++iy) rows.push_back(g.y(iy));
    rail->heights({bodies.X_TR.inverse() * X_TC, g}, {rail_n, {}, {}});
    mesh_heights(bodies, X_TC, g, rows, rail_n, wheel_n);
    return wheel_n;
  }

  double greatest_difference(const Grid2& g) const {
    std::vector<double> exact(g.size());
    wheel->heights({bodies.X_TW.inverse() * X_TC, g}, {exact, {}, {}});
    const std::vector<double> mesh = on_mesh(g);
    double most = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i)
      most = std::max(most, std::isnan(mesh[i]) ? 1.0 : std::abs(mesh[i] - exact[i]));
    return most;
  }
};

std::shared_ptr<const Surface> standard_rail() { return analytic::make_standard_surface({"60E1"}, Body::rail, 0.0); }
std::shared_ptr<const Surface> standard_wheel() {
  return analytic::make_standard_surface({"S1002"}, Body::wheel, kMeshRadius);
}

TEST(ReferenceMesh, NaturalCurveFollowsACircle) {
  std::vector<Vec2> points;
  for (int i = -40; i <= 40; ++i) points.emplace_back(0.3 * std::sin(0.002 * i), -0.3 * std::cos(0.002 * i));
  const NaturalCurve curve(points);
  for (const double y : {-0.011, -0.0003, 0.0, 0.0071})
    EXPECT_NEAR(curve.least_over(y), -std::sqrt(0.09 - y * y), 1e-11);
  EXPECT_TRUE(std::isnan(curve.least_over(0.03)));
}

TEST(ReferenceMesh, NaturalCurveOfThreePoints) {
  // Over the first chord t the cubic without bend at the outer end is h (1.5 t - 0.5 t^3).
  const double h = 0.2;
  const NaturalCurve curve({{-1.0, 0.0}, {0.0, h}, {1.0, 0.0}});
  for (const double t : {0.1, 0.5, 0.9}) EXPECT_NEAR(curve.least_over(t - 1.0), h * (1.5 * t - 0.5 * t * t * t), 1e-14);
}

TEST(ReferenceMesh, ChordsOfARoundWheelAreAsFarOffAsTheirSag) {
  const Scene scene(standard_rail(), standard_wheel());
  Grid2 fine = scene.grid;
  fine.dx = fine.dy = 0.1e-3, fine.nx = 81, fine.ny = 61;
  const double coarse_error = scene.greatest_difference(scene.grid), fine_error = scene.greatest_difference(fine);
  // Tread of radius 330 mm and more across, wheel radius along.
  const double sag = 0.125 * 0.2e-3 * 0.2e-3 * (1.0 / kMeshRadius + 1.0 / 0.33);
  EXPECT_LT(coarse_error, 1.1 * sag);
  EXPECT_GT(coarse_error, 0.1 * sag);
  EXPECT_NEAR(coarse_error / fine_error, 4.0, 1.0);
}

TEST(ReferenceMesh, OfARoundWheelMayHaveItsOriginFarOff) {
  Scene scene(standard_rail(), standard_wheel());
  const double near = scene.greatest_difference(scene.grid);
  // Away along the wheel's own sections, so that the lines stay where they are.
  const Mat3 M = scene.bodies.X_TW.rotation * rotation_y(lowest_angle(scene.bodies.X_TW)),
             C = M.transpose() * scene.X_TC.rotation;
  const Vec2 direction = Vec2(C(1, 1), -C(1, 0)).normalized();
  const Vec2 far = 5000.0 * scene.grid.dx / (C(0, 0) * direction.x() + C(0, 1) * direction.y()) * direction;
  scene.X_TC.origin -= scene.X_TC.rotation * Vec3(far.x(), far.y(), 0.0);
  scene.grid.x0 += far.x();
  scene.grid.y0 += far.y();
  EXPECT_NEAR(scene.greatest_difference(scene.grid), near, 1e-3 * near);
}

TEST(ReferenceMesh, LinesOfARoundWheelPassThroughTheOriginHoweverFar) {
  // Elements on the lines of the mesh meet the wheel itself, roughness or not: from a level wheel's origin arcs are all
  // but widths.
  Profile rough;
  rough.body = Body::wheel;
  for (int i = 60; i >= -60; --i) rough.y.push_back(0.5e-3 * i), rough.z.push_back(5e-6 * std::sin(0.9 * i));
  Scene scene(standard_rail(), spline::make_profile_surface(rough, kMeshRadius));
  scene.bodies.X_TW.rotation = Mat3::Identity();
  scene.X_TC.rotation = Mat3::Identity();
  scene.grid = {-4e-3, -3e-3, 0.2e-3, 0.2e-3, 41, 32};
  EXPECT_LT(scene.greatest_difference(scene.grid), 1e-9);
  scene.X_TC.origin.y() -= 60.0 * scene.grid.dy;
  scene.grid.y0 += 60.0 * scene.grid.dy;
  EXPECT_LT(scene.greatest_difference(scene.grid), 1e-9);
  // Half a step aside chords cut the waves.
  scene.grid.y0 += 0.5 * scene.grid.dy;
  const double chords = scene.greatest_difference(scene.grid);
  EXPECT_GT(chords, 2e-8);
  // An origin beside the wheel leaves the lines where they may, not away.
  scene.X_TC.origin.y() -= 2500.0 * scene.grid.dy;
  scene.grid.y0 += 2500.0 * scene.grid.dy;
  EXPECT_LT(scene.greatest_difference(scene.grid), 3.0 * chords);
}

TEST(ReferenceMesh, BicubicMeshOfASmoothSliceWheelIsTheWheel) {
  const Scene scene(standard_rail(), spline::make_slice_surface(crossing(Body::wheel), kMeshRadius));
  Scene level = scene;
  level.bodies.X_TW.rotation = rotation_x(0.01) * rotation_z(0.02);
  EXPECT_LT(level.greatest_difference(level.grid), 2e-10);
}

TEST(ReferenceMesh, CornersLieWhereTheDataLie) {
  const auto wheel = spline::make_slice_surface(crossing(Body::wheel), kMeshRadius);
  const std::vector<double> y = lateral_nodes(*wheel, Pose{}, 0.0, {-10e-3, 10e-3});
  ASSERT_GT(y.size(), 30u);
  std::vector<Vec2> points;
  for (const double at : y) points.emplace_back(0.0, at);
  std::vector<SurfacePoint> found(points.size());
  wheel->locate(Pose{}, points, found);
  for (const SurfacePoint& p : found) EXPECT_NEAR(p.v, std::round(p.v), 1e-6);
  EXPECT_TRUE(lateral_nodes(*standard_wheel(), Pose{}, 0.0, {-10e-3, 10e-3}).empty()) << "arcs have no data";
}

TEST(ReferenceMesh, LinesOverAPartAreThoseOfTheWhole) {
  const auto wheel = spline::make_slice_surface(crossing(Body::wheel), kMeshRadius);
  constexpr int kBeside = 3;
  const std::vector<double> all = mesh_lines(*wheel, 0.1);
  ASSERT_GT(all.size(), 30u);
  const double first = all.front(), last = all.back(), third = (last - first) / 3.0;
  for (const LateralInterval& y : {LateralInterval{first + third, last - third}, LateralInterval{first, first + 1e-3},
                                   LateralInterval{last - 1e-3, last}, LateralInterval{first + third, first + third}}) {
    const std::vector<double> part = mesh_lines(*wheel, 0.1, y, kBeside);
    const auto from = ranges::find(all, part.front());
    ASSERT_NE(from, all.end());
    ASSERT_LE(static_cast<std::ptrdiff_t>(part.size()), all.end() - from);
    EXPECT_TRUE(ranges::equal(part, std::vector(from, from + static_cast<std::ptrdiff_t>(part.size()))));
    const auto below = ranges::count_if(part, [&](double at) { return at < y.low; }),
               above = ranges::count_if(part, [&](double at) { return at > y.high; }),
               all_below = ranges::count_if(all, [&](double at) { return at < y.low; }),
               all_above = ranges::count_if(all, [&](double at) { return at > y.high; });
    EXPECT_GE(below, std::min<std::ptrdiff_t>(kBeside, all_below));
    EXPECT_GE(above, std::min<std::ptrdiff_t>(kBeside, all_above));
  }
}

TEST(ReferenceMesh, SectionsOfAVariableRailAreTheRail) {
  const Scene scene(spline::make_slice_surface(crossing(Body::rail), 0.0), standard_wheel());
  std::vector<double> exact(scene.grid.size()), sections(scene.grid.size());
  scene.rail->heights({scene.bodies.X_TR.inverse() * scene.X_TC, scene.grid}, {exact, {}, {}});
  ASSERT_TRUE(section_heights(scene.bodies, scene.X_TC, scene.grid, sections));
  for (std::size_t i = 0; i < exact.size(); ++i) ASSERT_NEAR(sections[i], exact[i], 2e-9);
}

TEST(ReferenceMesh, SectionsNeedARailMadeOfData) {
  const Scene scene(standard_rail(), standard_wheel());
  std::vector<double> n(scene.grid.size());
  EXPECT_FALSE(section_heights(scene.bodies, scene.X_TC, scene.grid, n));
}

TEST(ReferenceMesh, DamageFarAwayLeavesSectionsAndCorners) {
  const auto rail = spline::make_slice_surface(crossing(Body::rail), 0.0),
             wheel = spline::make_slice_surface(crossing(Body::wheel), kMeshRadius);
  Squat squat;
  squat.length = squat.width = 20e-3, squat.depth = 0.2e-3, squat.x_center = 10.0;
  WheelFlat flat;
  flat.length = 20e-3, flat.depth = 0.2e-3, flat.theta_center = 2.0, flat.width = 0.1;
  const Scene sound(rail, wheel), damaged(analytic::add_defects(rail, {.squats = {squat}}, Body::rail, 0.0),
                                          analytic::add_defects(wheel, {.flats = {flat}}, Body::wheel, kMeshRadius));
  std::vector<double> before(sound.grid.size()), after(sound.grid.size());
  ASSERT_TRUE(section_heights(sound.bodies, sound.X_TC, sound.grid, before));
  ASSERT_TRUE(section_heights(damaged.bodies, damaged.X_TC, damaged.grid, after));
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(after[i], before[i], 1e-12);

  const auto corners = mesh_lines(*wheel, 0.1), found = mesh_lines(*damaged.wheel, 0.1);
  ASSERT_EQ(found.size(), corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_NEAR(found[i], corners[i], 1e-12);
}

TEST(ReferenceMesh, RollersAreNotCutIntoSections) {
  Scene scene(spline::make_slice_surface(crossing(Body::rail), 0.0), standard_wheel());
  scene.bodies.distance_mesh->rail_sections = false;
  std::vector<double> rail(scene.grid.size());
  scene.rail->heights({scene.bodies.X_TR.inverse() * scene.X_TC, scene.grid}, {rail, {}, {}});
  EXPECT_EQ(undeformed_distance(scene.bodies, scene.X_TC, scene.grid).distance,
            undeformed_distance(rail, scene.on_mesh(scene.grid)).distance);
}

TEST(ReferenceMesh, ReachesWhatLiesFarOffASteepPlane) {
  // The plane of a flange: over the rail's top both bodies lie centimetres off it, beside the plane's own points.
  Scene scene(standard_rail(), standard_wheel());
  scene.bodies.X_TW = {{0.0, 0.5e-3, -kMeshRadius}, rotation_x(-0.001) * rotation_z(0.005) * rotation_y(0.7)};
  scene.X_TC = {{3e-3, -34.5e-3, 10e-3}, rotation_x(-1.15)};
  const Grid2 g{-6e-3, -10e-3, 0.4e-3, 0.4e-3, 31, 125};
  std::vector<double> rail(g.size()), wheel(g.size());
  scene.rail->heights({scene.bodies.X_TR.inverse() * scene.X_TC, g}, {rail, {}, {}});
  scene.wheel->heights({scene.bodies.X_TW.inverse() * scene.X_TC, g}, {wheel, {}, {}});
  const std::vector<double> mesh = scene.on_mesh(g);
  int far_off = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    // where the bodies face each other, clear of the ends of both
    if (!(std::abs(rail[i] - wheel[i]) < 1e-3)) continue;
    far_off += std::abs(rail[i]) > 10e-3;
    ASSERT_NEAR(mesh[i], wheel[i], 2e-5) << i % 31 << ' ' << i / 31;
  }
  EXPECT_GT(far_off, 300);
}

TEST(ReferenceMesh, TakesTheForemostOfSeveralParts) {
  // Waves on the flange back hide each other, seen along the normal of a steep plane.
  Profile profile;
  profile.body = Body::wheel;
  for (int i = 0; i <= 240; ++i) {
    const double y = 0.03 - 0.25e-3 * i;
    profile.y.push_back(y);
    profile.z.push_back(y > 0.0 ? 0.0 : -1.2 * y + 1.5e-3 * std::sin(2.0 * y / 1e-3));
  }
  Scene scene(standard_rail(), spline::make_profile_surface(profile, kMeshRadius));
  scene.bodies.X_TW = {{0.0, 0.0, -kMeshRadius}, rotation_x(0.0)};
  scene.X_TC = {{0.0, -10e-3, 12e-3}, rotation_x(-1.45)};
  const Grid2 g{-2e-3, -8e-3, 0.2e-3, 0.1e-3, 21, 161};
  std::vector<double> wheel(g.size());
  scene.wheel->heights({scene.bodies.X_TW.inverse() * scene.X_TC, g}, {wheel, {}, {}});
  std::vector<double> rows;
  for (int iy = 0; iy < g.ny; ++iy) rows.push_back(g.y(iy));
  std::vector<double> mesh(g.size());
  mesh_heights(scene.bodies, scene.X_TC, g, rows, wheel, mesh);
  int compared = 0, other = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (std::isnan(wheel[i]) || std::isnan(mesh[i])) continue;
    ++compared;
    other += std::abs(mesh[i] - wheel[i]) > 0.1e-3;
  }
  EXPECT_GT(compared, 2000);
  EXPECT_LT(other, compared / 20) << "next to edges the mesh may see the part behind";
}

TEST(ReferenceMesh, PlanesAndAnglesGiveOneFacettedWheel) {
  // Both are chords of the same round wheel.
  const auto wheel = standard_wheel();
  const Pose X_TW{{0.0, 0.0, -kMeshRadius}, rotation_z(0.01) * rotation_y(-2.0)};
  const std::vector<double> lines = mesh_lines(*wheel, lowest_angle(X_TW));
  const WheelFacets angles{WheelFacets::Sections::angles, 0.1, 401, lines},
      planes{WheelFacets::Sections::planes, 0.1 * kMeshRadius, 401, lines};
  const Grid2 grid{-5e-3, -10e-3, 0.7e-3, 0.9e-3, 15, 21};
  std::vector<double> by_angles(grid.size()), by_planes(grid.size()), exact(grid.size());
  FacetWheel(*wheel, X_TW, angles).heights(grid, by_angles);
  FacetWheel(*wheel, X_TW, planes).heights(grid, by_planes);
  wheel->heights({X_TW.inverse(), grid}, {exact, {}, {}});
  for (std::size_t i = 0; i < grid.size(); ++i) {
    ASSERT_NEAR(by_angles[i], exact[i], 3e-7);
    ASSERT_NEAR(by_planes[i], exact[i], 3e-7);
  }
}

}  // namespace
}  // namespace treadmark::detection
