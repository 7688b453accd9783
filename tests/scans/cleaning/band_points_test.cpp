// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/band_points.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/scans/placement/band_frame.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

constexpr double kPi = std::numbers::pi, kBandRadius = 0.46, kTurn = 2.0 * kPi * kBandRadius;

Section section_of(Body body) {
  auto points = tests::nominal_points(body == Body::wheel ? "S1002" : "60E1", body);
  const double reach = body == Body::wheel ? 60e-3 : 30e-3;
  std::erase_if(points, [&](const Vec2& p) { return std::fabs(p.x()) > reach; });
  if (body == Body::wheel)
    for (Vec2& p : points) p.y() += kBandRadius;
  return Section(points);
}

/// A point of which place and distance are known.
struct Known {
  double u, s, d;
};
Vec3 point_of(Body body, const Section& section, const Known& k) {
  const Section::Point at = section.at(k.s);
  const Vec2 p = at.position + k.d * at.normal;
  return from_natural(body, {k.u, p.x(), p.y()});
}

/// Random places in [u_min, u_max], 3 mm or more from the ends of the section.
std::vector<Known> random_places(const Section& section, std::size_t count, double u_min, double u_max,
                                 std::uint64_t seed) {
  Random random(seed);
  std::vector<Known> out(count);
  for (Known& k : out)
    k = {u_min + (u_max - u_min) * random.uniform(), 3e-3 + (section.length() - 6e-3) * random.uniform(),
         1e-3 * (random.uniform() - 0.5)};
  return out;
}

std::vector<Vec3> cloud_of(Body body, const Section& section, const std::vector<Known>& places, const Pose& X_CS) {
  std::vector<Vec3> out;
  for (const Known& k : places) out.push_back(X_CS.apply(point_of(body, section, k)));
  return out;
}

void expect_sorted(const Projection& p) {
  const BandPoints& b = p.points;
  ASSERT_EQ(b.begin.size(), b.rows * b.columns + 1);
  EXPECT_EQ(b.begin.front(), 0u);
  ASSERT_EQ(b.begin.back(), b.size());
  EXPECT_NEAR(b.cell_a * static_cast<double>(b.rows), p.band.length(), 1e-9);
  EXPECT_NEAR(b.cell_s * static_cast<double>(b.columns), p.band.section.length(), 1e-9);
  EXPECT_EQ(b.rows % (std::size_t{1} << b.halvings_a), 0u);
  EXPECT_EQ(b.columns % (std::size_t{1} << b.halvings_s), 0u);
  std::set<std::uint32_t> indices(b.index.begin(), b.index.end());
  EXPECT_EQ(indices.size(), b.size());
  for (const auto* list : {&b.a, &b.s, &b.d}) ASSERT_EQ(list->size(), b.size());
  for (std::size_t r = 0; r < b.rows; ++r)
    for (std::size_t c = 0; c < b.columns; ++c)
      for (std::size_t i = b.first(r, c); i < b.begin[r * b.columns + c + 1]; ++i) {
        constexpr double kRound = 1e-6;
        ASSERT_GE(b.a[i], b.cell_a * static_cast<double>(r) - kRound);
        ASSERT_LE(b.a[i], b.cell_a * static_cast<double>(r + 1) + kRound);
        ASSERT_GE(b.s[i], b.cell_s * static_cast<double>(c) - kRound);
        ASSERT_LE(b.s[i], b.cell_s * static_cast<double>(c + 1) + kRound);
        EXPECT_EQ(b.state[i], PointState::used);
      }
}

void expect_places(const Projection& p, Body body, const std::vector<Known>& places) {
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    const Known& k = places[p.points.index[i]];
    double off = p.band.a_min + p.points.a[i] - (body == Body::wheel ? kBandRadius * k.u : k.u);
    if (body == Body::wheel) off -= kTurn * std::round(off / kTurn);
    ASSERT_NEAR(off, 0.0, 1e-6);
    ASSERT_NEAR(p.points.s[i], k.s, 1e-7);
    ASSERT_NEAR(p.points.d[i], k.d, 1e-8);
  }
}

TEST(BandPoints, PointsOfAWheelLieWhereTheyWerePut) {
  const Section section = section_of(Body::wheel);
  const auto places = random_places(section, 60000, -kPi, kPi, 1);
  const Pose frame = tests::some_frame(5);
  const auto cloud = cloud_of(Body::wheel, section, places, frame);
  std::vector<std::uint8_t> keep(cloud.size(), 1);
  for (std::size_t i = 0; i < keep.size(); i += 7) keep[i] = 0;
  const Projection p = project(cloud, keep, frame, section, {Body::wheel, kBandRadius});
  EXPECT_TRUE(p.band.closed);
  EXPECT_NEAR(p.band.length(), kTurn, 1e-12);
  EXPECT_EQ(p.points.size(), static_cast<std::size_t>(std::count(keep.begin(), keep.end(), 1)));
  for (const std::uint32_t i : p.points.index) EXPECT_NE(keep[i], 0);
  expect_sorted(p);
  expect_places(p, Body::wheel, places);
  // near 1 mm, and whole numbers of coarse intervals that four rows of may never meet
  EXPECT_NEAR(p.points.cell_a, 1e-3, 0.35e-3);
  EXPECT_NEAR(p.points.cell_s, 1e-3, 0.35e-3);
  EXPECT_EQ((p.points.rows >> p.points.halvings_a) % 4, 0u);
}

TEST(BandPoints, PointsOfARailLieWhereTheyWerePut) {
  const Section section = section_of(Body::rail);
  const auto places = random_places(section, 40000, -0.2, 0.3, 2);
  const Pose frame = tests::some_frame(6);
  const Projection p = project(cloud_of(Body::rail, section, places, frame), {}, frame, section, {});
  EXPECT_FALSE(p.band.closed);
  EXPECT_NEAR(p.band.a_min, -0.2, 1e-4);
  EXPECT_NEAR(p.band.a_max, 0.3, 1e-4);
  EXPECT_GE(p.points.size() + 1, places.size());
  EXPECT_EQ(p.points.size() + p.beyond_length, places.size());
  expect_sorted(p);
  expect_places(p, Body::rail, places);
}

TEST(BandPoints, WhatIsOffTheBandIsCounted) {
  const Section section = section_of(Body::rail);
  auto places = random_places(section, 40000, 0.0, 0.5, 3);
  for (int k = 0; k < 5; ++k) places.push_back({0.6 + 0.02 * k, 30e-3, 0.0});  // lone points beyond the end
  auto cloud = cloud_of(Body::rail, section, places, Pose{});
  const double top = section.length() / 2;
  for (int k = 0; k < 7; ++k)
    cloud.push_back(point_of(Body::rail, section, {0.1 + 0.01 * k, top, k % 2 == 0 ? 9e-3 : -9e-3}));
  for (int k = 0; k < 11; ++k)
    cloud.emplace_back(0.2, section.y_max() + 5e-3 + 1e-3 * k, -section.at(section.length()).position.y());
  const Projection p = project(cloud, {}, Pose{}, section, {});
  EXPECT_EQ(p.far_off, 7u);
  EXPECT_EQ(p.beyond_section, 11u);
  EXPECT_GE(p.beyond_length, 5u);
  EXPECT_LE(p.beyond_length, 6u);
  EXPECT_NEAR(p.band.a_max, 0.5, 4e-3);
  EXPECT_EQ(p.points.size() + p.far_off + p.beyond_section + p.beyond_length, cloud.size());
}

TEST(BandPoints, AnArcOfAWheelIsOpenAlsoAcrossTheSeam) {
  const Section section = section_of(Body::wheel);
  for (const double from : {0.5, 2.5, -3.1}) {
    const auto places = random_places(section, 30000, from, from + 2.0, 4);
    const Projection p =
        project(cloud_of(Body::wheel, section, places, Pose{}), {}, Pose{}, section, {Body::wheel, kBandRadius});
    EXPECT_FALSE(p.band.closed);
    const double begin = p.band.a_min - kBandRadius * from;
    EXPECT_NEAR(begin - kTurn * std::round(begin / kTurn), 0.0, 2.1e-3) << from;
    EXPECT_NEAR(p.band.length(), 2.0 * kBandRadius, 4.2e-3) << from;
    EXPECT_EQ(p.points.size() + p.beyond_length, places.size());
    EXPECT_LT(p.beyond_length, 100u);
    expect_sorted(p);
    expect_places(p, Body::wheel, places);
  }
}

TEST(BandPoints, LinesThatAreFarApartCloseAWheel) {
  const Section section = section_of(Body::wheel);
  const int lines = static_cast<int>(std::lround(kTurn / 30e-3));
  std::vector<Known> places;
  for (int line = 0; line < lines; ++line)
    for (int k = 0; k < 100; ++k)
      places.push_back({2.0 * kPi * (line + 0.37) / lines - kPi, 3e-3 + (section.length() - 6e-3) * k / 99.0, 0.0});
  const auto closed =
      project(cloud_of(Body::wheel, section, places, Pose{}), {}, Pose{}, section, {Body::wheel, kBandRadius});
  EXPECT_TRUE(closed.band.closed);
  EXPECT_EQ(closed.points.size(), places.size());
  expect_places(closed, Body::wheel, places);
  // ten lines missing: an arc
  std::erase_if(places, [](const Known& k) { return std::fabs(k.u) < 0.15 / kBandRadius; });
  const auto arc =
      project(cloud_of(Body::wheel, section, places, Pose{}), {}, Pose{}, section, {Body::wheel, kBandRadius});
  EXPECT_FALSE(arc.band.closed);
  EXPECT_NEAR(arc.band.length(), kTurn - 0.3, 35e-3);
  EXPECT_EQ(arc.points.size(), places.size());
}

TEST(BandPoints, FewPointsAreRefused) {
  const Section section = section_of(Body::rail);
  const auto cloud = cloud_of(Body::rail, section, random_places(section, 999, 0.0, 0.5, 1), Pose{});
  try {
    project(cloud, {}, Pose{}, section, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    EXPECT_NE(error.message().find("999"), std::string::npos);
  }
  EXPECT_NO_THROW(project(cloud_of(Body::rail, section, random_places(section, 1000, 0.0, 0.5, 1), Pose{}), {}, Pose{},
                          section, {}));
}

TEST(BandPoints, TheSameForAnyNumberOfThreads) {
  const Section section = section_of(Body::wheel);
  const auto cloud = cloud_of(Body::wheel, section, random_places(section, 50000, -kPi, kPi, 9), Pose{});
  std::vector<Projection> results;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    results.push_back(project(cloud, {}, Pose{}, section, {Body::wheel, kBandRadius}));
  }
  EXPECT_EQ(results[0].points.index, results[1].points.index);
  EXPECT_EQ(results[0].points.a, results[1].points.a);
  EXPECT_EQ(results[0].points.d, results[1].points.d);
}

}  // namespace
}  // namespace treadmark::scans
