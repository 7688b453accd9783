// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// How the contact reference follows from heights, against searches on surfaces that are changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/detection/contact_search.hpp"

namespace treadmark::detection {
namespace {

struct Bodies {
  std::shared_ptr<const Surface> rail, wheel;

  BodyPair pair() const {
    constexpr double kRadius = 0.46, kDeep = 0.1e-3;
    BodyPair out;
    out.rail = rail.get(), out.wheel = wheel.get();
    out.X_TW = {{0.0, 2e-3, kDeep - kRadius}, rotation_x(0.02) * rotation_z(0.03)};
    return out;
  }
};

SearchResult found_at(const Bodies& bodies, const SearchSettings& settings) {
  return ContactSearch(bodies.pair(), settings).at(0.0);
}

/// Of x, y and the inclination by a parameter of one of both surfaces.
std::vector<double> pulled(const Surface& surface, const Pose& X_TS, const std::vector<ReferenceChange::Place>& places,
                           std::size_t number) {
  std::vector<Vec2> points;
  std::vector<double> weights;
  for (const ReferenceChange::Place& place : places) points.push_back(place.at_T), weights.push_back(place.by[number]);
  std::vector<double> by(surface.parameter_count(), 0.0);
  surface.pull_back(X_TS.inverse(), points, weights, by);
  return by;
}

TEST(ReferenceChange, IsThatOfSearchesOnChangedSurfaces) {
  ArcChain crowned{-0.03, 1.0e-3, -0.08, {{0.02, 3.0}, {0.02, 1.0 / 0.3}, {0.02, 4.0}}};
  const Bodies bodies{analytic::make_prismatic_surface(crowned),
                      analytic::make_revolved_surface(analytic::barrel_chain(-2.0, -0.02), 0.46)};
  for (const SearchMethod method : {SearchMethod::locus, SearchMethod::pruned_grid})
    for (const PenetrationWeight weight : {PenetrationWeight::squared, PenetrationWeight::linear}) {
      SearchSettings settings;
      settings.grid_T = {-0.04, -0.025, 1e-3, 5e-4, 81, 101};
      settings.refined_points = 100;
      settings.method = method, settings.weight = weight;
      const BodyPair pair = bodies.pair();
      ContactSearch search(pair, settings);
      const SearchResult at = search.at(0.0);
      ASSERT_EQ(at.patches.size(), 1u);
      const std::optional<ReferenceChange> change = search.reference_change(0.0, at.patches[0]);
      ASSERT_TRUE(change);
      for (const bool rail : {true, false}) {
        const Surface& surface = rail ? *bodies.rail : *bodies.wheel;
        const std::vector<ShapeParameter> all = surface.parameters();
        for (std::size_t number = 0; number < 3; ++number) {
          const std::vector<double> by =
              pulled(surface, rail ? pair.X_TR : pair.X_TW, rail ? change->rail : change->wheel, number);
          double largest = 0.0;
          for (std::size_t k = 0; k < all.size(); ++k) largest = std::max(largest, std::abs(by[k]) * all[k].step);
          for (std::size_t k = 0; k < all.size(); ++k) {
            const auto with = [&](double amount) {
              Bodies changed = bodies;
              (rail ? changed.rail : changed.wheel) = surface.changed(k, amount);
              const ContactPatch patch = found_at(changed, settings).patches.at(0);
              return number == 0 ? patch.x : number == 1 ? patch.y : patch.inclination;
            };
            // points of a grid come into the interpenetration and leave it: the shorter a step, the fewer, until
            // rounding is seen; outlines are interpolated
            constexpr double kSame = 2e-4, kRounding = 1e-16;
            double least = kInfinity;
            for (const double part : {1.0, 0.3, 0.1, 0.03}) {
              const double step = part * all[k].step;
              const double off = std::abs(by[k] - (with(step) - with(-step)) / (2.0 * step));
              least = std::min(least, off - kRounding / step);
            }
            EXPECT_LT(least, kSame * largest / all[k].step)
                << all[k].name << ' ' << number << (method == SearchMethod::locus ? " locus" : " grid");
          }
        }
      }
    }
}

TEST(ReferenceChange, IsNotKnownOfTheDeepestPoint) {
  const Bodies bodies{analytic::make_prismatic_surface(analytic::cylinder_chain(0.3, 0.1)),
                      analytic::make_revolved_surface(analytic::straight_chain(0.03), 0.46)};
  SearchSettings settings;
  settings.grid_T = {-0.04, -0.025, 1e-3, 5e-4, 81, 101};
  settings.reference_at_deepest = true;
  const BodyPair pair = bodies.pair();
  ContactSearch search(pair, settings);
  const SearchResult at = search.at(0.0);
  ASSERT_FALSE(at.patches.empty());
  EXPECT_FALSE(search.reference_change(0.0, at.patches[0]));
}

}  // namespace
}  // namespace treadmark::detection
