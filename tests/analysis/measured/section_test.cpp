// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/section.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "treadmark/analysis/measured/lumps.hpp"
#include "treadmark/analysis/measured/nominal.hpp"

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
    const RailOutline outline = outline_of_rail(q);
    ASSERT_FALSE(outline.head.empty());
    double low = 1.0, high = -1.0;
    for (const std::size_t i : outline.head) low = std::min(low, sign * q.z[i]), high = std::max(high, sign * q.z[i]);
    EXPECT_NEAR(low, 0.0, 1e-12);
    EXPECT_NEAR(high, 0.040, 3e-3);
    // all of it from the middle of the foot
    ASSERT_EQ(outline.whole.size(), q.y.size());
    EXPECT_NEAR(q.y[outline.whole.front()], 0.0, 4e-3);
    EXPECT_NEAR(sign * q.z[outline.whole.front()], 0.160, 1e-12);
  }
  EXPECT_TRUE(outline_of_rail(wheel(0.0)).head.empty());
  for (std::size_t i = 0; i < p.y.size(); ++i) p.y[i] *= 1e3, p.z[i] *= 1e3;  // um that were read as mm
  EXPECT_TRUE(outline_of_rail(p).head.empty());
}

TEST(MeasuredSection, TheStraightPartOfABackIsFoundBesideABurrAndALeaningOneLeans) {
  constexpr double kTip = 28e-3, kFillet = 18.5e-3;
  for (const double lean : {-0.04, 0.0, 0.04})
    for (const double burr : {0.0, 0.4e-3, 2e-3})
      for (const double at : {12e-3, 2e-3, -20e-3}) {
        std::vector<double> y, z;
        for (double height = -35e-3; height < 20e-3; height += 0.2e-3) {
          const double up = std::max(0.0, height - (kTip - kFillet));  // a fillet of 20 mm radius
          y.push_back(-70e-3 - std::tan(lean) * (height - (kTip - kFillet)) + up * up / 40e-3 -
                      burr * std::exp(-std::pow((height - at) / 3e-3, 2)));
          z.push_back(height);
        }
        const std::optional<FlangeBack> back = straight_back(y, z, kTip);
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->y, -70e-3, 1e-5) << lean << ' ' << burr << ' ' << at;
        EXPECT_NEAR(back->lean, lean, 3e-4) << lean << ' ' << burr << ' ' << at;
        EXPECT_NEAR(back->beyond, burr, at > 10e-3 ? 0.5 * burr + 1e-6 : 0.05e-3) << lean << ' ' << burr << ' ' << at;
        EXPECT_GT(back->length, 30e-3);
      }
  // a curve has none
  std::vector<double> y, z;
  for (double height = -35e-3; height < 20e-3; height += 0.2e-3)
    y.push_back(-70e-3 + std::pow(height, 2) / 40e-3), z.push_back(height);
  EXPECT_FALSE(straight_back(y, z, kTip));
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

/// The head of 60E1 (EN 13674-1) 38 mm deep, points 0.1 mm apart.
std::vector<Vec2> head_of_60E1() {
  std::vector<Vec2> half;
  const auto arc = [&](double y, double z, double radius, double from, double to) {
    for (double a = std::asin((from - y) / radius); a < std::asin(std::min(1.0, (to - y) / radius)); a += 0.1 / radius)
      half.emplace_back(y + radius * std::sin(a), z - radius * std::cos(a));
  };
  arc(0.0, 300.0, 300.0, 0.05, 10.228);
  arc(7.500533, 80.127896, 80.0, 10.228, 26.0265);
  arc(23.016030, 14.949147, 13.0, 26.0265, 35.999811);
  for (double z = 14.299958; z < 37.8; z += 0.1) half.emplace_back(35.999811 + (z - 14.299958) / 20.0, z);
  std::vector<Vec2> out;
  for (auto p = half.rbegin(); p != half.rend(); ++p) out.emplace_back(-p->x(), p->y());
  out.insert(out.end(), half.begin(), half.end());
  for (Vec2& p : out) p *= 1e-3;
  return out;
}

TEST(MeasuredSection, RollsOfAFlatHeadAWornSideAndALipAreFound) {
  const std::vector<Vec2> head = head_of_60E1();
  const std::vector<NominalOutline> nominals{nominal_outline("60E1", Body::rail, head)};
  const auto worn = [](const Vec2& p, double wear) {
    const double t = std::clamp((p.y() - 1e-3) / 11e-3, 0.0, 1.0);
    return p.x() < 0.0 ? Vec2(p.x() + wear * t * t * (3.0 - 2.0 * t), p.y()) : p;
  };
  const std::pair<const char*, std::function<Vec2(const Vec2&)>> shapes[]{
      {"flat", [](const Vec2& p) { return Vec2(p.x(), 0.5 * (p.y() + 1e-3 + std::hypot(p.y() - 1e-3, 1.2e-3))); }},
      {"worn", [&](const Vec2& p) { return worn(p, 4e-3); }},
      {"lip", [&](const Vec2& p) {
         const double lip = p.x() < 0.0 ? 1.2e-3 * std::exp(-std::pow((p.y() - 9e-3) / 3e-3, 2)) : 0.0;
         return Vec2(worn(p, 3e-3) - Vec2(lip, 0.0));
       }}};
  for (const auto& [name, shape] : shapes)
    for (double degrees = -10.0; degrees <= 10.0; degrees += 0.25) {
      const Eigen::Rotation2Dd by(degrees * kDegree);
      Profile p;
      for (const Vec2& q : head) {
        const Vec2 rolled = by * shape(q);
        p.y.push_back(rolled.x()), p.z.push_back(rolled.y());
      }
      const std::optional<Lean> lean = lean_of(p, nominals);
      ASSERT_TRUE(lean);
      EXPECT_NEAR(lean->roll, degrees * kDegree, 5e-3) << name << ' ' << degrees;
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
