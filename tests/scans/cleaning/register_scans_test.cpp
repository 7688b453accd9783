// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/register_scans.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;

/// Two scans of a rail in a row, the second one (pass 7) moved.
struct TwoScans {
  std::vector<Vec3> points, truth;
  std::vector<std::uint16_t> passes;

  TwoScans(bool squat, double second_from, const Pose& moved) {
    SurfaceSpec spec{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
    if (squat) spec.defects.squats.push_back({.length = 60e-3, .width = 40e-3, .depth = 1.5e-3, .x_center = 0.5});
    const auto surface = create_surface(spec);
    const Pose X_CS = tests::some_frame(4);
    constexpr double kLong = 0.7, kScatter = 20e-6;
    constexpr int kStations = 700, kAcross = 90;
    for (const std::uint16_t pass : {std::uint16_t{2}, std::uint16_t{7}}) {
      const double from = pass == 2 ? 0.0 : second_from;
      for (const Vec3& p : tests::simple_cloud(*surface, Body::rail, from, from + kLong, -35.5e-3, 35.5e-3, kStations,
                                               kAcross, kScatter, 0.0, Pose{}, pass)
                               .points_S) {
        truth.push_back(p);
        points.push_back(X_CS.apply(pass == 2 ? p : moved.apply(p)));
        passes.push_back(pass);
      }
    }
    for (Vec3& p : truth) p = X_CS.apply(p);
    along = X_CS.rotation.col(0);
  }
  Vec3 along = Vec3::Zero();
};

Pose some_error(double shift, double turn) {
  return {shift * Vec3(0.3, -0.7, 0.5), Mat3(Eigen::AngleAxisd(turn, Vec3(0.5, 0.3, -0.8).normalized()))};
}

/// Farthest that points of the second scan lie off where they should be: along the rail, and across it.
std::pair<double, double> farthest_off(const TwoScans& two, const std::vector<ScanMotion>& found) {
  std::pair<double, double> out{0.0, 0.0};
  for (std::size_t i = 0; i < two.points.size(); ++i) {
    if (two.passes[i] != 7) continue;
    const Vec3 off = found.back().motion.apply(two.points[i]) - two.truth[i];
    const double on = two.along.dot(off);
    out.first = std::max(out.first, std::fabs(on));
    out.second = std::max(out.second, (off - on * two.along).norm());
  }
  return out;
}

std::string refusal(const TwoScans& two, double farthest) {
  try {
    register_scans(two.points, two.passes, farthest);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    return error.message();
  }
  return {};
}

TEST(RegisterScans, ByWhatOverlaps) {
  const TwoScans two(true, 0.3, some_error(8e-3, 6e-3));
  const std::vector<ScanMotion> found = register_scans(two.points, two.passes, 25e-3);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].pass, 2);
  EXPECT_EQ(found[0].shift, Vec3::Zero());
  EXPECT_EQ(found[1].pass, 7);
  EXPECT_NEAR(found[1].overlap, 0.4 / 0.7, 0.08);
  EXPECT_LT(found[1].apart, 0.1e-3);
  const auto [along, across] = farthest_off(two, found);
  constexpr double kAcross = 0.25e-3, kAlong = 2e-3;  // the rest is for find_pass_steps; along tells the squat alone
  EXPECT_LT(across, kAcross);
  EXPECT_LT(along, kAlong);
  EXPECT_GT(found[1].shift_error, 0.0);
  EXPECT_LT(found[1].shift_error, 0.5e-3);
  const ThreadLimit one(1);
  const std::vector<ScanMotion> again = register_scans(two.points, two.passes, 25e-3);
  EXPECT_TRUE(again[1].motion.origin == found[1].motion.origin);
  EXPECT_TRUE(again[1].motion.rotation == found[1].motion.rotation);
}

TEST(RegisterScans, APlainRailTellsNothingAlongIt) {
  const Pose sideways{Vec3(0.0, 3e-3, -2e-3), Mat3::Identity()};
  const TwoScans two(false, 0.3, sideways);
  const std::vector<ScanMotion> found = register_scans(two.points, two.passes, 20e-3);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_GE(found[1].open, 1u);
  const auto [along, across] = farthest_off(two, found);
  EXPECT_LT(across, 0.15e-3);
  EXPECT_LT(along, 0.2e-3) << "it stays where it was";
}

TEST(RegisterScans, DoubtfulOnesAreRefused) {
  const TwoScans apart(true, 0.69, Pose{});
  EXPECT_THAT(refusal(apart, 20e-3), HasSubstr("scan 7 cannot be laid on the others: only"));
  const TwoScans far(true, 0.3, Pose{Vec3(0.0, 12e-3, -6e-3), Mat3::Identity()});
  EXPECT_THAT(refusal(far, 5e-3), HasSubstr("scan 7 cannot be laid on the others"));
  TwoScans other(false, 0.3, Pose{});
  for (std::size_t i = 0; i < other.points.size(); ++i)
    if (other.passes[i] == 7) other.points[i] *= 1.1;  // another unit, or another rail
  EXPECT_THAT(refusal(other, 40e-3), HasSubstr("scan 7 cannot be laid on the others"));
  TwoScans few(true, 0.3, Pose{});
  few.points.insert(few.points.end(), few.points.begin(), few.points.begin() + 57);
  few.passes.insert(few.passes.end(), 57, 9);
  EXPECT_THAT(refusal(few, 20e-3), HasSubstr("scan 9 cannot be laid on the others"));
  const std::vector<std::uint16_t> one(apart.points.size(), 3);
  EXPECT_TRUE(register_scans(apart.points, one, 20e-3).empty());
}

}  // namespace
}  // namespace treadmark::scans
