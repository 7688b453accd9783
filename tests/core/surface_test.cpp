// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark {
namespace {

/// Heights that tell where they were asked for: z = x + 10 y of the plane, nothing for x < 0.
class Marked final : public Surface {
 public:
  std::string_view backend() const override { return "marked"; }
  Facing facing() const override { return Facing::up; }
  Box3 bounds() const override { return {}; }
  std::size_t memory_bytes() const override { return 0; }

 private:
  void do_heights(const PlaneGrid& p, const HeightsOut& out) const override {
    for (int iy = 0; iy < p.grid.ny; ++iy)
      for (int ix = 0; ix < p.grid.nx; ++ix) {
        const double x = p.grid.x(ix), y = p.grid.y(iy);
        if (!out.z.empty())
          out.z[p.grid.index(ix, iy)] = x < 0.0 ? std::numeric_limits<double>::quiet_NaN() : x + 10.0 * y;
      }
  }
  void do_locate(const Pose&, std::span<const Vec2>, std::span<SurfacePoint>) const override {}
  HeightBounds do_height_bounds(const Pose&, const Rectangle&) const override { return {}; }
};

/// A level plane at z = height^2, by its height.
class Level final : public Surface {
 public:
  explicit Level(double height) : height_(height) {}
  std::string_view backend() const override { return "level"; }
  Facing facing() const override { return Facing::up; }
  Box3 bounds() const override { return {}; }
  std::size_t memory_bytes() const override { return 0; }
  std::vector<ShapeParameter> parameters() const override { return {{"height", "m", 1e-4}}; }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t, double amount) const override {
    return std::make_shared<Level>(height_ + amount);
  }
  void do_heights(const PlaneGrid&, const HeightsOut& out) const override {
    for (double& z : out.z) z = height_ * height_;
  }
  void do_locate(const Pose&, std::span<const Vec2>, std::span<SurfacePoint>) const override {}
  HeightBounds do_height_bounds(const Pose&, const Rectangle&) const override { return {}; }

  double height_;
};

TEST(SurfaceContract, DerivativesAreDifferencesWhereASurfaceKnowsNoBetterAndSayIt) {
  const Level surface(0.3);
  const PlaneGrid grid{{}, {0.0, 0.0, 1.0, 1.0, 2, 2}};
  std::vector<double> by(4);
  EXPECT_EQ(surface.heights_by(0, grid, by), HeightsBy::differences);
  for (const double one : by) EXPECT_NEAR(one, 0.6, 1e-10);
  EXPECT_THROW(surface.heights_by(1, grid, by), Error);
  EXPECT_THROW(Marked().changed(0, 1.0), Error);
  by.resize(3);
  EXPECT_THROW(surface.heights_by(0, grid, by), Error);
}

TEST(SurfaceContract, PulledBackWeightsAreSumsOfDerivatives) {
  const Level surface(0.3);
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 2.0}, {3.0, 1.0}};
  const std::vector<double> weights{2.0, 0.0, -5.0};
  std::vector<double> by{7.0};
  EXPECT_EQ(surface.pull_back({}, points, weights, by), HeightsBy::differences);
  EXPECT_NEAR(by[0], 7.0 - 3.0 * 0.6, 1e-9) << "added";
  EXPECT_THROW(surface.pull_back({}, points, {weights.data(), 2}, by), Error);
  by.resize(2);
  EXPECT_THROW(surface.pull_back({}, points, weights, by), Error);
}

TEST(Grid, RunsRowByRow) {
  const Grid2 g{1.0, 2.0, 0.1, 0.2, 3, 4};
  EXPECT_EQ(g.size(), 12u);
  EXPECT_EQ(g.index(0, 0), 0u);
  EXPECT_EQ(g.index(2, 0), 2u);
  EXPECT_EQ(g.index(0, 1), 3u);
  EXPECT_EQ(g.index(2, 3), 11u);
  EXPECT_NEAR(g.x(2), 1.2, 1e-15);
  EXPECT_NEAR(g.y(3), 2.6, 1e-15);
  EXPECT_NEAR(g.cell_area(), 0.02, 1e-15);
}

TEST(SurfaceContract, HeightAtIsAGridOfOnePoint) {
  EXPECT_NEAR(height_at(Marked(), {}, {0.3, 0.2}), 2.3, 1e-15);
  EXPECT_TRUE(std::isnan(height_at(Marked(), {}, {-0.3, 0.2})));
}

TEST(SurfaceContract, NothingThereIsNeverPenetration) {
  const double nothing = height_at(Marked(), {}, {-1.0, 0.0});
  EXPECT_FALSE(nothing - 1.0 < 0.0);
  EXPECT_FALSE(1.0 - nothing < 0.0);
}

TEST(SurfaceContract, RefusesWrongSizes) {
  const Marked surface;
  std::vector<double> z(6);
  const PlaneGrid good{{}, {0.0, 0.0, 0.1, 0.1, 3, 2}};
  EXPECT_NO_THROW(surface.heights(good, {z, {}, {}}));
  EXPECT_NO_THROW(surface.heights(good, {}));
  z.resize(5);
  EXPECT_THROW(surface.heights(good, {z, {}, {}}), Error);
  EXPECT_THROW(surface.heights(good, {{}, z, {}}), Error);
  EXPECT_THROW(surface.heights(good, {{}, {}, z}), Error);
  for (const Grid2& bad : {Grid2{0, 0, 0.1, 0.1, 0, 2}, Grid2{0, 0, 0.1, 0.1, 2, -1}, Grid2{0, 0, 0.0, 0.1, 2, 2},
                           Grid2{0, 0, 0.1, std::nan(""), 2, 2}})
    EXPECT_THROW(surface.heights({{}, bad}, {}), Error);
  const std::vector<Vec2> points(2);
  std::vector<SurfacePoint> located(3);
  EXPECT_THROW(surface.locate({}, points, located), Error);
  EXPECT_THROW(surface.height_bounds({}, Rectangle{1.0, 0.0, 0.0, 1.0}), Error);
  EXPECT_THROW(surface.height_bounds({}, Rectangle{0.0, 1.0, 0.0, std::nan("")}), Error);
  std::vector<HeightBounds> bounds(6);
  EXPECT_NO_THROW(surface.height_bounds({}, {{0.0, 1.0, 0.0, 1.0}, 1.0, 1.0, 3, 2}, bounds));
  EXPECT_THROW(surface.height_bounds({}, {{0.0, 1.0, 0.0, 1.0}, 1.0, 1.0, 2, 2}, bounds), Error);
  EXPECT_THROW(surface.height_bounds({}, {{0.0, 1.0, 0.0, 1.0}, 0.0, 1.0, 3, 2}, bounds), Error);
  EXPECT_THROW(surface.height_bounds({}, {{1.0, 0.0, 0.0, 1.0}, 1.0, 1.0, 3, 2}, bounds), Error);
}

}  // namespace
}  // namespace treadmark
