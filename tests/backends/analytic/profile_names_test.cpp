// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/rail_sections.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/analytic/wheel_sections.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::analytic {
namespace {

constexpr double kMilli = 1e-3;
constexpr double kSummed = 5e-8;  // [m] what five decimals of mm in all ends before add up to

TEST(ProfileLibrary, AreasAndMassesOfRails) {
  // Published values of EN 13674 for the common ones, [cm2] and [kg/m].
  const struct {
    const char* name;
    double area, mass;
  } published[] = {{"60E1", 76.70, 60.21}, {"60E2", 76.48, 60.03}, {"54E1", 69.77, 54.77}, {"49E1", 62.92, 49.39}};
  int found = 0;
  for (const RailSection& s : rail_sections()) {
    const double area = outline_area(s);
    EXPECT_NEAR(area, s.area, 0.006e-4) << s.name;
    EXPECT_NEAR(7850.0 * area, s.mass, 0.006) << s.name;
    for (const auto& p : published)
      if (s.name == p.name) {
        EXPECT_NEAR(area, p.area * 1e-4, 0.006e-4);
        EXPECT_NEAR(7850.0 * area, p.mass, 0.006);
        ++found;
      }
    // the polygon of the whole outline has the area less what lies between chords and arcs
    const std::vector<Vec2> points = outline_points(s, 0.05e-3);
    double twice = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
      twice += a.x() * b.y() - b.x() * a.y();
    }
    EXPECT_NEAR(0.5 * twice, area, 1e-8) << s.name;
  }
  EXPECT_EQ(found, 4);
  EXPECT_EQ(rail_sections().size(), 39U);
}

TEST(ProfileLibrary, HeadsAreTheOutlinesDownToTheFillets) {
  for (const RailSection& s : rail_sections()) {
    const ArcChain chain = head_chain(s);
    const auto resolved = resolve(chain);
    // through the crown at the origin, level there, and symmetric
    const ChainSegment& crown = resolved[resolved.size() / 2];
    const ChainPoint top = point_on(crown, 0.5 * crown.length);
    EXPECT_NEAR(top.y, 0.0, 1e-12) << s.name;
    EXPECT_NEAR(top.z, 0.0, 1e-12) << s.name;
    EXPECT_NEAR(top.angle, 0.0, 1e-12) << s.name;
    // every printed end of an arc lies on the chain
    std::size_t i = resolved.size() / 2;
    for (const OutlineElement& e : s.half_outline) {
      const ChainPoint end = point_on(resolved[i], resolved[i].length);
      EXPECT_NEAR(end.y, e.y * kMilli, kSummed) << s.name;
      EXPECT_NEAR(end.z, e.z * kMilli, kSummed) << s.name;
      ++i;
      if (e.radius == 0.0) break;
    }
    EXPECT_EQ(i, resolved.size()) << s.name;
  }
}

TEST(ProfileLibrary, The60E1OfTheTableIsThatOfTheFormula) {
  const ArcChain formula = rail_60e1_chain();
  for (const RailSection& s : rail_sections()) {
    if (s.name != "60E1") continue;
    const ArcChain table = head_chain(s);
    EXPECT_NEAR(table.start_y, formula.start_y, 2e-8);
    EXPECT_NEAR(table.start_z, formula.start_z, 2e-8);
    ASSERT_EQ(table.segments.size(), formula.segments.size());
    for (std::size_t i = 0; i < table.segments.size(); ++i)
      EXPECT_NEAR(table.segments[i].length, formula.segments[i].length, 5e-8);
  }
}

TEST(ProfileLibrary, WheelsAreTangent) {
  for (const auto tread : {WheelSection::Tread::s1002, WheelSection::Tread::cone_40, WheelSection::Tread::eps})
    for (const double h : {28.0, 28.7, 29.0, 30.0, 31.3, 32.0})
      for (const double e : {28.5, 30.5, 32.5}) {
        const GraphCurve curve = wheel_curve({tread, h, e, 0.0});
        EXPECT_DOUBLE_EQ(curve.y_min(), -0.070);
        EXPECT_DOUBLE_EQ(curve.y_max(), 0.060);
        for (int i = 0; i + 1 < curve.piece_count(); ++i) {
          const double y = curve.piece_end(i);
          ASSERT_NEAR(y, curve.piece_start(i + 1), 1e-15);
          const Jet left = curve.jet(y, i), right = curve.jet(y, i + 1);
          // 1 um where a standard prints points only (EPS); else the polynomials' own rounding
          EXPECT_NEAR(left.h, right.h, tread == WheelSection::Tread::eps ? 1.2e-6 : 1.3e-7)
              << h << ' ' << e << ' ' << y;
          // from the flange tip to the end of the face: between the printed heights too
          if (y > -54e-3 && y < -36e-3 - (32.5 - e) * kMilli) {
            EXPECT_NEAR(std::atan(left.dh), std::atan(right.dh), 1e-7) << h << ' ' << e << ' ' << y;
          }
        }
      }
}

TEST(ProfileLibrary, PrintedPointsOfTheFlanges) {
  // F1 and G1 of EN 13715 for h = 28, 30, 32, e = 32.5, to 0.001 mm
  const struct {
    double h, f1_y, f1_z, g1_y, g1_z;
  } printed[] = {{28, -39.765, 15.675, -49.663, 26.748},
                 {30, -40.530, 17.779, -47.758, 27.568},
                 {32, -41.497, 20.434, -46.153, 28.108}};
  for (const auto& p : printed) {
    const GraphCurve curve = wheel_curve({WheelSection::Tread::s1002, p.h, 32.5, 0.0});
    for (const auto& [y, z] : {std::pair{p.f1_y, p.f1_z}, {p.g1_y, p.g1_z}}) {
      const Jet at = curve.jet(y * kMilli, curve.find(y * kMilli, 0));
      EXPECT_NEAR(at.h, z * kMilli, (p.h == 32 ? 8e-6 : 2e-6) * (1.0 + std::fabs(at.dh)) * 0.5) << p.h;
    }
  }
}

TEST(ProfileLibrary, S1002ByItsPartsIsS1002) {
  const GraphCurve whole = s1002_curve(), parts = wheel_curve({});
  for (double y = -0.0699; y < 0.06; y += 0.0001)
    EXPECT_NEAR(whole.height(y, whole.find(y, 0)), parts.height(y, parts.find(y, 0)), 2e-8) << y;
}

TEST(ProfileLibrary, NamesAreTakenAsTheyAreWritten) {
  for (const char* name : {"60E1", "60e1", "60 E 1", "UIC 60", "uic60", "54E1", "UIC 54", "S49", "DIN S49", "U 50",
                           "UIC519-rail-A", "circle R300", "BS 113lb BR Variant"})
    EXPECT_EQ(library_body(name), Body::rail) << name;
  for (const char* name : {"S1002", "s1002/h30/e31/10%", "S1002 / h28 / e32.5 / 6.7 %", "1:40", "1/40/e30", "EPS",
                           "EN 13715 - S1002 / h28 / e32.5 / 6.7 %", "cone 1:20", "hollow R330"})
    EXPECT_EQ(library_body(name), Body::wheel) << name;
  for (const char* name : {"", "S1003", "S1002/x", "S1002/h", "60", "circle", "circle R", "cone 1:", "60E1/h28"})
    EXPECT_FALSE(library_body(name)) << name;
  for (const char* name : {"S1002/h27", "S1002/e33", "S1002/e30.2", "S1002/20%", "cone 1:0", "hollow R10"})
    EXPECT_THROW(library_body(name), Error) << name;
  try {
    standard_curve("S1003");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("treadmark list profiles"));
  }
}

TEST(ProfileLibrary, SignsOfNumbersAreMeantOrRefused) {
  for (const char* name : {"cone -1:20", "cone 1:-20", "CONE_-1:20", "Cone  1 : -20"}) {
    const auto cone = std::get<GraphCurve>(standard_curve(name));
    EXPECT_NEAR(cone.height(0.02, 0), 1e-3, 1e-15) << name;
  }
  for (const char* name : {"cone-1:20", "cone - 1:20", "cone -1:-20", "cone -1:0.5", "circle R-300", "circle-R-300",
                           "hollow R-330", "S1002/h30/e31/-10%", "S1002/h-30", "S1002/e-31", "1:40/e-30"})
    EXPECT_THROW(library_body(name), Error) << name;
  for (const char* name : {"1:-40", "-1:40", "1/-40", "-1/40", "circle -R300", "hollow -R330", "-S1002", "-60E1",
                           "S1002/-h30", "cone 1:--20", "cone --1:20", "cone 1:20-", "S1002/h30-e31", "circle R+300"})
    EXPECT_FALSE(library_body(name)) << name;
  // hyphens that join
  for (const char* name : {"UIC-60", "60-E1", "S-49", "54E1-AHC", "50EB-T", "circle-R300"})
    EXPECT_EQ(library_body(name), Body::rail) << name;
  for (const char* name : {"EN-13715-S1002/h30", "S-1002", "EN 13715 - EPS", "EN 13715 - 1:40/h30", "hollow-R330"})
    EXPECT_EQ(library_body(name), Body::wheel) << name;
}

TEST(ProfileLibrary, EveryRowCanBeUsed) {
  for (const LibraryProfile& row : profile_library()) {
    ASSERT_EQ(library_body(row.name), row.body) << row.name;
    EXPECT_NE(make_standard_surface({row.name}, row.body, 0.46), nullptr) << row.name;
    EXPECT_GT(library_outline(row.name, 1e-3).size(), 8U) << row.name;
  }
  // cones and circles are what they say
  const auto cone = std::get<GraphCurve>(standard_curve("cone 1:20"));
  EXPECT_NEAR(cone.height(0.02, 0), -1e-3, 1e-15);
  const auto hollow = std::get<GraphCurve>(standard_curve("hollow R330"));
  EXPECT_NEAR(hollow.height(0.02, 0), 0.330 - std::sqrt(0.330 * 0.330 - 0.02 * 0.02), 1e-15);
  EXPECT_THAT(thinner_flanges("S1002/h30/e29.5"),
              ::testing::ElementsAre("S1002/h30/e29.5", "S1002/h30/e29", "S1002/h30/e28.5"));
}

}  // namespace
}  // namespace treadmark::analytic
