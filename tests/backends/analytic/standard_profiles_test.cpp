// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::analytic {
namespace {

constexpr double kMm = 1e-3;

TEST(S1002, PassesThroughThePublishedPoints) {
  // EN 13715: tape circle, flange tip (y = -55, z = 28), end of the 70 degree face, flange back
  const GraphCurve curve = s1002_curve();
  constexpr double kPrinted = 1e-3 * kMm;  // the standard prints three decimals
  const double points[][2] = {{0.0, 0.0},        {-26.0, 2.741}, {-35.0, 6.867},    {-38.427, 12.0}, {-39.765, 15.675},
                              {-49.663, 26.748}, {-55.0, 28.0},  {-62.765, 25.149}, {-70.0, 9.519}};
  for (const auto& p : points) {
    // prints of y are rounded too: allow for the slope there
    const double y = p[0] * kMm;
    const Jet jet = curve.jet(y, curve.find(y, 0));
    const double slope = std::min(3.0, std::fabs(jet.dh));
    EXPECT_NEAR(jet.h, p[1] * kMm, kPrinted * (1.0 + slope)) << "y = " << p[0];
  }
  EXPECT_DOUBLE_EQ(curve.y_min(), -0.070);
  EXPECT_DOUBLE_EQ(curve.y_max(), 0.060);
}

TEST(S1002, JointsMatchAsPublished) {
  const GraphCurve curve = s1002_curve();
  for (int i = 0; i + 1 < curve.piece_count(); ++i) {
    const double y = curve.piece_end(i);
    EXPECT_EQ(y, curve.piece_start(i + 1));
    const Jet left = curve.jet(y, i), right = curve.jet(y, i + 1);
    EXPECT_NEAR(left.h, right.h, 1.3e-4 * kMm) << "y = " << y;  // the polynomials' own rounding
    EXPECT_NEAR(left.dh, right.dh, 3e-5 * (1.0 + left.dh * left.dh)) << "y = " << y;
  }
}

TEST(S1002, DerivativesMatchDifferences) {
  const GraphCurve curve = s1002_curve();
  constexpr double kStep = 1e-6;
  for (double y = -0.0685; y < 0.0595; y += 0.00037) {
    const int piece = curve.find(y, 3);
    if (y - kStep < curve.piece_start(piece) || y + kStep > curve.piece_end(piece)) continue;
    const Jet m = curve.jet(y - kStep, piece), o = curve.jet(y, piece), p = curve.jet(y + kStep, piece);
    EXPECT_NEAR((p.h - m.h) / (2 * kStep), o.dh, 1e-6 * (1.0 + o.dh * o.dh));
    EXPECT_NEAR((p.dh - m.dh) / (2 * kStep), o.ddh, 1e-5 * (1.0 + std::fabs(o.ddh)));
  }
}

TEST(S1002, RangesHoldTheCurve) {
  const GraphCurve curve = s1002_curve();
  for (double a = -0.07; a < 0.059; a += 0.0013)
    for (const double width : {1e-5, 1e-3, 2e-2}) {
      const CurveRange range = curve.range(a, a + width);
      for (int i = 0; i <= 50; ++i) {
        const double y = std::min(a + width * i / 50, 0.06);
        const Jet jet = curve.jet(y, curve.find(y, 0));
        EXPECT_GE(jet.h, range.h_min - 1e-15);
        EXPECT_LE(jet.h, range.h_max + 1e-15);
        EXPECT_GE(jet.dh, range.dh_min - 1e-9);
        EXPECT_LE(jet.dh, range.dh_max + 1e-9);
      }
    }
}

TEST(S1002, AgreesWithTheBenchmarkFile) {
  TREADMARK_REQUIRE_SHARED();
  std::ifstream in(*shared / "data/contact_examples/MBench_S1002_v3.prw");
  ASSERT_TRUE(in);
  const auto wheel = make_standard_surface({"S1002"}, Body::wheel, 0.46);
  constexpr double kFile = 2e-6 * kMm;  // digits of the file
  int compared = 0;
  bool points = false;
  for (std::string line; std::getline(in, line);) {
    if (line.find("point.begin") != std::string::npos) points = true;
    if (line.find("point.end") != std::string::npos) points = false;
    double y = 0.0, z = 0.0;
    if (!points || std::sscanf(line.c_str(), "%lf %lf", &y, &z) != 2) continue;
    y = -y;  // the file is written for the other side
    // flange and tread only: at the flange back the profile is vertical
    if (y < -69.5 || y > 60.0) continue;
    const Pose X{{0.0, y * kMm, 0.46}, Mat3::Identity()};
    EXPECT_NEAR(height_at(*wheel, X, {0.0, 0.0}), z * kMm, kFile) << "y = " << y;
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(Rail60E1, HasThePublishedJoints) {
  // derived from EN 13674-1 to 1e-6 mm, y and z (down) from the crown
  const auto chain = resolve(rail_60e1_chain());
  ASSERT_EQ(chain.size(), 7u);
  constexpr double kDigits = 1e-6 * kMm;
  const double joints[][2] = {{-35.999811, 14.299958}, {-26.0265, 2.302524}, {-10.228, 0.174404},
                              {10.228, 0.174404},      {26.0265, 2.302524},  {35.999811, 14.299958}};
  for (std::size_t i = 1; i < chain.size(); ++i) {
    EXPECT_NEAR(chain[i].y, joints[i - 1][0] * kMm, kDigits);
    EXPECT_NEAR(chain[i].z, joints[i - 1][1] * kMm, kDigits);
  }
  EXPECT_NEAR(chain[3].angle, -1.95378 * std::acos(-1.0) / 180.0, 1e-7);
  EXPECT_NEAR(chain[2].angle, -13.38979 * std::acos(-1.0) / 180.0, 1e-7);
  // symmetric, and the sides reach about 35 mm down at 1:20
  EXPECT_NEAR(chain.back().z + chain.back().length * std::sin(chain.back().angle), chain.front().z, 1e-15);
  EXPECT_NEAR(std::tan(chain.back().angle), 20.0, 1e-9);
  EXPECT_NEAR(chain.front().z, 35.3e-3, 0.3e-3);
}

TEST(StandardProfiles, RefuseWhatMakesNoSense) {
  const auto kind_of = [](auto&& call) {
    try {
      call();
    } catch (const Error& error) {
      return std::pair(true, error.kind());
    }
    return std::pair(false, ErrorKind::numerical);
  };
  const std::pair expected(true, ErrorKind::configuration);
  EXPECT_EQ(kind_of([] { make_standard_surface({"S1003"}, Body::wheel, 0.46); }), expected);
  EXPECT_EQ(kind_of([] { make_standard_surface({"S1002"}, Body::rail, 0.0); }), expected);
  EXPECT_EQ(kind_of([] { make_standard_surface({"60E1"}, Body::wheel, 0.46); }), expected);
  EXPECT_EQ(kind_of([] { make_standard_surface({"S1002"}, Body::wheel, 0.0); }), expected);
  EXPECT_EQ(kind_of([] { make_standard_surface({"60E1"}, Body::rail, 0.0, {WheelFlat{}}); }), expected);
  EXPECT_EQ(kind_of([] { make_standard_surface({"S1002"}, Body::wheel, 0.46, {WheelFlat{}}); }), expected);
  EXPECT_EQ(kind_of([] { make_prismatic_surface({}); }), expected);
  EXPECT_EQ(kind_of([] { make_prismatic_surface({0, 0, 0, {{-1.0, 0.0}}}); }), expected);
  EXPECT_EQ(kind_of([] { make_revolved_surface(cylinder_chain(0.3, 1.7), 0.4); }), expected);
  EXPECT_EQ(kind_of([] { make_revolved_surface({0, -0.5, 0, {{0.1, 0.0}}}, 0.4); }), expected);
}

}  // namespace
}  // namespace treadmark::analytic
