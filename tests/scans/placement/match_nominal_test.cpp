// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/match_nominal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

std::vector<Vec2> between(std::vector<Vec2> points, double y_min, double y_max) {
  std::erase_if(points, [&](const Vec2& p) { return p.x() < y_min || p.x() > y_max; });
  return points;
}

/// The section of which the match leads back to these points of the nominal one.
Section measured_as(const SectionMatch& match, const std::vector<Vec2>& nominal) {
  std::vector<Vec2> out;
  const double c = std::cos(match.roll), s = std::sin(match.roll);
  for (const Vec2& p : nominal) {
    const Vec2 q = p - match.shift;
    // a positive roll lowered +y: undone by raising it
    const Vec2 r(c * q.x() - s * q.y(), s * q.x() + c * q.y());
    out.emplace_back(match.turned ? -r.x() : r.x(), r.y());
  }
  if (match.turned) std::reverse(out.begin(), out.end());
  return Section(out);
}

void expect_match(const SectionMatch& found, const SectionMatch& truth, double shift, double roll) {
  EXPECT_EQ(found.turned, truth.turned);
  EXPECT_NEAR(found.roll, truth.roll, roll);
  EXPECT_NEAR(found.shift.x(), truth.shift.x(), shift);
  EXPECT_NEAR(found.shift.y(), truth.shift.y(), shift);
}

SectionMatch truth(bool turned, double roll, const Vec2& shift) {
  SectionMatch out;
  out.turned = turned;
  out.roll = roll;
  out.shift = shift;
  return out;
}

TEST(MatchNominal, FindsShiftAndWayOfAWheel) {
  const auto nominal = tests::nominal_points("S1002", Body::wheel);
  for (const bool turned : {false, true})
    for (const Vec2& shift : {Vec2(0.0, -0.46), Vec2(23e-3, -0.31), Vec2(-41e-3, -0.6)}) {
      const SectionMatch expected = truth(turned, 0.0, shift);
      const SectionMatch found =
          match_nominal(measured_as(expected, between(nominal, -62e-3, 55e-3)), Section(nominal), Body::wheel, false);
      expect_match(found, expected, 2e-6, 0.0);
      EXPECT_LT(found.residual, 3e-6);
      EXPECT_GT(found.agreeing, 0.9);
      EXPECT_LT(found.beside, 0.02);
      EXPECT_GT(found.overlap, 0.95);
    }
}

/// Sections with deviations some centimetres long, of which each pulls: where matches lie scatters as they say.
TEST(MatchNominal, KnowsHowWellItLies) {
  constexpr int kSections = 24;
  constexpr double kOff = 40e-6;
  for (const Body body : {Body::wheel, Body::rail}) {
    const auto nominal = body == Body::wheel ? between(tests::nominal_points("S1002", Body::wheel), -62e-3, 55e-3)
                                             : between(tests::nominal_points("60E1", Body::rail), -33e-3, 33e-3);
    const Section right(nominal);
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    double stated = 0.0, true_square = 0.0;
    for (int k = 0; k < kSections; ++k) {
      std::array<double, 12> at{};
      for (double& value : at) value = kOff * normal(random);
      std::vector<Vec2> points;
      for (double s = 0.0; s <= right.length(); s += 0.5e-3) {
        // smoothly from one value to the next
        const double x = s / right.length() * 11.0;
        const auto cell = std::min<std::size_t>(10, to_whole<std::size_t>(std::floor(x)));
        const double t = x - static_cast<double>(cell), share = t * t * (3.0 - 2.0 * t);
        const Section::Point p = right.at(s);
        points.push_back(p.position + ((1.0 - share) * at[cell] + share * at[cell + 1]) * p.normal);
      }
      const Section measured(points);
      const SectionMatch match = match_nominal(measured, right, body, true);
      stated += match_covariance(measured, right, body, match)(0, 0);
      true_square += match.shift.x() * match.shift.x();
    }
    EXPECT_GT(std::sqrt(stated / true_square), 0.5) << body_name(body);
    EXPECT_LT(std::sqrt(stated / true_square), 2.0) << body_name(body);
    EXPECT_LT(std::sqrt(match_covariance(right, right, body, match_nominal(right, right, body, true))(0, 0)), 2e-6);
  }
}

TEST(MatchNominal, FindsShiftRollAndWayOfARail) {
  const auto nominal = between(tests::nominal_points("60E1", Body::rail), -33e-3, 33e-3);
  // without its left corner: a symmetric section has no way
  const auto part = between(nominal, -18e-3, 32e-3);
  for (const double roll : {0.0, 0.025, -0.2, 0.6}) {
    const SectionMatch expected = truth(false, roll, {12e-3, -0.2});
    const SectionMatch found = match_nominal(measured_as(expected, part), Section(nominal), Body::rail, true);
    expect_match(found, expected, 20e-6, 2e-4);
    EXPECT_LT(found.residual, 3e-6);
    // points are taken where they belong
    const Section measured = measured_as(expected, part);
    const Vec2 somewhere = measured.at(0.5 * measured.length()).position;
    EXPECT_NEAR(to_nominal(found, somewhere).y(), Section(nominal).v_at(to_nominal(found, somewhere).x()), 3e-6);
  }
}

TEST(MatchNominal, KeepsTheWayOfSymmetricSectionsOrAsTold) {
  const auto rail = between(tests::nominal_points("60E1", Body::rail), -33e-3, 33e-3);
  EXPECT_FALSE(match_nominal(Section(rail), Section(rail), Body::rail, false).turned);
  // told the wrong way it is not turned, and then fits nowhere
  const auto wheel = tests::nominal_points("S1002", Body::wheel);
  const Section other = measured_as(truth(true, 0.0, {0.0, -0.46}), between(wheel, -62e-3, 55e-3));
  EXPECT_TRUE(match_nominal(other, Section(wheel), Body::wheel, false).turned);
  const auto refused = tests::error_of([&] { match_nominal(other, Section(wheel), Body::wheel, true); });
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->kind(), ErrorKind::input_data);
  EXPECT_THAT(refused->message(), ::testing::HasSubstr("does not look like the nominal profile"));
}

TEST(MatchNominal, OnlyWhatIsNotWornCounts) {
  auto nominal = tests::nominal_points("S1002", Body::wheel);
  const SectionMatch expected = truth(false, 0.0, {5e-3, -0.45});
  // a tread hollow by 2 mm from -20 to 20 mm: a third of the section
  auto worn = between(nominal, -62e-3, 55e-3);
  for (Vec2& p : worn)
    if (std::fabs(p.x()) < 20e-3) p.y() -= 2e-3 * std::pow(std::cos(0.5 * tests::kPi * p.x() / 20e-3), 2);
  const SectionMatch found = match_nominal(measured_as(expected, worn), Section(nominal), Body::wheel, false);
  expect_match(found, expected, 10e-6, 0.0);
  EXPECT_GT(found.agreeing, 0.6);
  EXPECT_LT(found.agreeing, 0.85);
  EXPECT_LT(found.beside, 0.02);
}

TEST(MatchNominal, OfAPartOnly) {
  const auto nominal = tests::nominal_points("S1002", Body::wheel);
  const SectionMatch expected = truth(false, 0.0, {-7e-3, -0.45});
  const SectionMatch found =
      match_nominal(measured_as(expected, between(nominal, -55e-3, 15e-3)), Section(nominal), Body::wheel, false);
  expect_match(found, expected, 3e-6, 0.0);
  EXPECT_NEAR(found.overlap, 1.0, 0.02);
}

TEST(MatchNominal, RefusesOtherProfiles) {
  const Section wheel(tests::nominal_points("S1002", Body::wheel)),
      rail(between(tests::nominal_points("60E1", Body::rail), -33e-3, 33e-3));
  std::vector<Vec2> round, deep;
  for (int k = -80; k <= 80; ++k) {
    round.emplace_back(60e-3 * std::sin(k / 60.0), 0.4 + 60e-3 * std::cos(k / 60.0));  // a pipe
    deep.emplace_back(1e-3 * k, 0.4 + 25e-3 * std::sin(2.0 * tests::kPi * k / 40.0));  // corrugated sheet
  }
  for (const Section& other : {Section(round), Section(deep)})
    for (const auto& [nominal, body] : {std::pair{&wheel, Body::wheel}, std::pair{&rail, Body::rail}}) {
      const auto error = tests::error_of([&] { match_nominal(other, *nominal, body, false); });
      ASSERT_TRUE(error);
      EXPECT_EQ(error->kind(), ErrorKind::input_data);
      EXPECT_FALSE(error->advice().empty());
    }
  EXPECT_TRUE(tests::error_of([&] { match_nominal(wheel, rail, Body::rail, false); }));
}

}  // namespace
}  // namespace treadmark::scans
