// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The search that leaves out what cannot touch against the search that leaves out nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/search/scenes.hpp"

namespace treadmark::testing {
namespace {

using detection::ContactSearch;
using detection::SearchMethod;

class PrunedSearch : public ::testing::TestWithParam<std::string_view> {};

// Values at the points are the same but for rounding: heights may depend on how a grid is cut by 1e-12 m. An extent is
// where the gap is zero: at a grazing angle it moves by more than the gap does.
constexpr double kSame = 1e-9;

int configurations() {
  const char* wanted = std::getenv("TREADMARK_CONFIGURATIONS");
  return wanted ? std::atoi(wanted) : 1000;
}

TEST_P(PrunedSearch, EqualsFullSearchInRandomConfigurations) {
  const Bodies bodies = bodies_in(GetParam());
  std::mt19937 random(20'26'11);
  std::size_t evaluated = 0, points = 0;
  std::array<int, 4> with_patches{};
  int grazing = 0, unfaced = 0, searches = 0;
  for (int k = 0; k < configurations(); ++k) {
    const auto pair = random_pair(bodies, random);
    auto settings = random_settings(pair, random);
    settings.method = SearchMethod::full_grid;
    ContactSearch full(pair, settings);
    settings.method = SearchMethod::pruned_grid;
    ContactSearch pruned(pair, settings);
    const double least = full.least_gap();
    if (std::isnan(least)) {
      ++unfaced;
      ASSERT_TRUE(std::isnan(pruned.least_gap())) << "configuration " << k;
      ASSERT_TRUE(pruned.at(0.0).patches.empty());
      continue;
    }
    ASSERT_NEAR(pruned.least_gap(), least, 1e-11) << "configuration " << k;
    // From grazing to deep and back, as force iterations go.
    std::vector<double> depths{std::pow(10.0, std::uniform_real_distribution<double>(-5.0, -3.3)(random)), -2e-5, 1e-9,
                               std::uniform_real_distribution<double>(2e-5, 3e-4)(random)};
    ranges::shuffle(depths, random);
    depths.resize(2);
    for (const double depth : depths) {
      const auto expected = full.at(least + depth), found = pruned.at(least + depth);
      const std::string differs = difference(found, expected, kSame);
      ASSERT_EQ(differs, "") << "configuration " << k << ", " << depth << " m deep";
      ++with_patches[std::min<std::size_t>(3, expected.patches.size())];
      grazing += depth == 1e-9;
      ++searches;
    }
    evaluated += pruned.points_evaluated();
    points += settings.grid_T.size();
  }
  const auto at_least = [&](double share) { return static_cast<int>(share * searches); };
  // The configurations are what they are meant to be.
  EXPECT_GT(with_patches[0], at_least(0.02));
  EXPECT_GT(with_patches[1], at_least(0.2));
  EXPECT_GT(with_patches[2] + with_patches[3], at_least(0.02));
  EXPECT_GT(grazing, at_least(0.1));
  EXPECT_LT(unfaced, configurations() / 10);
  EXPECT_LT(static_cast<double>(evaluated), 0.6 * static_cast<double>(points));
  RecordProperty("evaluated", std::to_string(static_cast<double>(evaluated) / static_cast<double>(points)));
  RecordProperty("patches", std::to_string(with_patches[0]) + " " + std::to_string(with_patches[1]) + " " +
                                std::to_string(with_patches[2]) + " " + std::to_string(with_patches[3]));
}

detection::BodyPair touching(const Bodies& bodies) {
  detection::BodyPair pair{bodies.rails[0].get(), bodies.wheels[0].get(), {Vec3::Zero(), rotation_x(-0.025)}, {}};
  pair.X_TW = {{0.0, 6e-3, -0.46}, rotation({0.0, 0.005, 0.02})};  // the flange is clear of the rail
  return pair;
}

// So fine that the patch covers many tiles.
detection::SearchSettings over(double x_half, double y_half) {
  constexpr double kStepX = 0.2e-3, kStepY = 0.05e-3;
  detection::SearchSettings s;
  s.grid_T = {-x_half,
              -y_half,
              kStepX,
              kStepY,
              static_cast<int>(std::lround(2.0 * x_half / kStepX)) + 1,
              static_cast<int>(std::lround(2.0 * y_half / kStepY)) + 1};
  return s;
}

TEST_P(PrunedSearch, WorkFollowsThePatchAndNotTheWindow) {
  const Bodies bodies = bodies_in(GetParam());
  const auto pair = touching(bodies);
  const auto evaluated = [&](const detection::SearchSettings& settings) {
    ContactSearch search(pair, settings);
    const auto found = search.at(search.least_gap() + 1e-4);
    EXPECT_EQ(found.patches.size(), 1u);
    return static_cast<double>(search.points_evaluated());
  };
  const double once = evaluated(over(0.05, 0.036)), twice = evaluated(over(0.1, 0.036)),
               all = evaluated(over(0.1, 0.072));
  EXPECT_LT(twice, 1.1 * once);
  EXPECT_LT(all, 1.1 * twice);
  EXPECT_GT(once, 0.0);
}

TEST_P(PrunedSearch, ThreadsDoNotChangeABit) {
  const Bodies bodies = bodies_in(GetParam());
  const auto pair = touching(bodies);
  const auto found = [&](int threads) {
    const ThreadLimit limit(threads);
    ContactSearch search(pair, over(0.05, 0.02));
    return search.at(search.least_gap() + 1e-4);
  };
  EXPECT_EQ(difference(found(1), found(4), 0.0), "");
}

/// Those that make the same shapes; one section is searched in another way.
std::vector<std::string_view> same_shapes() {
  std::vector<std::string_view> names = backend_names();
  std::erase_if(names, [](std::string_view name) { return backend_of(name).one_place; });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Backends, PrunedSearch, ::testing::ValuesIn(same_shapes()), [](const auto& backend) {
  std::string name(backend.param);
  ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace treadmark::testing
