// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/measured/section.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "treadmark/measured/lumps.hpp"
#include "treadmark/measured/nominal.hpp"

namespace treadmark::measured {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Flange of 28 mm by arcs and straight lines, tread 1:20 with a cosine hollow in its middle, chamfer [m].
double wheel_height(double y, double hollow) {
  const double mm = 1e3 * y;
  if (mm > 55.0) return -1e-3 * (2.75 + (mm - 55.0));
  if (mm > -30.0) {
    const double worn =
        std::fabs(mm - 10.0) < 35.0 ? 0.5 * hollow * (1.0 + std::cos(std::numbers::pi * (mm - 10.0) / 35.0)) : 0.0;
    return -0.05e-3 * mm - worn;
  }
  // fillet, face and tip as a half wave between -30 and -56, then the round back
  if (mm > -56.0) return 1e-3 * (1.5 + 13.25 * (1.0 - std::cos(std::numbers::pi * (mm + 30.0) / 26.0)));
  return 1e-3 * (9.5 + std::sqrt(std::max(0.0, 1.0 - std::pow((mm + 56.0) / 14.0, 2))) * 18.5);
}

SectionPoints wheel(double hollow) {
  SectionPoints p;
  p.body = Body::wheel;
  for (double y = -0.070; y <= 0.060; y += 0.2e-3) p.y.push_back(y), p.z.push_back(wheel_height(y, hollow));
  // down the back
  std::reverse(p.y.begin(), p.y.end()), std::reverse(p.z.begin(), p.z.end());
  for (double z = 9.4e-3; z > 0.0; z -= 0.2e-3) p.y.push_back(-0.070), p.z.push_back(z);
  return p;
}

SectionPoints turned(SectionPoints p, double angle, bool mirror_y, bool mirror_z, double dy, double dz) {
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    const double y = p.y[i], z = p.z[i];
    p.y[i] = (mirror_y ? -1.0 : 1.0) * (std::cos(angle) * y - std::sin(angle) * z) + dy;
    p.z[i] = (mirror_z ? -1.0 : 1.0) * (std::sin(angle) * y + std::cos(angle) * z) + dz;
  }
  return p;
}

TEST(MeasuredSection, TheFlangePointsDownWhateverTheFileDoes) {
  for (const double hollow : {0.0, 2e-3, 4e-3, 6e-3})
    for (const double tilt : {-8.0, -3.0, 0.0, 3.0, 8.0})
      for (const bool mirror_y : {false, true})
        for (const bool mirror_z : {false, true}) {
          SectionPoints p = turned(wheel(hollow), tilt * kDegree, mirror_y, mirror_z, 0.0, 0.0);
          const Understanding u = understand(p, {});
          EXPECT_EQ(u.mirrored_z, mirror_z) << hollow << ' ' << tilt;
          EXPECT_EQ(u.mirrored_y, mirror_y) << hollow << ' ' << tilt;
          EXPECT_TRUE(u.z.marked && u.z.sure());
          ASSERT_TRUE(u.wheel.tip_y);
          EXPECT_LT(*u.wheel.tip_y, -0.04);
        }
}

TEST(MeasuredSection, TheTapeLineLies70MillimetresFromTheBack) {
  for (const double dy : {0.0, 0.070, -0.2})
    for (const double dz : {0.0, 0.46, -0.03}) {
      SectionPoints p = turned(wheel(1e-3), 0.0, false, false, dy, dz);
      const Understanding u = understand(p, {});
      ASSERT_TRUE(u.wheel.back_y && u.wheel.tape_z);
      EXPECT_NEAR(*u.wheel.back_y, -0.070, 1e-5);
      EXPECT_NEAR(u.shift_y, -dy, 1e-5);
      EXPECT_NEAR(*u.wheel.tape_z, dz == 0.0 && dy == 0.0 ? wheel_height(0.0, 1e-3) : 0.0, 2e-6);
      EXPECT_EQ(u.notes.empty(), dy == 0.0 && dz == 0.0);
      EXPECT_TRUE(u.doubts.empty());
    }
}

TEST(MeasuredSection, AsInTheFileNothingIsMovedAndPlacesAreDoubted) {
  SectionPoints p = turned(wheel(0.0), 0.0, true, false, 0.0, 0.02);
  const SectionPoints before = p;
  const Understanding u = understand(p, {Turn::decide, Turn::decide, false, false});
  EXPECT_EQ(p.y, before.y);
  EXPECT_EQ(p.z, before.z);
  ASSERT_FALSE(u.doubts.empty());
  EXPECT_EQ(u.doubts.front().name, "flange_side");
}

TEST(MeasuredSection, KeysGoBeforeWhatThePointsShowWithADoubt) {
  SectionPoints p = wheel(0.0);
  const Understanding u = understand(p, {Turn::no, Turn::yes, true, false});
  EXPECT_TRUE(u.mirrored_z);
  ASSERT_FALSE(u.doubts.empty());
  EXPECT_EQ(u.doubts.front().name, "upside_down");
}

TEST(MeasuredSection, NoisyTopsOfRailsKeepTheirSense) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 20e-6);
    SectionPoints p;
    for (double y = -20e-3; y <= 25e-3; y += 0.1e-3) {
      const double out = std::max(0.0, std::fabs(y) - 10e-3);
      p.y.push_back(y), p.z.push_back(y * y / 0.6 + out * out / 0.22 + noise(random));
    }
    SectionPoints up = p;
    for (double& z : up.z) z = -z;
    EXPECT_FALSE(understand(p, {}).mirrored_z) << seed;
    EXPECT_TRUE(understand(up, {}).mirrored_z) << seed;
  }
}

TEST(MeasuredSection, KeepsTheHeadOfAWholeOutline) {
  // head, web, foot and back, closed, from the middle of the foot round
  SectionPoints p;
  const double corners[][2]{{0, 160}, {75, 160}, {75, 150},  {8, 130},   {8, 50},   {36, 40},
                            {36, 14}, {26, 2},   {0, 0},     {-26, 2},   {-36, 14}, {-36, 40},
                            {-8, 50}, {-8, 130}, {-75, 150}, {-75, 160}, {0, 160}};
  for (std::size_t k = 1; k < std::size(corners); ++k)
    for (int i = 0; i < 20; ++i) {
      const double t = i / 20.0;
      p.y.push_back(1e-3 * (corners[k - 1][0] + t * (corners[k][0] - corners[k - 1][0])));
      p.z.push_back(1e-3 * (corners[k - 1][1] + t * (corners[k][1] - corners[k - 1][1])));
    }
  for (const double sign : {1.0, -1.0}) {
    SectionPoints q = p;
    for (double& z : q.z) z *= sign;
    const std::vector<std::size_t> kept = head_of_outline(q);
    ASSERT_FALSE(kept.empty());
    double low = 1.0, high = -1.0;
    for (const std::size_t i : kept) low = std::min(low, sign * q.z[i]), high = std::max(high, sign * q.z[i]);
    EXPECT_NEAR(low, 0.0, 1e-12);
    EXPECT_NEAR(high, 0.040, 3e-3);
  }
  EXPECT_TRUE(head_of_outline(wheel(0.0)).empty());
}

TEST(MeasuredSection, DirtStandsOutAndCornersDoNot) {
  SectionPoints clean = wheel(0.0);
  Profile p;
  p.body = Body::wheel;
  p.y = clean.y, p.z = clean.z;
  EXPECT_FALSE(highest_lump(p, 0.0));
  Profile coarse;  // points 1 mm apart
  coarse.body = Body::wheel;
  for (std::size_t i = 0; i < p.y.size(); ++i)
    if (coarse.y.empty() || std::hypot(p.y[i] - coarse.y.back(), p.z[i] - coarse.z.back()) > 0.999e-3)
      coarse.y.push_back(p.y[i]), coarse.z.push_back(p.z[i]);
  EXPECT_FALSE(highest_lump(coarse, 0.0));
  const std::size_t middle = coarse.y.size() / 2;
  coarse.z[middle] += 0.4e-3, coarse.z[middle - 1] += 0.25e-3, coarse.z[middle + 1] += 0.25e-3;
  EXPECT_TRUE(highest_lump(coarse, 1e-6));
  const std::size_t at = 250;
  p.z[at] += 0.4e-3, p.z[at - 1] += 0.25e-3, p.z[at + 1] += 0.25e-3;
  const std::optional<Lump> lump = highest_lump(p, 1e-6);
  ASSERT_TRUE(lump);
  EXPECT_LE(lump->first, at);
  EXPECT_GE(lump->last, at);
  EXPECT_NEAR(lump->height, 0.4e-3, 0.05e-3);
  EXPECT_FALSE(highest_lump(p, 60e-6));
}

TEST(MeasuredSection, RollAgainstANominalSectionIsFound) {
  const SectionPoints base = wheel(0.0);
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < base.y.size(); ++i) outline.emplace_back(base.y[i], base.z[i]);
  const std::vector<NominalOutline> nominals{nominal_outline("base", Body::wheel, outline)};
  for (const double degrees : {-9.0, -4.0, 0.0, 4.0, 9.0}) {
    const SectionPoints q = turned(wheel(0.0), degrees * kDegree, false, false, 0.0, 0.0);
    Profile p;
    p.body = Body::wheel;
    p.y = q.y, p.z = q.z;
    const std::optional<Lean> lean = lean_of(p, nominals);
    ASSERT_TRUE(lean);
    EXPECT_NEAR(lean->roll, degrees * kDegree, 2e-3) << degrees;
    EXPECT_EQ(std::fabs(degrees) > 3.5, lean->upright > 3.0 * lean->residual + 20e-6) << degrees;
  }
}

/// What lies between two places.
SectionPoints part_of(const SectionPoints& p, double low, double high) {
  SectionPoints out;
  out.body = p.body;
  for (std::size_t i = 0; i < p.y.size(); ++i)
    if (p.y[i] >= low && p.y[i] <= high) out.y.push_back(p.y[i]), out.z.push_back(p.z[i]);
  return out;
}

TEST(MeasuredSection, AFlangeIsAsWideAsTheRestOfASectionThatIsCut) {
  for (const double end : {0.005, 0.020, 0.045})
    for (const double hollow : {0.0, 4e-3})
      for (const double tilt : {-8.0, 0.0, 8.0})
        for (const bool mirror_z : {false, true}) {
          SectionPoints p = turned(part_of(wheel(hollow), -1.0, end), tilt * kDegree, false, mirror_z, 0.0, 0.0);
          const Understanding u = understand(p, {});
          EXPECT_EQ(u.mirrored_z, mirror_z) << end << ' ' << hollow << ' ' << tilt;
          ASSERT_TRUE(u.wheel.tip_y);
          EXPECT_LT(*u.wheel.tip_y, -0.04);
        }
}

TEST(MeasuredSection, TreadsAndTopsTellTheirSlope) {
  for (const double tilt : {-5.0, 0.0, 5.0}) {
    SectionPoints tread = turned(part_of(wheel(0.0), -25e-3, 50e-3), tilt * kDegree, false, false, 0.0, 0.0);
    const Understanding of_wheel = understand(tread, {Turn::no, Turn::no, true, false});
    ASSERT_TRUE(of_wheel.wheel.tread);
    EXPECT_NEAR(of_wheel.wheel.tread->slope, std::tan(tilt * kDegree - std::atan(0.05)), 2e-3);

    SectionPoints top;
    for (double y = -20e-3; y <= 20e-3; y += 0.2e-3) top.y.push_back(y), top.z.push_back(y * y / 0.6);
    top = turned(top, tilt * kDegree, false, false, 0.0, 0.0);
    const Understanding of_rail = understand(top, {});
    ASSERT_TRUE(of_rail.head);
    EXPECT_NEAR(of_rail.head->slope, std::tan(tilt * kDegree), 2e-3);
  }
}

TEST(MeasuredSection, TheHeadBesideAGrooveIsLaidUponANominalOneAlone) {
  const auto head = [](double y) { return y * y / 0.6 + 400.0 * std::pow(std::max(0.0, std::fabs(y) - 20e-3), 2); };
  std::vector<Vec2> outline;
  for (double y = -30e-3; y <= 30e-3; y += 0.25e-3) outline.emplace_back(y, head(y));
  const std::vector<NominalOutline> nominals{nominal_outline("head", Body::rail, outline)};
  for (const double degrees : {-6.0, -4.0, 4.0}) {
    SectionPoints p;
    for (double y = -26e-3; y <= 75e-3; y += 0.2e-3) {
      const double keeper = y > 60e-3 ? 7e-3 : 1.0;
      p.y.push_back(y), p.z.push_back(std::min({std::max(0.0, head(y)), 40e-3, keeper}));
    }
    p = turned(p, degrees * kDegree, false, false, 0.0, 0.0);
    Profile profile;
    profile.body = Body::rail;
    profile.y = p.y, profile.z = p.z;
    const std::optional<Lean> lean = lean_of(profile, nominals);
    ASSERT_TRUE(lean);
    EXPECT_NEAR(lean->roll, degrees * kDegree, 2e-3);
    EXPECT_LT(lean->residual, 20e-6);
  }
}

}  // namespace
}  // namespace treadmark::measured
