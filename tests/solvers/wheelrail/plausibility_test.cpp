// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/wheelrail/usual_values.hpp"
#include "treadmark/tests/solvers/wheelrail/round_groove.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"
#include "treadmark/tests/support/file_content.hpp"

namespace treadmark::wheelrail {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<RemarkKind> kinds(const PairSolution& s) {
  std::vector<RemarkKind> out;
  for (const Remark& r : s.remarks) out.push_back(r.kind);
  return out;
}

PairSolution solved(const Geometry& geometry, const Problem& p) { return Pair(geometry).solve(p); }

TEST(PairPlausibility, StandardProfilesAreWithoutDoubt) {
  for (const Side side : {Side::right, Side::left}) {
    Problem p = standard_problem();
    p.side = side;
    p.discretisation.dx = p.discretisation.ds = 0.4e-3;
    const PairSolution s = solved(standard_geometry(), p);
    EXPECT_EQ(s.status, Status::ok);
    for (const Remark& r : s.remarks) EXPECT_FALSE(r.grave()) << to_line(r);
  }
}

TEST(PairPlausibility, NoContactUnderALoad) {
  Problem p = standard_problem();
  p.state.position.y = 0.5;
  EXPECT_THAT(kinds(solved(standard_geometry(), p)), Contains(RemarkKind::no_contact_under_load));
  p.vertical_force.reset();
  p.state.position.y = 0.0;
  p.state.position.z = -1e-3;
  const PairSolution lifted = solved(standard_geometry(), p);
  EXPECT_EQ(lifted.status, Status::no_contact);
  EXPECT_THAT(lifted.remarks, IsEmpty()) << "it is lifted on purpose";
}

// A wheel in a groove of nearly its own radius touches over a wide arc, on which a plane cannot lie.
TEST(PairPlausibility, PlaneOnAStronglyCurvedPatch) {
  Problem p = testing::groove_problem(60e-6);
  p.reference_surface = ReferenceSurface::plane;
  p.discretisation.ds = 0.25e-3;
  const Geometry groove = testing::round_groove(10.1e-3);
  EXPECT_THAT(kinds(solved(groove, p)), Contains(RemarkKind::strongly_curved));
  p.reference_surface = ReferenceSurface::curved;
  const std::vector<RemarkKind> curved = kinds(solved(groove, p));
  EXPECT_THAT(curved, Not(Contains(RemarkKind::strongly_curved)));
  EXPECT_THAT(curved, Not(Contains(RemarkKind::curved)));
  p.reference_surface = ReferenceSurface::plane;
  EXPECT_THAT(kinds(solved(testing::round_groove(14e-3), testing::groove_problem(5e-6))),
              Not(Contains(RemarkKind::strongly_curved)));
}

TEST(PairPlausibility, DampingComesOnTopOfThePrescribedForce) {
  Problem p = standard_problem();
  p.damping = Damping{1e-5, 1e-5, 1e9, 1e9};
  Pair pair(standard_geometry());
  pair.solve(p);
  p.history = kalker::HistoryUse::keep_going;
  p.vertical_force = 9e4;
  const PairSolution s = pair.solve(p);
  ASSERT_EQ(s.status, Status::ok);
  EXPECT_GT(s.load.track.force.z(), 1.01 * 9e4);
  EXPECT_THAT(kinds(s), Contains(RemarkKind::force_differs));
  for (const Remark& r : s.remarks) EXPECT_FALSE(r.grave()) << to_line(r);
}

// Two places of the head carry about the same, now one, now the other is deeper.
TEST(PairPlausibility, KpecFindsThePrescribedForceAtEveryShift) {
  const auto lost = [](Conventions conventions) {
    Pair pair(standard_geometry());
    int count = 0;
    for (int i = 0; i < 100; ++i) {
      Problem p = standard_problem();
      p.vertical_force = 8e4;
      p.normal_model = kalker::NormalModel::kpec;
      p.tangential_model = kalker::TangentialModel::fastsim;
      p.discretisation.dx = p.discretisation.ds = 1e-3;
      p.solver.conventions = conventions;
      p.state.position = {0.0, 2.6e-3 * i / 100.0, 0.0, 0.0, 1e-3, 0.0};
      const PairSolution s = pair.solve(p);
      if (s.status != Status::ok || std::abs(s.load.track.force.z() - 8e4) > 1e-3 * 8e4) ++count;
    }
    return count;
  };
  EXPECT_EQ(lost(Conventions::treadmark), 0);
  EXPECT_GT(lost(Conventions::contact), 0) << "with the reference program's scale it jumps";
}

TEST(PairPlausibility, EnlargedElements) {
  Problem p = standard_problem();
  p.discretisation.max_elements = 100;
  EXPECT_THAT(kinds(solved(standard_geometry(), p)), Contains(RemarkKind::elements_enlarged));
}

/// A surface that ends at y_end of its own axes, or has a hole of 1 mm about (x, y) = (0, y_end).
class Torn final : public Surface {
 public:
  Torn(std::shared_ptr<const Surface> whole, double y_end, bool hole)
      : whole_(std::move(whole)), y_end_(y_end), hole_(hole) {}
  std::string_view backend() const override { return whole_->backend(); }
  Facing facing() const override { return whole_->facing(); }
  Box3 bounds() const override { return whole_->bounds(); }
  std::size_t memory_bytes() const override { return whole_->memory_bytes(); }

 private:
  bool missing(const Vec3& p) const { return hole_ ? std::hypot(p.x(), p.y() - y_end_) < 0.7e-3 : p.y() > y_end_; }
  void do_heights(const PlaneGrid& grid, const HeightsOut& out) const override {
    std::vector<double> z(grid.grid.size());
    whole_->heights(grid, {z, out.dzdx, out.dzdy});
    for (std::size_t i = 0; i < z.size(); ++i) {
      const int ix = static_cast<int>(i % static_cast<std::size_t>(grid.grid.nx)),
                iy = static_cast<int>(i / static_cast<std::size_t>(grid.grid.nx));
      if (!missing(grid.X_SP.apply({grid.grid.x(ix), grid.grid.y(iy), z[i]}))) continue;
      z[i] = kNaN;
      if (!out.dzdx.empty()) out.dzdx[i] = kNaN;
      if (!out.dzdy.empty()) out.dzdy[i] = kNaN;
    }
    if (!out.z.empty()) ranges::copy(z, out.z.begin());
  }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points, std::span<SurfacePoint> out) const override {
    whole_->locate(X_SP, points, out);
  }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& r) const override {
    return whole_->height_bounds(X_SP, r);
  }
  std::shared_ptr<const Surface> whole_;
  double y_end_;
  bool hole_;
};

PairSolution on_torn_rail(double y_of_tear, bool hole) {
  Geometry g = standard_geometry();
  g.rail = std::make_shared<Torn>(g.rail, y_of_tear, hole);
  g.prismatic_rail = false;
  Problem p = standard_problem();
  p.discretisation.dx = p.discretisation.ds = 0.4e-3;
  return solved(g, p);
}

TEST(PairPlausibility, SurfaceThatEndsInContactAndHoles) {
  const PairSolution whole = on_torn_rail(1.0, false);
  ASSERT_EQ(whole.status, Status::ok) << whole.message;
  EXPECT_THAT(kinds(whole), Not(Contains(RemarkKind::surface_ends_in_contact)));
  const double y = whole.patches.front().reference_rail.y();
  EXPECT_THAT(kinds(on_torn_rail(y + 2e-3, false)), Contains(RemarkKind::surface_ends_in_contact));
  EXPECT_THAT(kinds(on_torn_rail(y + 15e-3, false)), Not(Contains(RemarkKind::surface_ends_in_contact)));
  const PairSolution torn = on_torn_rail(y, true);
  EXPECT_THAT(kinds(torn), Contains(RemarkKind::hole_in_contact));
  EXPECT_EQ(torn.status, Status::failed);
  EXPECT_FALSE(torn.message.empty());
}

TEST(UsualValues, NumbersOfRailwaysAreWithoutDoubtOthersAreNamed) {
  const auto doubts = [](auto change) {
    Problem p = standard_problem();
    p.vertical_force = 1e5;
    change(p);
    std::vector<Remark> remarks;
    judge_values(p, remarks);
    std::string texts;
    for (const Remark& r : remarks) {
      EXPECT_EQ(r.kind, RemarkKind::unusual_value);
      EXPECT_TRUE(r.grave());
      texts += r.text + '\n';
    }
    return texts;
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(doubts([](Problem&) {}), "");
  for (const double radius : {0.1, 0.165, 0.33, 0.46, 0.625, 0.75})
    EXPECT_EQ(doubts([=](Problem& p) { p.wheelset.nominal_radius = radius; }), "") << radius;
  for (const double gauge : {0.6, 1.0, 1.435, 1.52, 1.676})
    EXPECT_EQ(doubts([=](Problem& p) {
                p.track.gauge_width = gauge;
                p.wheelset.flange_back_distance = gauge - 0.075;
              }),
              "")
        << gauge;
  for (const double y : {-0.017, 0.01}) EXPECT_EQ(doubts([=](Problem& p) { p.state.position.y = y; }), "") << y;
  EXPECT_THAT(doubts([](Problem& p) { p.wheelset.nominal_radius = 0.92; }), HasSubstr("920 mm, more than 750"));
  EXPECT_THAT(doubts([](Problem& p) { p.vertical_force = 100.0; }), HasSubstr("is it in kN?"));
  EXPECT_THAT(doubts([](Problem& p) { p.track.gauge_width = 1.0; }),
              HasSubstr("do wheelset and track belong together?"));
  EXPECT_THAT(doubts([](Problem& p) { p.state.position.y = -0.02; }), HasSubstr("has climbed"));
  EXPECT_THAT(doubts([](Problem& p) { p.track.dy = 0.02; }), HasSubstr("has climbed"));
  EXPECT_THAT(doubts([](Problem& p) { p.state.velocity.x = -300.0; }), HasSubstr("is it in km/h?"));
  EXPECT_THAT(doubts([](Problem& p) { p.state.position.yaw = -5.0; }), HasSubstr("is it in degrees?"));
  EXPECT_EQ(doubts([](Problem& p) {
              p.track.gauge_based = false;
              p.state.position.y = 1.0;
            }),
            "")
      << "absolute places have their own origin";
}

TEST(UsualValues, DocumentationHasTheirLimits) {
  treadmark::testing::expect_in_document("case-file.md", usual_value_table());
}

}  // namespace
}  // namespace treadmark::wheelrail
