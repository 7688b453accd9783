// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/analysis/measures/rail.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::measures {
namespace {

constexpr double kMilli = 1e-3, kSquareMm = 1e-6;

Profile outline_of(const std::string& name) {
  Profile p;
  p.body = Body::rail;
  p.name = name;
  for (const Vec2& q : library_outline(name, 0.1e-3)) {
    p.y.push_back(q.x());
    p.z.push_back(q.y());
  }
  return p;
}

Profile milled(Profile p, double depth) {
  for (double& z : p.z) z = std::max(z, depth);
  return p;
}

Profile moved(Profile p, double turn, double dy, double dz) {
  const double c = std::cos(turn), s = std::sin(turn);
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    const double y = p.y[i], z = p.z[i];
    p.y[i] = c * y - s * z + dy;
    p.z[i] = s * y + c * z + dz;
  }
  return p;
}

RailGauge as_it_lies() {
  RailGauge gauge;
  gauge.alignment = RailAlignment::none;
  return gauge;
}

TEST(RailMeasures, NewRailsHaveNoWear) {
  // Head widths and their depths from EN 13674: 60E1 72.00 mm at 14.3 mm, 54E1 70.00 at 14.1, 49E1 67.00 at 14.0.
  const struct {
    const char* name;
    double width, depth, radius;
  } rails[] = {{"60E1", 72.0, 14.3, 300.0}, {"54E1", 70.0, 14.1, 300.0}, {"49E1", 67.0, 14.0, 300.0}};
  for (const auto& rail : rails) {
    const Section section(outline_of(rail.name), 0.0);
    RailGauge gauge;
    gauge.side_depth = rail.depth * kMilli;
    gauge.crown_half = 8e-3;
    const RailMeasures m = measure_rail(section, &section, gauge);
    for (const Measure* number : {&m.w1, &m.w2, &m.w3, &m.inclination})
      EXPECT_NEAR(number->value, 0.0, 1e-8) << rail.name;
    EXPECT_NEAR(m.loss.value, 0.0, 0.01 * kSquareMm);
    EXPECT_NEAR(m.lip.value, 0.0, 0.01 * kSquareMm);
    EXPECT_NEAR(m.head_width.value, rail.width * kMilli, 0.01 * kMilli) << rail.name;
    EXPECT_NEAR(m.crown_radius.value, rail.radius * kMilli, 0.5 * kMilli) << rail.name;
  }
}

TEST(RailMeasures, AMilledCrown) {
  // Level, 3.000 mm below the top: segments of circles by hand.
  const struct {
    const char* name;
    double loss;
  } rails[] = {{"60E1", 125.92}, {"54E1", 124.77}, {"49E1", 116.77}};
  for (const auto& rail : rails) {
    const Section nominal(outline_of(rail.name), 0.0), worn(milled(outline_of(rail.name), 3e-3), 0.0);
    for (const RailAlignment alignment : {RailAlignment::unworn, RailAlignment::none}) {
      RailGauge gauge;
      gauge.alignment = alignment;
      const RailMeasures m = measure_rail(worn, &nominal, gauge);
      EXPECT_NEAR(m.w1.value, 3e-3, 1e-7);
      EXPECT_NEAR(m.w2.value, 0.0, 1e-7);
      EXPECT_NEAR(m.w3.value, 0.0, 1e-7);
      EXPECT_NEAR(m.equivalent.value, 3e-3, 2e-7);
      EXPECT_NEAR(m.loss.value, rail.loss * kSquareMm, 0.03 * kSquareMm) << rail.name;
    }
  }
}

TEST(RailMeasures, AreaOfAShiftedSection) {
  // Heads widen downwards, so a section that lies d deeper is inside the nominal one, and what is missing is the
  // nominal one's lowest strip of height d.
  const Section nominal(outline_of("60E1"), 0.0);
  const double low = analytic::rail_60e1_chain().start_z / kMilli;
  for (const double d : {0.5, 2.0, 4.0}) {
    const Section worn(moved(outline_of("60E1"), 0.0, 0.0, d * kMilli), 0.0);
    const RailMeasures m = measure_rail(worn, &nominal, as_it_lies());
    const double half = 35.999811 + (low - 0.5 * d - 14.299958) / 20.0;
    EXPECT_NEAR(m.loss.value, 2.0 * half * d * kSquareMm, 0.002 * 2.0 * half * d * kSquareMm + 0.1 * kSquareMm);
    EXPECT_NEAR(m.loss.value, m.loss_top.value + m.loss_side.value, 1e-12);
    EXPECT_NEAR(m.w1.value, d * kMilli, 1e-8);
    EXPECT_NEAR(m.w3.value, d * kMilli * std::numbers::sqrt2 / 2.0, 0.25 * d * kMilli);
  }
  // to the field side: side wear, and as much metal outside on the other side
  const Section aside(moved(outline_of("60E1"), 0.0, 1e-3, 0.0), 0.0);
  const RailMeasures m = measure_rail(aside, &nominal, as_it_lies());
  EXPECT_NEAR(m.w2.value, 1e-3, 1e-7);
  EXPECT_NEAR(m.loss.value, m.lip.value, 0.02 * m.loss.value);
}

TEST(RailMeasures, UnwornPartsTellPlaceAndInclination) {
  const Section nominal(outline_of("60E1"), 0.0);
  const double turn = std::atan(1.0 / 40.0);
  // worn 4 mm on the gauge side and 2 mm on top, inclined 1:40 towards the gauge side, somewhere
  Profile worn = milled(outline_of("60E1"), 2e-3);
  for (std::size_t i = 0; i < worn.y.size(); ++i)
    if (worn.z[i] < 36e-3) worn.y[i] = std::max(worn.y[i], -32e-3);
  const Section measured(moved(worn, -turn, 5e-3, -3e-3), 0.0);
  const RailMeasures m = measure_rail(measured, &nominal);
  EXPECT_NEAR(m.inclination.value, turn, 1e-6);
  EXPECT_NEAR(m.w1.value, 2e-3, 1e-6);
  EXPECT_NEAR(m.w2.value, (35.99 - 32.0) * kMilli, 0.02 * kMilli);
  EXPECT_NEAR(m.face_angle.value, 0.5 * std::numbers::pi, 1e-3);
}

TEST(RailMeasures, ErrorsLieInsideTheStatedUncertainty) {
  const Section nominal(outline_of("60E1"), 0.0);
  int w1 = 0, w2 = 0, inclined = 0;
  constexpr int kSeeds = 40;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 draw(static_cast<unsigned>(seed));
    std::normal_distribution<double> noise(0.0, 0.02e-3);
    Profile p = milled(outline_of("60E1"), 2e-3), thin = p;
    thin.y.clear(), thin.z.clear();
    for (std::size_t i = 0; i < p.y.size(); i += 3) {
      thin.y.push_back(p.y[i] + noise(draw));
      thin.z.push_back(p.z[i] + noise(draw));
    }
    const RailMeasures m = measure_rail(Section(moved(thin, -0.02, 1e-3, 1e-3)), &nominal);
    w1 += std::fabs(m.w1.value - 2e-3) <= m.w1.uncertainty ? 1 : 0;
    w2 += std::fabs(m.w2.value) <= m.w2.uncertainty ? 1 : 0;
    inclined += std::fabs(m.inclination.value - 0.02) <= m.inclination.uncertainty ? 1 : 0;
    EXPECT_LT(m.w1.uncertainty, 0.06e-3);  // what other assumptions make of the points included
  }
  EXPECT_GE(w1, 34);
  EXPECT_GE(w2, 34);
  EXPECT_GE(inclined, 34);
}

std::vector<std::string> words_of(const RailMeasures& m) {
  std::vector<std::string> out;
  for (const measured::Doubt& doubt : m.doubts) {
    EXPECT_EQ(doubt.name, "nominal_profile");
    out.push_back(doubt.text);
  }
  return out;
}

TEST(RailMeasures, TheNominalSectionOfAnotherRailIsDoubted) {
  for (const auto& [own, nominal] : {std::pair{"54E1", "60E1"}, {"60E1", "54E1"}, {"49E1", "54E1"}}) {
    const Section wanted(outline_of(nominal), 0.0);
    const RailMeasures m = measure_rail(Section(outline_of(own), 0.0), &wanted);
    EXPECT_THAT(words_of(m), ::testing::Contains(::testing::HasSubstr("what does not wear"))) << own << nominal;
    // a misfit that is alike over some millimetres is no scatter, of which the mean of hundreds of places is known well
    EXPECT_GT(m.w1.uncertainty, 0.3 * m.residual) << own << nominal;
  }
}

TEST(RailMeasures, TheirOwnNominalSectionsAreNotDoubted) {
  int measured = 0;
  for (const LibraryProfile& row : profile_library()) {
    if (row.family || row.body != Body::rail || !(row.area > 0.0)) continue;
    const Section section(outline_of(row.name), 0.0);
    for (const RailAlignment alignment : {RailAlignment::unworn, RailAlignment::top, RailAlignment::none}) {
      RailGauge gauge;
      gauge.alignment = alignment;
      try {
        EXPECT_THAT(words_of(measure_rail(section, &section, gauge)), ::testing::IsEmpty()) << row.name;
        ++measured;
      } catch (const Error&) {
        // shapes that are told from no others by their sides
      }
    }
  }
  EXPECT_GT(measured, 39);
  // worn on top and side, inclined, and with a lip of 1.5 mm
  const Section nominal(outline_of("60E1"), 0.0);
  Profile worn = milled(outline_of("60E1"), 4e-3);
  for (std::size_t i = 0; i < worn.y.size(); ++i)
    if (worn.y[i] < -20e-3 && worn.z[i] < 30e-3) worn.y[i] = std::max(worn.y[i], -32e-3);
  EXPECT_THAT(words_of(measure_rail(Section(moved(worn, -0.025, 2e-3, 1e-3), 0.0), &nominal)), ::testing::IsEmpty());
  EXPECT_THAT(words_of(measure_rail(Section(worn, 0.0), &nominal, as_it_lies())), ::testing::IsEmpty());
  Profile lip = outline_of("60E1");
  for (std::size_t i = 0; i < lip.y.size(); ++i)
    if (lip.y[i] < -20e-3 && std::fabs(lip.z[i] - 13e-3) < 3e-3) lip.y[i] -= 1.5e-3;
  EXPECT_THAT(words_of(measure_rail(Section(lip, 0.0), &nominal)), ::testing::IsEmpty());
}

TEST(RailMeasures, MetalThatHasGrownIsDoubted) {
  const Section nominal(outline_of("60E1"), 0.0);
  for (const double grown : {0.4e-3, 1e-3}) {
    Profile raised = outline_of("60E1");
    for (double& z : raised.z)
      if (z < 6e-3) z -= grown;
    for (const RailAlignment alignment : {RailAlignment::unworn, RailAlignment::none}) {
      RailGauge gauge;
      gauge.alignment = alignment;
      const RailMeasures m = measure_rail(Section(raised, 0.0), &nominal, gauge);
      EXPECT_NEAR(m.w1.value, -grown, 1e-6);
      const auto words = words_of(m);
      if (grown < 0.5e-3)
        EXPECT_THAT(words, ::testing::IsEmpty());
      else
        EXPECT_THAT(words, ::testing::Contains(::testing::HasSubstr("W1 is -1.00 mm: metal would have grown")));
    }
  }
}

TEST(RailMeasures, ASectionThatDoesNotLieInTheNominalOnesAxesIsDoubted) {
  const Section nominal(outline_of("60E1"), 0.0);
  for (const double aside : {2e-3, -30e-3}) {
    const Section section(moved(outline_of("60E1"), 0.0, aside, 0.0), 0.0);
    EXPECT_THAT(words_of(measure_rail(section, &nominal, as_it_lies())),
                ::testing::Contains(::testing::HasSubstr("as the section lies")));
    EXPECT_THAT(words_of(measure_rail(section, &nominal)), ::testing::IsEmpty());
  }
}

TEST(RailMeasures, ErrorsThatAreNotKnownAreUnknown) {
  const Section nominal(outline_of("60E1"), 0.0);
  Section section(milled(outline_of("60E1"), 1e-3), 0.0);
  const RailMeasures exact = measure_rail(section, &nominal);
  section.claim_error(kUnknown);
  const RailMeasures m = measure_rail(section, &nominal);
  for (const Measure RailMeasures::*of :
       {&RailMeasures::w1, &RailMeasures::w2, &RailMeasures::w3, &RailMeasures::equivalent, &RailMeasures::loss,
        &RailMeasures::face_angle, &RailMeasures::head_width, &RailMeasures::inclination}) {
    EXPECT_EQ((m.*of).value, (exact.*of).value);
    EXPECT_TRUE(std::isnan((m.*of).uncertainty));
  }
  // a bow of 10 um over the crown changes its radius by R^2 2 d/a^2 = 18 mm
  Section crown(outline_of("60E1"), 0.0);
  crown.claim_error(10e-6);
  const Measure radius = measure_rail(crown, &nominal).crown_radius;
  EXPECT_GT(radius.uncertainty, 18e-3);
  EXPECT_LT(radius.uncertainty, 100e-3);
  crown.claim_error(kUnknown);
  EXPECT_TRUE(std::isnan(measure_rail(crown, &nominal).crown_radius.uncertainty));
}

void expect_no_rail(const Profile& profile, const Section* nominal, const char* words) {
  try {
    measure_rail(Section(profile, 0.0), nominal);
    ADD_FAILURE() << "measured";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(words));
  }
}

TEST(RailMeasures, WhatIsNoRailIsRefusedByName) {
  Profile wheel = analytic::sample_profile(StandardProfile{"S1002"}, 0.1e-3);
  wheel.body = Body::rail;
  expect_no_rail(wheel, nullptr, "does not look like a rail");
  for (double& z : wheel.z) z = -z;
  expect_no_rail(wheel, nullptr, "does not look like a rail");
  // a crown alone has nothing that does not wear
  const Section nominal(outline_of("60E1"), 0.0);
  Profile crown = analytic::sample_profile(StandardProfile{"60E1"}, 0.1e-3);
  Profile top = crown;
  top.y.clear(), top.z.clear();
  for (std::size_t i = 0; i < crown.y.size(); ++i)
    if (crown.z[i] < 12e-3) top.y.push_back(crown.y[i]), top.z.push_back(crown.z[i]);
  expect_no_rail(top, &nominal, "too little of the rail that does not wear");
}

}  // namespace
}  // namespace treadmark::measures
