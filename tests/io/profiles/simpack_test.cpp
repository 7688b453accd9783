// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>

#include "samples.hpp"

namespace treadmark::io {
namespace {

using testing::kRound;
using testing::Point;
using testing::rail_points;
using testing::simpack;
using testing::wheel_points;

Profile rail(const std::string& keys, const ProfileOptions& options = {},
             const std::vector<Point>& points = rail_points()) {
  return testing::parse(simpack(Body::rail, points, keys), Body::rail, options, ProfileFormat::simpack);
}

Profile rail_text(const std::string& text) { return testing::parse(text, Body::rail, {}, ProfileFormat::simpack); }

std::vector<Point> scaled(std::vector<Point> points, double y_factor, double z_factor) {
  for (Point& p : points) p = {y_factor * p.y, z_factor * p.z};
  return points;
}

std::vector<Point> reversed(std::vector<Point> points) {
  std::reverse(points.begin(), points.end());
  return points;
}

void expect_same(const Profile& a, const Profile& b) {
  ASSERT_EQ(a.y.size(), b.y.size());
  for (std::size_t i = 0; i < a.y.size(); ++i) {
    EXPECT_NEAR(a.y[i], b.y[i], kRound) << i;
    EXPECT_NEAR(a.z[i], b.z[i], kRound) << i;
  }
}

TEST(Simpack, ReadsPointsInMetres) {
  ProfileOptions options;
  options.smoothing = {SmoothingOptions::Method::spline, 0.25};
  const Profile p = rail("", options);
  ASSERT_EQ(p.y.size(), rail_points().size());
  EXPECT_NEAR(p.y.front(), -0.036, kRound);
  EXPECT_NEAR(p.z.front(), 0.00216, kRound);
  EXPECT_EQ(p.body, Body::rail);
  EXPECT_EQ(p.name, "sample");
  EXPECT_EQ(p.smoothing.strength, 0.25);
}

TEST(Simpack, SkipsCommentsWeightsUnknownKeysAndSections) {
  const std::string text =
      "! a comment\n% another\nHEADER.BEGIN\n type=0 ! rail\nheader.end\nspline.begin\n"
      "comment = 'what! is'\n file = 'x.begin'\n units.len.f = 1d3\n"
      "extra.begin\n anything goes\n point.begin\nextra.end\n"
      "point.begin\n-10 1 1.0 ! first\n\n 0. 0. \n  % none\n 10 1 2\r\npoint.end\n more.after = 1\nspline.end\n\n";
  const Profile p = rail_text(text);
  EXPECT_EQ(p.y.size(), 3u);
}

TEST(Simpack, UnitsLenFLeadsToMetres) {
  const auto in_metres = scaled(rail_points(), 1e-3, 1e-3);
  // Written with six decimals a point in m is good to 0.5 um.
  const Profile p = rail("units.len.f = 1\npoint.dist.min = 0\n", {}, in_metres);
  EXPECT_NEAR(p.y.front(), -0.036, 0.5e-6);
  EXPECT_NEAR(p.z.front(), 0.00216, 0.5e-6);
  const Profile in_cm = rail("units.len.f = 100\n", {}, scaled(rail_points(), 0.1, 0.1));
  EXPECT_NEAR(in_cm.y.back(), 0.036, kRound);
}

TEST(Simpack, TheScaleMultiplies) {
  ProfileOptions options;
  options.scale = 2.0;
  EXPECT_NEAR(rail("", options).y.back(), 0.072, kRound);
}

TEST(Simpack, ShiftsComeBeforeBoundsAndMirrors) {
  const Profile p = rail(
      "shift.y = 10\nshift.z = -1\nbound.y.min = -10\nbound.y.max = 20\n"
      "bound.z.min=-1\nbound.z.max=0.5\nmirror.y = 1\n");
  // y + 10 in [-10, 20] keeps -20..10, mirrored -20..10 again.
  EXPECT_NEAR(p.y.front(), -0.020, kRound);
  EXPECT_NEAR(p.y.back(), 0.010, kRound);
  EXPECT_EQ(p.y.size(), 16u);
  EXPECT_NEAR(*std::max_element(p.z.begin(), p.z.end()), -1e-3 + 4e-3 / 6.0, 1e-9);
  const Profile clipped = rail("bound.z.min = 0\nbound.z.max = 1\n");
  EXPECT_NEAR(clipped.z.front(), 1e-3, kRound);
}

TEST(Simpack, FileAndInputMirrorsCancelInY) {
  auto lopsided = rail_points();
  lopsided.resize(30);  // y from -36 to 22
  ProfileOptions mirror;
  mirror.mirror_y = 1;
  ProfileOptions never;
  never.mirror_y = -1;
  const Profile plain = rail("", {}, lopsided);
  const Profile by_file = rail("mirror.y = 1\n", {}, lopsided);
  EXPECT_NEAR(plain.y.front(), -0.036, kRound);
  EXPECT_NEAR(by_file.y.front(), -0.022, kRound);
  expect_same(rail("", mirror, lopsided), by_file);
  expect_same(rail("mirror.y = 1\n", mirror, lopsided), plain);
  expect_same(rail("mirror.y = 1\n", never, lopsided), plain);
}

TEST(Simpack, TheFileDecidesOnZUnlessTheInputDoes) {
  ProfileOptions mirror, never;
  mirror.mirror_z = 1;
  never.mirror_z = -1;
  const auto up = scaled(rail_points(), 1, -1);
  const Profile right = rail("");
  EXPECT_LT(rail("", {}, up).z.front(), 0.0);  // nothing is guessed from the shape
  expect_same(rail("mirror.z = 1\n", {}, up), right);
  expect_same(rail("", mirror, up), right);
  expect_same(rail("mirror.z = 1\n", mirror), right);
  expect_same(rail("mirror.z = 1\n", never), right);
}

TEST(Simpack, InvertsByKeyOrByItself) {
  const Profile right = rail("");
  expect_same(rail("inversion = 1\n", {}, reversed(rail_points())), right);
  expect_same(rail("inversion = 0\n", {}, reversed(rail_points())), right);
  TREADMARK_EXPECT_ERROR(rail("inversion = 1\n"), "must run with increasing y", 0, 0);
  TREADMARK_EXPECT_ERROR(
      testing::parse(simpack(Body::wheel, wheel_points(), "inversion=1\n"), Body::wheel, {}, ProfileFormat::simpack),
      "must run with decreasing y", 0, 0);
}

TEST(Simpack, NearDistanceIsTheFilesOwn) {
  auto points = rail_points();
  points.insert(points.begin() + 19, Point{0.00005, 0.0});
  EXPECT_EQ(rail("", {}, points).y.size(), points.size() - 1);
  EXPECT_EQ(rail("point.dist.min = 0\n", {}, points).y.size(), points.size());
  EXPECT_EQ(rail("point.dist.min = 3\n", {}, rail_points()).y.size(), 19u);
}

TEST(Simpack, RefusesTheOtherBody) {
  TREADMARK_EXPECT_ERROR(testing::parse(simpack(Body::rail, rail_points()), Body::wheel, {}, ProfileFormat::simpack),
                         "this is a rail profile, a wheel profile is expected", 3, 10);
  TREADMARK_EXPECT_ERROR(testing::parse(simpack(Body::wheel, wheel_points()), Body::rail, {}, ProfileFormat::simpack),
                         "this is a wheel profile", 3, 10);
}

TEST(Simpack, RefusesRotation) {
  TREADMARK_EXPECT_ERROR(rail("rotate = 0.1\n"), "'rotate' must be 0", 7, 10);
  EXPECT_NO_THROW(rail("rotate = +0.0e+00\n"));
}

TEST(Simpack, RefusesBadValues) {
  TREADMARK_EXPECT_ERROR(rail("mirror.y = 2\n"), "'mirror.y' must be 0 or 1", 7, 12);
  TREADMARK_EXPECT_ERROR(rail("units.len.f = 0\n"), "'units.len.f' must be positive", 7, 15);
  TREADMARK_EXPECT_ERROR(rail("shift.y = \n"), "'shift.y' has no value", 7, 10);
  TREADMARK_EXPECT_ERROR(rail("shift.y = 1 2\n"), "takes one value", 7, 13);
  TREADMARK_EXPECT_ERROR(rail("shift.y = nan\n"), "is not finite", 7, 11);
  TREADMARK_EXPECT_ERROR(rail("nonsense\n"), "'key = value' is expected", 7, 1);
  TREADMARK_EXPECT_ERROR(rail(" = 3\n"), "a key is missing", 7, 2);
  TREADMARK_EXPECT_ERROR(rail_text("header.begin\ntype = 3\n"), "type must be 0 (rail) or 1 (wheel)", 2, 8);
}

TEST(Simpack, RefusesTruncatedFiles) {
  const std::string whole = simpack(Body::rail, rail_points());
  TREADMARK_EXPECT_ERROR(rail_text("header.begin\n type = 0\n"), "without 'header.end'", 2, 0);
  TREADMARK_EXPECT_ERROR(rail_text(whole.substr(0, whole.find("point.end"))), "without 'point.end'", 44, 0);
  TREADMARK_EXPECT_ERROR(rail_text(whole.substr(0, whole.find("spline.end"))), "without 'spline.end'", 45, 0);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\nother.begin\nspline.end\n"), "without 'other.end'", 3, 0);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\n\x01\xff.begin\n"), "without '??.end'", 2, 0);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\nspline.end\n"), "no 'point.begin'", 2, 0);
  TREADMARK_EXPECT_ERROR(rail_text(""), "no 'point.begin'", 0, 0);
}

TEST(Simpack, RefusesDisorderedSections) {
  TREADMARK_EXPECT_ERROR(rail_text("1 2\n"), "text outside the sections: '1'", 1, 1);
  TREADMARK_EXPECT_ERROR(rail_text("point.begin\n"), "does not belong here", 1, 1);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\n header.begin\n"), "does not belong here", 2, 2);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\nheader.end\n"), "ends a section that is not open", 2, 1);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\npoint.begin\n0 0\nspline.end\n"), "not open", 4, 1);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\npoint.begin\n0 0\nother.begin\n"), "before 'point.end'", 4, 1);
  TREADMARK_EXPECT_ERROR(rail_text("spline.begin\npoint.begin\npoint.end\npoint.begin\n"), "a second 'point.begin'", 4,
                         1);
}

TEST(Simpack, RefusesBadPoints) {
  const auto with_point = [](const std::string& line) {
    return rail_text("spline.begin\npoint.begin\n" + line + "\npoint.end\nspline.end\n");
  };
  TREADMARK_EXPECT_ERROR(with_point("  1.0"), "a point needs y and z", 3, 3);
  TREADMARK_EXPECT_ERROR(with_point("1 x"), "a number is expected, this is 'x'", 3, 3);
  TREADMARK_EXPECT_ERROR(with_point("x 1"), "a number is expected, this is 'x'", 3, 1);
  TREADMARK_EXPECT_ERROR(with_point("1 inf"), "is not finite", 3, 3);
  TREADMARK_EXPECT_ERROR(with_point("1 2 w"), "a number is expected", 3, 5);
  TREADMARK_EXPECT_ERROR(with_point("1 2 1 4"), "this is more: '4'", 3, 7);
  TREADMARK_EXPECT_ERROR(with_point("1 2"), "a profile needs at least 2 points, there are 1", 0, 0);
}

TEST(Simpack, RefusesABoundThatLeavesNothing) {
  TREADMARK_EXPECT_ERROR(rail("bound.y.min = 100\nbound.y.max = 200\n"), "at least 2 points, there are 0", 0, 0);
}

}  // namespace
}  // namespace treadmark::io
