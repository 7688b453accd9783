// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "samples.hpp"
#include "treadmark/model/shape/profile_scatter.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using testing::kRound;
using testing::parse;
using testing::Point;
using testing::rail_points;
using testing::wheel_points;

Profile miniprof(const std::string& text, Body body = Body::rail) {
  return parse(text, body, {}, ProfileFormat::miniprof);
}

TEST(TwoColumns, ReadsRailAndWheelInMetres) {
  const Profile rail = parse(columns(rail_points()), Body::rail);
  EXPECT_EQ(rail.y.size(), rail_points().size());
  EXPECT_NEAR(rail.y.front(), -0.036, kRound);
  EXPECT_LT(rail.y.front(), rail.y.back());
  const Profile wheel = parse(columns(wheel_points()), Body::wheel);
  EXPECT_EQ(wheel.y.size(), wheel_points().size());
  EXPECT_NEAR(wheel.y.front(), 0.060, kRound);
  EXPECT_GT(wheel.y.front(), wheel.y.back());
}

/// A crown of radius 300 mm at steps of 0.2 mm, with errors of +-0.01 mm that have no pattern to speak of.
TEST(TwoColumns, AreSmoothedByTheirNoiseUnlessToldOtherwise) {
  std::vector<Point> exact, noisy;
  for (int i = -150; i <= 150; ++i) {
    const double y = 0.2 * i;
    exact.push_back({y, y * y / 600.0});
    noisy.push_back({y, y * y / 600.0 + 0.01 * std::sin(1e4 * i * i)});
  }
  const Profile truth = parse(columns(exact), Body::rail);
  EXPECT_EQ(truth.scatter->removed, 0.0);
  const Profile smooth = parse(columns(noisy), Body::rail);
  ProfileOptions as_given;
  as_given.smoothing = {};
  const Profile raw = parse(columns(noisy), Body::rail, as_given);
  double left = 0.0, given = 0.0;
  for (std::size_t i = 0; i < raw.z.size(); ++i) {
    left = std::max(left, std::fabs(smooth.z[i] - truth.z[i]));
    given = std::max(given, std::fabs(raw.z[i] - truth.z[i]));
  }
  EXPECT_NEAR(given, 10e-6, 0.1e-6);
  EXPECT_LT(left, 4e-6);
  EXPECT_NEAR(smooth.scatter->removed, 7e-6, 1e-6);  // of a sine's values
  EXPECT_EQ(smooth.smoothing.strength, 0.0);
  EXPECT_EQ(raw.scatter, nullptr);
}

TEST(TwoColumns, KnowsFourCommentCharacters) {
  const Profile p = parse("! a\n\"b\n  % c\n# d\n-10 1 ! e\n0 0 # f\n10 1 0.5 % a third column\n", Body::rail);
  EXPECT_EQ(p.y.size(), 3u);
}

TEST(TwoColumns, FindsOutWhetherZPointsUp) {
  auto points = wheel_points();
  const Profile down = parse(columns(points), Body::wheel);
  for (Point& p : points) p.z = -p.z;
  const Profile up = parse(columns(points), Body::wheel);
  ASSERT_EQ(up.z.size(), down.z.size());
  for (std::size_t i = 0; i < up.z.size(); ++i) EXPECT_NEAR(up.z[i], down.z[i], kRound);
  ProfileOptions never;
  never.mirror_z = -1;
  ProfileOptions always;
  always.mirror_z = 1;
  EXPECT_NEAR(parse(columns(points), Body::wheel, always).z.front(), down.z.front(), kRound);
  EXPECT_NEAR(parse(columns(points), Body::wheel, never).z.front(), -down.z.front(), kRound);
}

TEST(TwoColumns, MirrorsYAndRestoresTheOrder) {
  auto points = rail_points();
  points.resize(30);  // y from -36 to 22
  ProfileOptions mirror;
  mirror.mirror_y = 1;
  const Profile p = parse(columns(points), Body::rail, mirror);
  EXPECT_NEAR(p.y.front(), -0.022, kRound);
  EXPECT_NEAR(p.y.back(), 0.036, kRound);
  mirror.mirror_y = -1;
  EXPECT_NEAR(parse(columns(points), Body::rail, mirror).y.front(), -0.036, kRound);
}

TEST(TwoColumns, ScaleOf1000IsForMetres) {
  auto points = rail_points();
  for (Point& p : points) p = {1e-3 * p.y, 1e-3 * p.z};
  TREADMARK_EXPECT_ERROR(parse(columns(points), Body::rail), "is the file in metres? use a scale of 1000", 0, 0);
  ProfileOptions options;
  options.scale = 1000.0;
  EXPECT_NEAR(parse(columns(points), Body::rail, options).y.front(), -0.036, 1e-6);
  TREADMARK_EXPECT_ERROR(parse(columns(rail_points()), Body::rail, options), "use a scale of 1)", 0, 0);
}

TEST(TwoColumns, NearPointsAreMeasuredInMillimetres) {
  // 0.05 mm apart in a file in metres: nothing to drop.
  std::string text;
  for (int i = 0; i <= 400; ++i) text += std::to_string(0.00005 * i) + " 0.001\n";
  ProfileOptions options;
  options.scale = 1000.0;
  EXPECT_EQ(parse(text, Body::rail, options).y.size(), 401u);
}

TEST(TwoColumns, RefusesWhenCleaningRemovesTooMuch) {
  std::string text = "-10 1\n";
  for (int i = 0; i < 5; ++i) text += "0 0\n";
  text += "10 1\n";
  TREADMARK_EXPECT_ERROR(parse(text, Body::rail), "removed 4 of 7 points", 0, 0);
  ProfileOptions options;
  options.max_omit = 1.0;
  EXPECT_EQ(parse(text, Body::rail, options).y.size(), 3u);
}

TEST(TwoColumns, ZigzagThresholdIsAtLeast45Degrees) {
  const std::string steps = "0 0\n10 0\n10 -2\n20 -2\n30 5\n40 5\n";
  ProfileOptions options;
  options.zigzag_threshold = 0.0;
  // The last two turns are below 45 degrees: only the two right angles are merged.
  EXPECT_EQ(parse(steps, Body::rail, options).y.size(), 5u);
  EXPECT_EQ(parse(steps, Body::rail).y.size(), 6u);
}

TEST(TwoColumns, RefusesBadLines) {
  TREADMARK_EXPECT_ERROR(parse("0 0\n 1.0\n", Body::rail), "too few numbers", 2, 2);
  TREADMARK_EXPECT_ERROR(parse("0 0\n1 y\n", Body::rail), "a number is expected, this is 'y'", 2, 3);
  TREADMARK_EXPECT_ERROR(parse("0 0\n1 2 y\n", Body::rail), "a number is expected, this is 'y'", 2, 5);
  TREADMARK_EXPECT_ERROR(parse("0 0\nNaN 1\n", Body::rail), "at least 2 points, there are 1", 0, 0);
  TREADMARK_EXPECT_ERROR(parse("0 0\n1 -Inf\n2 NaN\n3 0\n", Body::rail),
                         "2 of 4 points between the first and the last one", 2, 0);
  TREADMARK_EXPECT_ERROR(parse("", Body::rail), "at least 2 points, there are 0", 0, 0);
  TREADMARK_EXPECT_ERROR(parse(std::string("0 0\n1 \0 2\n", 10), Body::rail), "NUL byte", 2, 3);
}

TEST(TwoColumns, RefusesImplausibleShapes) {
  TREADMARK_EXPECT_ERROR(parse("0 0\n4.9 0\n", Body::rail), "4.9 mm long, outside 5 to 500 mm", 0, 0);
  TREADMARK_EXPECT_ERROR(parse("0 0\n501 0\n", Body::rail), "501 mm long", 0, 0);
  TREADMARK_EXPECT_ERROR(parse("0 0\n0.1 0\n", Body::rail), "use a scale of 1000", 0, 0);
  TREADMARK_EXPECT_ERROR(parse("0 0\n3 0\n", Body::rail), "is the file in inches? use a scale of 25.4", 0, 0);
  TREADMARK_EXPECT_ERROR(parse("0 0\n1e-3 0\n", Body::rail), "check the points and the scale", 0, 0);
  EXPECT_NO_THROW(parse("0 0\n5 0\n", Body::rail));
  EXPECT_NO_THROW(parse("0 0\n500 0\n", Body::rail));
  TREADMARK_EXPECT_ERROR(parse("-1e200 0\n1e308 0\n-1e308 5\n", Body::rail), "mm long", 0, 0);
}

TEST(TwoColumns, RefusesSelfIntersection) {
  TREADMARK_EXPECT_ERROR(parse("-20 5\n0 0\n20 5\n20 10\n5 -5\n40 8\n", Body::rail), "crosses itself", 4, 0);
}

TEST(TwoColumns, RefusesBadOptions) {
  const auto with = [](auto change) {
    ProfileOptions options;
    change(options);
    return testing::error_thrown_by([&] { parse(columns(rail_points()), Body::rail, options); });
  };
  for (const Error& error :
       {with([](ProfileOptions& o) { o.scale = 0.0; }), with([](ProfileOptions& o) { o.scale = 9e-7; }),
        with([](ProfileOptions& o) { o.scale = NAN; }), with([](ProfileOptions& o) { o.scale = INFINITY; })}) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_NE(error.message().find("scale"), std::string::npos);
  }
  EXPECT_EQ(with([](ProfileOptions& o) { o.mirror_y = 2; }).kind(), ErrorKind::configuration);
  EXPECT_EQ(with([](ProfileOptions& o) { o.mirror_z = -3; }).kind(), ErrorKind::configuration);
  EXPECT_EQ(with([](ProfileOptions& o) { o.max_omit = -0.1; }).kind(), ErrorKind::configuration);
  EXPECT_EQ(with([](ProfileOptions& o) { o.zigzag_threshold = NAN; }).kind(), ErrorKind::configuration);
}

TEST(MiniProf, ReadsHeaderAndColumns) {
  const Profile p = miniprof(
      "ProgramName=MiniProf\nColumnDef=A,Y,K,X\nXoffset=1.5\nYOffset = -0.5\nComment=50% = worn\n\n"
      "0.1 1 strange -10\n0.1 0 ? 0\n0.1 1 * 10\n");
  ASSERT_EQ(p.y.size(), 3u);
  EXPECT_NEAR(p.y.front(), -0.0085, kRound);
  EXPECT_NEAR(p.z.front(), 0.0005, kRound);
  EXPECT_NEAR(p.z[1], -0.0005, kRound);
}

TEST(MiniProf, DefaultsToXAndYWithoutAHeader) {
  EXPECT_EQ(miniprof("-10 1\n0 0\n10 1\n").y.size(), 3u);
  EXPECT_EQ(miniprof("\n\nKey=1\n-10 1\n0 0\n10 1\n").y.size(), 3u);
}

TEST(MiniProf, JudgesTheShapeOfAWheel) {
  auto points = wheel_points();
  for (Point& p : points) p.z = -p.z;
  const Profile p = miniprof("ColumnDef=X,Y\n\n" + columns(points), Body::wheel);
  EXPECT_NEAR(*std::max_element(p.z.begin(), p.z.end()), 0.0308, 1e-9);
}

TEST(MiniProf, RefusesBadHeaders) {
  TREADMARK_EXPECT_ERROR(miniprof("ColumnDef=X,A\n"), "must name the columns X and Y", 1, 11);
  TREADMARK_EXPECT_ERROR(miniprof("ColumnDef=X,Y,x\n"), "names x twice", 1, 11);
  TREADMARK_EXPECT_ERROR(miniprof("A=1\nXOffset=abc\n"), "a number is expected", 2, 9);
  TREADMARK_EXPECT_ERROR(miniprof("A=1\n hello\n"), "'Key=value' or numbers are expected", 2, 2);
  TREADMARK_EXPECT_ERROR(miniprof("A=1\n\nB=2\n"), "a number is expected", 3, 1);
}

TEST(MiniProf, RefusesShortLines) {
  TREADMARK_EXPECT_ERROR(miniprof("ColumnDef=X,A,Y\n\n 1 2\n"), "too few numbers", 3, 2);
  TREADMARK_EXPECT_ERROR(miniprof("ColumnDef=X,Y\n"), "at least 2 points, there are 0", 0, 0);
}

}  // namespace
}  // namespace treadmark::io
