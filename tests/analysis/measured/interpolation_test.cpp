// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/interpolation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "noisy_head.hpp"
#include "treadmark/analysis/measured/smoothing.hpp"

namespace treadmark::measured {
namespace {

using testing::head;
using testing::head_at;

/// The head at equal steps of y, of which one lies so much of a step beside its middle.
Profile head_beside(double step, double part) {
  Profile p;
  const int half = static_cast<int>(std::floor(33e-3 / step));
  for (int i = -half; i <= half; ++i) p.y.push_back((i + part) * step), p.z.push_back(head_at(p.y.back()).z);
  return p;
}

double greatest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// The arcs of 300 and 80 mm meet 10 mm beside the middle: what the spline through the points is off them between
/// these.
TEST(BetweenPoints, AreOffByAboutWhatIsStated) {
  for (const double step : {0.8e-3, 1e-3, 1.5e-3, 2e-3, 3e-3})
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const Profile p = head_beside(step, part);
      const BetweenPoints known = known_between(p);
      ASSERT_EQ(known.deviation.size() + 1, p.y.size()) << step << ' ' << part;
      std::vector<double> s;
      const Profile all = with_middles(p, known, s);
      ASSERT_EQ(s.size(), all.y.size());
      double off = 0.0, stated = 0.0;
      for (std::size_t i = 0; i < all.y.size(); ++i) {
        const auto exact = head_at(all.y[i]);
        if (std::fabs(all.y[i]) < 18e-3)
          off = std::max(off, std::fabs(all.z[i] - exact.z) / std::hypot(1.0, exact.slope));
      }
      for (std::size_t i = 0; i < known.deviation.size(); ++i)
        if (std::fabs(p.y[i]) < 18e-3) stated = std::max(stated, known.deviation[i]);
      EXPECT_LT(off, 2.5 * stated) << step << ' ' << part;
      EXPECT_GT(off, 0.1 * stated) << step << ' ' << part;
    }
}

TEST(BetweenPoints, AreKnownWhereTheyAreCloseOrTheCurveBendsEvenly) {
  for (const double step : {0.1e-3, 0.25e-3, 0.5e-3}) EXPECT_TRUE(known_between(head(step)).deviation.empty()) << step;
  Profile line, circle;
  for (int i = -12; i <= 12; ++i) {
    line.y.push_back(3e-3 * i), line.z.push_back(-0.05 * line.y.back());
    const double angle = 0.01 * i;
    circle.y.push_back(0.3 * std::sin(angle)), circle.z.push_back(0.3 - 0.3 * std::cos(angle));
  }
  EXPECT_TRUE(known_between(line).deviation.empty());
  EXPECT_TRUE(known_between(circle).deviation.empty());
  // a corner of 0.1 rad at a point: somewhere between its neighbours
  for (std::size_t i = 0; i < line.y.size(); ++i) line.z[i] += 0.1 * std::max(0.0, line.y[i]);
  const std::vector<double> deviation = known_between(line).deviation;
  ASSERT_EQ(deviation.size(), line.y.size() - 1);
  EXPECT_GT(greatest(deviation), 10e-6);
  EXPECT_LT(greatest(deviation), 0.1 * 3e-3);
  EXPECT_EQ(deviation.front(), 0.0);
}

TEST(BetweenPoints, DrawsVanishAtThePointsAndAreAsLargeBetween) {
  const Profile given = head_beside(2e-3, 0.25), p = smoothed_by_noise(given);
  EXPECT_EQ(p.y, given.y);
  EXPECT_EQ(p.z, given.z);
  ASSERT_TRUE(has_errors(p));
  EXPECT_FALSE(is_smoothed(p));
  const ErrorDraws draws(p);
  ASSERT_EQ(draws.size(), 16u);
  const ProfileScatter& scatter = *p.scatter;
  double squares = 0.0, stated = 0.0;
  for (std::size_t draw = 0; draw < draws.size(); ++draw)
    for (std::size_t i = 0; i < scatter.between.size(); ++i) {
      EXPECT_LT(std::fabs(draws.at(draw, scatter.s[i])), 1e-3 * greatest(scatter.between));
      squares += std::pow(draws.at(draw, 0.5 * (scatter.s[i] + scatter.s[i + 1])), 2);
      stated += std::pow(scatter.between[i], 2);
    }
  EXPECT_NEAR(std::sqrt(squares / stated), 1.0, 0.35);
  const Profile moved = draws.moved(p, 3);
  EXPECT_GT(moved.y.size(), p.y.size());
  EXPECT_EQ(draws.moved(p, 3).z, moved.z);
  const std::vector<double> at_points = deviations(scatter);
  EXPECT_EQ(greatest(at_points), greatest(scatter.between));
  // dense points have none, as before
  EXPECT_FALSE(has_errors(smoothed_by_noise(head(0.5e-3))));
}

}  // namespace
}  // namespace treadmark::measured
