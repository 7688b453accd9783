// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The contact locus on rows, for agreement with the reference program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/search/scenes.hpp"

namespace treadmark::testing {
namespace {

using detection::ContactLocus;
using detection::ContactPatch;
using detection::ContactSearch;
using detection::LocusRows;
using detection::PenetrationWeight;
using detection::ReferenceLocus;
using detection::SearchMethod;
using detection::SearchSettings;

constexpr double kLocusRadius = 0.46;
constexpr LocusRows kRows{-0.036, 0.06e-3, 1201, kLocusRadius};

struct StandardPair {
  std::shared_ptr<const Surface> rail = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}}, "spline");
  std::shared_ptr<const Surface> wheel =
      create_surface({Body::wheel, kLocusRadius, StandardProfile{"S1002"}, {}}, "spline");

  detection::BodyPair placed(double y, double yaw) const {
    return {rail.get(),
            wheel.get(),
            {Vec3::Zero(), rotation_x(-1.0 / 40.0)},
            {{0.0, y, -kLocusRadius}, rotation({0.3 * yaw, yaw, 0.5})}};
  }
};

SearchSettings settings() {
  SearchSettings s;
  s.grid_T = {-0.09, -0.036, 0.3e-3, 0.06e-3, 601, 1201};
  s.rules.separation = 2e-3, s.rules.combination = 1e-3;
  return s;
}

TEST(ReferenceLocus, EqualsTreadmarksOwnOnSmoothProfiles) {
  const StandardPair p;
  int two_patches = 0, compared = 0;
  for (double y = -0.009; y < 0.0091; y += 0.6e-3)
    for (const double yaw : {0.0, 0.004, -0.01}) {
      const auto pair = p.placed(y, yaw);
      SearchSettings s = settings();
      ContactSearch own(pair, s);
      s.locus_rows = kRows;
      ContactSearch reference(pair, s);
      ASSERT_EQ(reference.method(), SearchMethod::locus);
      EXPECT_NEAR(reference.least_gap(), own.at(own.least_gap()).least_gap + own.least_gap(), 1e-6);
      const double depth = reference.least_gap() + 8e-5;
      const auto a = own.at(depth), b = reference.at(depth);
      const std::string where = "y = " + std::to_string(y) + ", yaw = " + std::to_string(yaw);
      ASSERT_EQ(a.patches.size(), b.patches.size()) << where;
      two_patches += a.patches.size() == 2;
      for (std::size_t i = 0; i < a.patches.size(); ++i) {
        const ContactPatch &u = a.patches[i], &v = b.patches[i];
        // A flange at 70 degrees is met at an x that the first order in the yaw angle gives less well, and is short
        // across.
        if (std::abs(u.inclination) > 0.9) continue;
        ++compared;
        EXPECT_NEAR(u.x, v.x, 0.1e-3) << where;
        EXPECT_NEAR(u.y, v.y, 0.5 * kRows.step) << where;
        EXPECT_NEAR(u.extent.box.y_min, v.extent.box.y_min, kRows.step) << where;
        EXPECT_NEAR(u.extent.box.y_max, v.extent.box.y_max, kRows.step) << where;
        EXPECT_NEAR(u.extent.z_at_y_min, v.extent.z_at_y_min, 0.5 * kRows.step) << where;
        EXPECT_NEAR(u.extent.z_at_y_max, v.extent.z_at_y_max, 0.5 * kRows.step) << where;
        // The nominal radius for the wheel's own.
        const double width = u.extent.box.x_max - u.extent.box.x_min;
        EXPECT_NEAR(v.extent.box.x_max - v.extent.box.x_min, width, 0.03 * width) << where;
        EXPECT_NEAR(u.inclination, v.inclination, 2e-3) << where;
        EXPECT_NEAR(u.least_gap, v.least_gap, 5e-7) << where;
      }
    }
  EXPECT_GT(two_patches, 0);
  EXPECT_GT(compared, 60);
}

/// Rail and wheel of circular heads about y = 0, both through the origin: the gap is known.
struct Heads {
  static constexpr double kRailHead = 0.3, kWheelHead = 1.1;
  std::shared_ptr<const Surface> rail = head(Body::rail, kRailHead), wheel = head(Body::wheel, kWheelHead);

  static std::shared_ptr<const Surface> head(Body body, double r) {
    Profile profile;
    profile.body = body;
    const double side = body == Body::rail ? 1.0 : -1.0;
    for (int i = -200; i <= 200; ++i) {
      const double y = 0.1e-3 * side * i;
      profile.y.push_back(y);
      profile.z.push_back(side * (r - std::sqrt(r * r - y * y)));
    }
    return create_surface({body, kLocusRadius, profile, {}}, "spline");
  }
  detection::BodyPair pair() const {
    return {rail.get(), wheel.get(), {}, {{0.0, 0.0, -kLocusRadius}, Mat3::Identity()}};
  }
  static double gap(double y) {
    return kRailHead - std::sqrt(kRailHead * kRailHead - y * y) + kWheelHead -
           std::sqrt(kWheelHead * kWheelHead - y * y);
  }
};

TEST(ReferenceLocus, SumsPenetrationOverItsRows) {
  const Heads heads;
  const LocusRows rows{-9.93e-3, 0.21e-3, 96, kLocusRadius};
  const double dz = 7e-5, kappa = 0.5 / kLocusRadius;
  const ReferenceLocus locus(heads.pair(), rows);
  for (const auto weight : {PenetrationWeight::linear, PenetrationWeight::squared}) {
    const ContactLocus::Found found = locus.at(dz, -1.0, weight, false);
    ASSERT_EQ(found.patches.size(), 1u);
    const ContactPatch& p = found.patches.front();
    double sum = 0.0, sum_y = 0.0, sum_a = 0.0, x_end = 0.0;
    int first = -1, last = -1;
    for (int i = 0; i < rows.count; ++i) {
      const double y = rows.y(i), pen = dz - Heads::gap(y), inclination = std::asin(y / Heads::kRailHead);
      if (!(pen > 0.0)) continue;
      first = first < 0 ? i : first, last = i;
      // Simpson's rule along x.
      constexpr int kParts = 200;
      const double half = std::sqrt(pen / kappa), h = 2.0 * half / kParts;
      double integral = 0.0;
      for (int k = 0; k <= kParts; ++k) {
        const double x = -half + k * h, c = pen - kappa * x * x,
                     value = weight == PenetrationWeight::linear ? c : c * c;
        integral += (k == 0 || k == kParts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * value * h / 3.0;
      }
      sum += integral, sum_y += integral * y, sum_a += integral * inclination;
      x_end = std::max(x_end, half);
    }
    const auto end = [&](int inside, int guard) {
      const double in = Heads::gap(rows.y(inside)) - dz, out = Heads::gap(rows.y(guard)) - dz;
      return rows.y(inside) + (rows.y(guard) - rows.y(inside)) * in / (in - out);
    };
    EXPECT_NEAR(p.weight, sum * rows.step, 1e-5 * p.weight);
    EXPECT_NEAR(p.x, 0.0, 1e-12);
    EXPECT_NEAR(p.y, sum_y / sum, 1e-8);
    EXPECT_NEAR(p.inclination, sum_a / sum, 1e-7);
    EXPECT_NEAR(p.extent.box.x_max, x_end, 1e-7);
    EXPECT_NEAR(p.extent.box.x_min, -x_end, 1e-7);
    EXPECT_NEAR(p.extent.box.y_min, end(first, first - 1), 1e-8);
    EXPECT_NEAR(p.extent.box.y_max, end(last, last + 1), 1e-8);
    EXPECT_NEAR(p.least_gap, -dz, 1e-10);
    EXPECT_NEAR(p.deepest_T.y(), 0.0, 1e-6) << "rows pass beside y = 0, the vertex does not";
  }
  const ContactPatch deepest = locus.at(dz, -1.0, PenetrationWeight::squared, true).patches.front();
  EXPECT_EQ(deepest.y, deepest.deepest_T.y());
}

TEST(ReferenceLocus, TellsNearMisses) {
  const Heads heads;
  const ReferenceLocus locus(heads.pair(), {-9.93e-3, 0.21e-3, 96, kLocusRadius});
  EXPECT_NEAR(locus.least(), 0.0, 1e-10);
  const auto apart = locus.at(-1e-5, 5e-5, PenetrationWeight::squared, false);
  EXPECT_TRUE(apart.patches.empty());
  ASSERT_EQ(apart.near_misses.size(), 1u);
  EXPECT_NEAR(apart.near_misses.front().y, 0.0, 1e-6);
  EXPECT_NEAR(apart.near_misses.front().least_gap, 1e-5, 3e-8);
  EXPECT_TRUE(locus.at(-1e-4, 5e-5, PenetrationWeight::squared, false).near_misses.empty());
}

TEST(ReferenceLocus, AnswersThreadsAlike) {
  const StandardPair p;
  const ReferenceLocus locus(p.placed(-0.0005, 0.004), kRows);
  const auto one = locus.at(locus.least() + 1e-4, -1.0, PenetrationWeight::squared, false);
  std::vector<ContactLocus::Found> many(4);
  std::vector<std::thread> threads;
  for (auto& found : many)
    threads.emplace_back([&] { found = locus.at(locus.least() + 1e-4, -1.0, PenetrationWeight::squared, false); });
  for (auto& thread : threads) thread.join();
  for (const auto& found : many)
    EXPECT_EQ(difference({found.patches, found.least_gap}, {one.patches, one.least_gap}, 0.0), "");
}

Profile crown() {
  constexpr double kRadius = 0.3;
  Profile profile;
  profile.body = Body::rail;
  for (int i = -60; i <= 60; ++i) {
    const double y = 0.5e-3 * i;
    profile.y.push_back(y);
    profile.z.push_back(kRadius - std::sqrt(kRadius * kRadius - y * y));
  }
  return profile;
}

TEST(ReferenceLocus, OfAStraightRailToldInSlicesIsThatOfTheRail) {
  const StandardPair p;
  SliceSet slices;
  slices.body = Body::rail;
  for (int k = -6; k <= 6; ++k) {
    slices.u.push_back(0.02 * k);
    slices.profiles.push_back(crown());
  }
  const auto rail = create_surface({Body::rail, 0.0, crown(), {}}, "spline"),
             sliced = create_surface({Body::rail, 0.0, slices, {}}, "spline");
  ASSERT_FALSE(sliced->constant_profile());
  constexpr LocusRows rows{-0.02, 0.06e-3, 667, kLocusRadius};
  for (const double y : {-0.004, 0.0, 0.003})
    for (const double yaw : {0.0, 0.006, -0.01}) {
      auto pair = p.placed(y, yaw);
      pair.rail = rail.get();
      const ReferenceLocus prismatic(pair, rows);
      pair.rail = sliced.get();
      const ReferenceLocus variable(pair, rows);
      ASSERT_NEAR(variable.least(), prismatic.least(), 5e-7);
      const auto a = prismatic.at(prismatic.least() + 8e-5, -1.0, PenetrationWeight::squared, false),
                 b = variable.at(prismatic.least() + 8e-5, -1.0, PenetrationWeight::squared, false);
      ASSERT_EQ(a.patches.size(), b.patches.size());
      ASSERT_FALSE(a.patches.empty());
      for (std::size_t i = 0; i < a.patches.size(); ++i) {
        EXPECT_NEAR(a.patches[i].x, b.patches[i].x, 0.1e-3);
        EXPECT_NEAR(a.patches[i].y, b.patches[i].y, 0.2e-3);
        EXPECT_NEAR(a.patches[i].inclination, b.patches[i].inclination, 1e-3);
      }
    }
}

/// A crowned rail with a hump of some height ahead of the wheel.
std::shared_ptr<const Surface> with_hump(double height) {
  SliceSet slices;
  slices.body = Body::rail;
  for (int k = -48; k <= 48; ++k) {
    const double u = 2.5e-3 * k, from_top = (u - 40e-3) / 10e-3;
    slices.u.push_back(u);
    slices.profiles.push_back(crown());
    for (double& z : slices.profiles.back().z) z -= height * std::exp(-from_top * from_top);
  }
  return create_surface({Body::rail, 0.0, slices, {}}, "spline");
}

TEST(ReferenceLocus, WhereItIsWrongTheGridDecides) {
  const Heads heads;
  SearchSettings by_grid = settings();
  by_grid.grid_T.y0 = -0.02, by_grid.grid_T.ny = 667;
  SearchSettings by_locus = by_grid;
  by_locus.locus_rows = LocusRows{-0.02, 0.06e-3, 667, kLocusRadius};
  int agreed = 0, wrong = 0;
  for (double height = 0.0; height < 3.1e-3; height += 0.25e-3) {
    const auto rail = with_hump(height);
    for (const double yaw : {0.0, 0.003}) {
      const detection::BodyPair pair{
          rail.get(), heads.wheel.get(), {}, {{0.0, 0.0, -kLocusRadius}, rotation({0.0, yaw, 0.5})}};
      ContactSearch grid(pair, by_grid), locus(pair, by_locus);
      const double least = grid.least_gap();
      EXPECT_NEAR(locus.least_gap(), least, 3.1e-6) << height;
      // Deep enough for the humps that are not touched at once.
      for (const double depth : {5e-5, 4e-4, 5e-5}) {
        const auto a = grid.at(least + depth), b = locus.at(least + depth);
        EXPECT_EQ(a.patches.size(), b.patches.size()) << height << ' ' << yaw << ' ' << depth;
        ++(locus.wrong_locus() ? wrong : agreed);
        if (locus.wrong_locus()) {
          EXPECT_TRUE(locus.wrong_locus()->grid_decides);
          EXPECT_EQ(difference(a, b, 0.0), "");
        }
      }
    }
  }
  EXPECT_GT(agreed, 20);
  EXPECT_GT(wrong, 20);
}

TEST(ReferenceLocus, OnARollerMeetsTheWheelWhereTheSearchOnAGridDoes) {
  // Two bodies of revolution: contact of a yawed wheel lies nearer to the axle than on a rail, by the roller's share.
  const StandardPair p;
  constexpr double kRoller = 0.5;
  SurfaceSpec spec{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  spec.roller_radius = kRoller;
  const auto roller = create_surface(spec, "spline");
  for (const double yaw : {0.0, 0.01, -0.02}) {
    auto pair = p.placed(0.003, yaw);
    pair.rail = roller.get();
    pair.X_TR = Pose{};
    SearchSettings s = settings();
    ContactSearch grid(pair, s);
    s.locus_rows = kRows;
    s.locus_rows->roller_radius = kRoller;
    ContactSearch locus(pair, s);
    ASSERT_EQ(locus.method(), SearchMethod::locus);
    const double depth = grid.least_gap() + 8e-5;
    const auto a = grid.at(depth), b = locus.at(depth);
    ASSERT_EQ(a.patches.size(), b.patches.size());
    for (std::size_t i = 0; i < a.patches.size(); ++i) {
      EXPECT_NEAR(a.patches[i].x, b.patches[i].x, 0.2e-3) << yaw;
      EXPECT_NEAR(a.patches[i].y, b.patches[i].y, 0.2e-3) << yaw;
      EXPECT_NEAR(a.patches[i].extent.box.x_max, b.patches[i].extent.box.x_max, 0.4e-3) << yaw;
    }
  }
}

TEST(ReferenceLocus, NeedsARoundWheelAndIsNaNBesideTheRail) {
  const StandardPair p;
  SearchSettings s = settings();
  s.locus_rows = kRows;
  auto pair = p.placed(0.5, 0.0);
  ContactSearch beside(pair, s);
  EXPECT_TRUE(std::isnan(beside.least_gap()));
  EXPECT_TRUE(beside.at(0.0).patches.empty());
  const Bodies damaged = bodies_in("analytic");
  pair.wheel = damaged.wheels[0].get();
  EXPECT_THROW(ContactSearch(pair, s), Error);
}

}  // namespace
}  // namespace treadmark::testing
