// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/pass_steps.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "treadmark/core/parallel.hpp"
#include "treadmark/scans/placement/band_frame.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

constexpr double kRadius = 0.46, kNoise = 10e-6;

Section wheel_section() {
  auto points = tests::nominal_points("S1002", Body::wheel);
  std::erase_if(points, [](const Vec2& p) { return std::fabs(p.x()) > 55e-3; });
  for (Vec2& p : points) p.y() += kRadius;
  return Section(points);
}

/// Passes over arcs of a wheel, each with its rigid error.
struct Scan {
  Pose X_CS = tests::some_frame(3);
  std::vector<Vec3> points, exact;
  std::vector<std::uint16_t> passes;

  void add(const Section& section, std::uint16_t pass, double from, double to, const Vec3& shift_S, const Vec3& turn_S,
           int count, std::uint64_t seed) {
    Random random(seed);
    const double angle = turn_S.norm();
    const Mat3 turn = angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, turn_S / angle)) : Mat3::Identity();
    for (int k = 0; k < count; ++k) {
      const double u = from + (to - from) * random.uniform();
      const Section::Point at = section.at(3e-3 + (section.length() - 6e-3) * random.uniform());
      const Vec2 p = at.position + kNoise * tests::gaussian(random) * at.normal;
      const Vec3 place = from_natural(Body::wheel, {u, p.x(), p.y()});
      const Vec3 middle = from_natural(Body::wheel, {0.5 * (from + to), 0.0, kRadius});
      exact.push_back(X_CS.apply(place));
      points.push_back(X_CS.apply(middle + turn * (place - middle) + shift_S));
      passes.push_back(pass);
    }
  }
  Projection projection(const Section& section) const {
    return project(points, {}, X_CS, section, {Body::wheel, kRadius});
  }
};

/// Greatest and rms difference of mean distances between passes in cells of 8 mm that two have seen.
struct Difference {
  double rms = 0.0, most = 0.0;
  std::size_t cells = 0;
};
Difference difference(const Projection& p, std::span<const std::uint16_t> passes) {
  std::map<std::pair<long, long>, std::map<std::uint16_t, std::pair<double, int>>> cells;
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    auto& [sum, count] =
        cells[{std::lround(p.points.a[i] / 8e-3), std::lround(p.points.s[i] / 8e-3)}][passes[p.points.index[i]]];
    sum += p.points.d[i];
    ++count;
  }
  Difference out;
  for (const auto& [place, by_pass] : cells) {
    if (by_pass.size() != 2) continue;
    const auto& [one, other] = std::pair(by_pass.begin()->second, std::next(by_pass.begin())->second);
    if (one.second < 30 || other.second < 30) continue;
    const double apart = std::fabs(one.first / one.second - other.first / other.second);
    out.rms += apart * apart;
    out.most = std::max(out.most, apart);
    ++out.cells;
  }
  out.rms = std::sqrt(out.rms / static_cast<double>(std::max<std::size_t>(out.cells, 1)));
  return out;
}

Scan three_passes(const Section& section) {
  Scan scan;
  scan.add(section, 4, -0.6, 0.0, {20e-6, 150e-6, -100e-6}, {0.3e-3, 0.0, 0.4e-3}, 60000, 1);
  scan.add(section, 7, -0.3, 0.3, Vec3::Zero(), Vec3::Zero(), 60000, 2);
  scan.add(section, 9, 0.0, 0.6, {-80e-6, -200e-6, 120e-6}, {-0.2e-3, 0.3e-3, -0.5e-3}, 60000, 3);
  return scan;
}

TEST(PassSteps, RigidErrorsAreRemovedWherePassesOverlap) {
  const Section section = wheel_section();
  Scan scan = three_passes(section);
  const Projection before = scan.projection(section);
  const Difference was = difference(before, scan.passes);
  const PassSteps steps = find_pass_steps(before.points, before.band, scan.passes);
  ASSERT_EQ(steps.passes.size(), 3u);
  std::size_t points = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(steps.passes[k].pass, (std::array<int, 3>{4, 7, 9})[k]);
    EXPECT_GT(steps.passes[k].shared, 1000u);
    points += steps.passes[k].points;
  }
  EXPECT_EQ(points, before.points.size());
  EXPECT_GT(steps.before, 50e-6);
  apply(steps, scan.passes, scan.X_CS, scan.points);
  const Projection after = scan.projection(section);
  const Difference is = difference(after, scan.passes);
  ASSERT_GT(is.cells, 500u);
  RecordProperty("rms_before_um", std::to_string(1e6 * was.rms));
  RecordProperty("rms_after_um", std::to_string(1e6 * is.rms));
  EXPECT_GT(was.rms, 50e-6);
  // means of 60 points or so of 10 um differ by 2 um
  EXPECT_LT(is.rms, 3e-6);
  EXPECT_LT(is.most, 12e-6);
  // and none is left to find
  const PassSteps again = find_pass_steps(after.points, after.band, scan.passes);
  EXPECT_LT(again.after, 1.05 * steps.after);
  EXPECT_LT(again.before, 1.05 * steps.after);
  // a pass moves as one: distances within it stay
  for (std::size_t i = 1; i < 50; ++i)
    EXPECT_NEAR((scan.points[i] - scan.points[0]).norm(), (scan.exact[i] - scan.exact[0]).norm(), 1e-12);
}

TEST(PassSteps, DamageInOneOfThemDoesNotPull) {
  const Section section = wheel_section();
  Scan scan = three_passes(section);
  // a tenth of the overlap was seen 1 mm deeper by one pass
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3 p = scan.X_CS.apply_inverse(scan.points[i]);
    const double u = std::atan2(p.x(), p.z());
    if (scan.passes[i] == 4 && u > -0.2 && u < -0.17)
      scan.points[i] = scan.X_CS.apply(p - 1e-3 * Vec3(std::sin(u), 0.0, std::cos(u)));
  }
  const Projection before = scan.projection(section);
  apply(find_pass_steps(before.points, before.band, scan.passes), scan.passes, scan.X_CS, scan.points);
  Scan rest;
  rest.X_CS = scan.X_CS;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3 p = scan.X_CS.apply_inverse(scan.points[i]);
    const double u = std::atan2(p.x(), p.z());
    if (u > -0.22 && u < -0.15) continue;
    rest.points.push_back(scan.points[i]);
    rest.passes.push_back(scan.passes[i]);
  }
  EXPECT_LT(difference(rest.projection(section), rest.passes).rms, 4e-6);
}

TEST(PassSteps, APassWithoutOverlapStays) {
  const Section section = wheel_section();
  Scan scan = three_passes(section);
  scan.add(section, 11, 1.0, 1.5, {100e-6, 100e-6, 300e-6}, {0.5e-3, 0.0, 0.0}, 30000, 5);
  const std::vector<Vec3> before = scan.points;
  const Projection p = scan.projection(section);
  const PassSteps steps = find_pass_steps(p.points, p.band, scan.passes);
  ASSERT_EQ(steps.passes.size(), 4u);
  EXPECT_EQ(steps.passes[3].shared, 0u);
  EXPECT_GT(steps.passes[3].points, 29900u);  // its last row is cut off
  EXPECT_LT(steps.passes[3].shift_S.norm(), 1e-15);
  EXPECT_LT(steps.passes[3].turn_S.norm(), 1e-15);
  apply(steps, scan.passes, scan.X_CS, scan.points);
  for (std::size_t i = scan.points.size() - 30000; i < scan.points.size(); ++i)
    ASSERT_LT((scan.points[i] - before[i]).norm(), 1e-14);
}

TEST(PassSteps, NothingToDoForOnePass) {
  const Section section = wheel_section();
  Scan scan;
  scan.add(section, 3, -0.5, 0.5, {100e-6, 0.0, 100e-6}, Vec3::Zero(), 20000, 1);
  const Projection p = scan.projection(section);
  const PassSteps steps = find_pass_steps(p.points, p.band, scan.passes);
  EXPECT_TRUE(steps.passes.empty());
  EXPECT_TRUE(find_pass_steps(p.points, p.band, {}).passes.empty());
  const std::vector<Vec3> before = scan.points;
  apply(steps, scan.passes, scan.X_CS, scan.points);
  EXPECT_EQ(scan.points, before);
}

TEST(PassSteps, TheSameForAnyNumberOfThreads) {
  const Section section = wheel_section();
  Scan scan = three_passes(section);
  const Projection p = scan.projection(section);
  std::vector<PassSteps> steps;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    steps.push_back(find_pass_steps(p.points, p.band, scan.passes));
  }
  EXPECT_EQ(steps[0].after, steps[1].after);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(steps[0].passes[k].shift_S, steps[1].passes[k].shift_S);
}

}  // namespace
}  // namespace treadmark::scans
