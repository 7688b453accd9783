// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/pair_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"
#include "treadmark/tests/solvers/wheelrail/two_crowns.hpp"

namespace treadmark::wheelrail {
namespace {

using kalker::Quantity;
using Of = PairQuantity::Of;
using Fields = std::vector<std::vector<double>>;

constexpr double kExact = 1e-12;          ///< of solutions that are differenced
constexpr double kSameDerivative = 1e-5;  ///< against central differences

/// Rolling on two crowns, of which one carries more.
Problem uneven_crowns() {
  Problem p = testing::crowns_problem();
  testing::group(p, testing::Grouping::apart);
  p.state.position.roll = 2e-4;
  p.state.velocity = {10.0, 0.01, 0.0, 0.0, 0.0, -10.0 / testing::kRadius * 0.9995};
  p.friction.kinetic = 0.3;
  p.discretisation.max_elements = 0;
  return p;
}

/// The normal problems of a solution's patches, solved again with other gaps; the wheel stays or comes to the vertical
/// force that it had.
class Again {
 public:
  Again(const Problem& p, const PairSolution& s) : solution_(s), balanced_(p.vertical_force.has_value()) {
    for (const PatchSolution& patch : s.patches) {
      kalker::ContactProblem& c = problems_.emplace_back();
      c.grid = patch.grid;
      c.material = p.material;
      c.force_prescribed = false;
      c.settings.eps = kExact;
      upright_.push_back(patch.load.track.force.z() / patch.contact.force_n);
      lowering_.push_back(patch.frame.X_TC.rotation(2, 2));
    }
    base_ = at({}, 0.0);
    force_ = vertical(base_);
  }

  struct Numbers {
    double dz = 0.0;
    std::vector<kalker::ContactSolution> patches;
  };
  Numbers with(const Fields& change, double length, double stiffness) {
    Fields moved = change;
    for (auto& field : moved)
      for (double& value : field) value *= length;
    Numbers out;
    out.patches = at(moved, 0.0);
    constexpr int kMost = 30;
    for (int i = 0; balanced_ && i < kMost; ++i) {
      const double lacking = force_ - vertical(out.patches);
      if (std::abs(lacking) <= 1e-13 * force_) break;
      out.dz += lacking / stiffness;
      out.patches = at(moved, out.dz);
    }
    return out;
  }
  double value(const Numbers& n, const PairQuantity& q) const {
    if (q.of == Of::height) return n.dz;
    if (q.of == Of::vertical_force) return vertical(n.patches);
    const kalker::ContactSolution& c = n.patches[q.patch];
    switch (q.number) {
      case Quantity::force_n:
        return c.force_n;
      case Quantity::approach:
        return c.approach;
      case Quantity::max_pressure:
        return c.max_pressure;
      case Quantity::middle_y:
        return c.moment_x / c.force_n;
      default:
        return std::nan("");
    }
  }
  bool same_contact(const Numbers& n) const {
    for (std::size_t k = 0; k < n.patches.size(); ++k) {
      const auto highest = [](const auto& p) { return std::max_element(p.begin(), p.end()) - p.begin(); };
      if (n.patches[k].state != base_[k].state || highest(n.patches[k].pressure) != highest(base_[k].pressure))
        return false;
    }
    return true;
  }

 private:
  std::vector<kalker::ContactSolution> at(const Fields& change, double dz) {
    std::vector<kalker::ContactSolution> out;
    for (std::size_t k = 0; k < problems_.size(); ++k) {
      std::vector<double> gap = solution_.patches[k].distance;
      for (std::size_t i = 0; k < change.size() && i < gap.size(); ++i) gap[i] += change[k][i];
      problems_[k].gap = gap;
      problems_[k].approach = solution_.patches[k].approach + lowering_[k] * dz;
      out.push_back(kalker::ContactSolver().solve(problems_[k]));
      problems_[k].gap = {};
    }
    return out;
  }
  double vertical(const std::vector<kalker::ContactSolution>& patches) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < patches.size(); ++k) sum += upright_[k] * patches[k].force_n;
    return sum;
  }

  const PairSolution& solution_;
  bool balanced_;
  std::vector<kalker::ContactProblem> problems_;
  std::vector<double> upright_, lowering_;
  std::vector<kalker::ContactSolution> base_;
  double force_ = 0.0;
};

void expect_differences(const Geometry& geometry, Problem problem, std::size_t patches) {
  problem.solver.eps = 1e-10;
  Pair pair(geometry);
  const PairSolution s = pair.solve(problem);
  ASSERT_EQ(s.status, Status::ok) << s.message;
  ASSERT_EQ(s.patches.size(), patches);
  const bool balanced = problem.vertical_force.has_value();
  Again again(problem, s);
  const double height = pair.gradient(problem, s, {Of::height}).by_load;
  std::vector<PairQuantity> quantities{{Of::height}, {Of::vertical_force}};
  for (std::size_t k = 0; k < patches; ++k)
    for (const Quantity number : {Quantity::force_n, Quantity::approach, Quantity::max_pressure, Quantity::middle_y})
      quantities.push_back({Of::patch, k, number});
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const PairQuantity& quantity : quantities) {
    const PairGradient g = pair.gradient(problem, s, quantity);
    ASSERT_EQ(g.report.status, Status::ok);
    for (int draw = 0; draw < 3; ++draw) {
      Fields direction;
      double expected = 0.0, size = 0.0;
      for (const auto& field : g.by_gap) {
        auto& d = direction.emplace_back();
        for (const double by : field) {
          d.push_back(uniform(generator));
          expected += by * d.back();
          size += std::abs(by * d.back());
        }
      }
      std::optional<double> difference;
      for (double step = 1e-7; step > 1e-10 && !difference; step *= 0.5) {
        const auto more = again.with(direction, step, 1.0 / height), less = again.with(direction, -step, 1.0 / height);
        if (again.same_contact(more) && again.same_contact(less))
          difference = (again.value(more, quantity) - again.value(less, quantity)) / (2.0 * step);
      }
      ASSERT_TRUE(difference);
      // what is given does not change, but for what the balance leaves
      const bool given = quantity.of == (balanced ? Of::vertical_force : Of::height) ||
                         (quantity.of == Of::patch && !balanced && quantity.number == Quantity::approach) ||
                         (quantity.of == Of::patch && balanced && patches == 1 && quantity.number == Quantity::force_n);
      const bool force = quantity.of == Of::vertical_force || quantity.number == Quantity::force_n;
      const double unit = force ? 1.0 / height : 1.0;  // of what moves by about as much as the gap
      const double tolerance = kSameDerivative * (given ? unit : size);
      EXPECT_NEAR(expected, *difference, tolerance)
          << static_cast<int>(quantity.of) << ' ' << quantity.patch << ' ' << static_cast<int>(quantity.number);
    }
  }
}

TEST(PairGradient, IsThatOfCentralDifferences) {
  Problem steep = standard_problem();
  expect_differences(standard_geometry(), steep, 1);
  expect_differences(testing::two_crowns(), uneven_crowns(), 2);
  Pair pair(testing::two_crowns());
  Problem at_height = uneven_crowns();
  at_height.state.position.z = pair.solve(at_height).z;
  at_height.vertical_force.reset();
  expect_differences(testing::two_crowns(), at_height, 2);
}

/// A rail that is moved down takes the wheel along, and nothing else changes.
TEST(PairGradient, OfAHeightOfTheWholeRail) {
  const Problem problem = uneven_crowns();
  Pair pair(testing::two_crowns());
  const PairSolution s = pair.solve(problem);
  ASSERT_EQ(s.patches.size(), 2u);
  const auto by_rail = [&](const PairQuantity& quantity) {
    const PairGradient g = pair.gradient(problem, s, quantity);
    double sum = 0.0;
    for (std::size_t k = 0; k < 2; ++k)
      for (const double by : g.by_gap[k]) sum += by * s.patches[k].frame.X_TC.rotation(2, 2);
    return sum;
  };
  constexpr double kRounding = 1e-6;
  EXPECT_NEAR(by_rail({Of::height}), 1.0, kRounding);
  for (std::size_t k = 0; k < 2; ++k) {
    const kalker::ContactSolution& c = s.patches[k].contact;
    EXPECT_NEAR(by_rail({Of::patch, k, Quantity::force_n}) * c.approach, 0.0, kRounding * c.force_n);
    EXPECT_NEAR(by_rail({Of::patch, k, Quantity::max_pressure}) * c.approach, 0.0, kRounding * c.max_pressure);
  }
}

/// A larger wheel touches along a longer patch: through search, tangent plane and balance. Elements that enter and
/// leave make steps of what is differenced.
TEST(PairGradient, OfTheWheelsRadiusIsThatOfWholeSolutions) {
  constexpr double kStep = 0.05, kElements = 0.03;
  const auto wheel = [](double radius) {
    Geometry g = standard_geometry();
    g.wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, radius);
    return g;
  };
  Problem problem = standard_problem();
  problem.discretisation.dx = problem.discretisation.ds = 0.25e-3;
  problem.discretisation.max_elements = 0;
  problem.state.velocity = {10.0, 0.0, 0.0, 0.0, 0.0, -10.0 / kStandardRadius};
  problem.state.position = {0.0, 1.5e-3, 0.0, 0.0, 0.0, 0.0};  // not rolled: the contact stays where it is
  const auto solved = [&](double radius) {
    Problem p = problem;
    p.wheelset.nominal_radius = radius;
    return Pair(wheel(radius)).solve(p);
  };
  problem.wheelset.nominal_radius = kStandardRadius;
  Pair pair(wheel(kStandardRadius));
  const PairSolution at = pair.solve(problem), more = solved(kStandardRadius + kStep),
                     less = solved(kStandardRadius - kStep);
  ASSERT_EQ(at.patches.size(), 1u);
  const PatchSolution& patch = at.patches[0];
  const PairGradient g = pair.gradient(problem, at, {Of::patch, 0, Quantity::max_pressure});
  double by_radius = 0.0;
  for (std::size_t i = 0; i < patch.grid.size(); ++i) {
    const double x = patch.grid.x(static_cast<int>(i) % patch.grid.nx);
    if (g.by_gap[0][i] != 0.0)
      by_radius -= g.by_gap[0][i] * 0.5 * x * x / (kStandardRadius * kStandardRadius) * patch.frame.X_TC.rotation(2, 2);
  }
  const double whole =
      (more.patches.at(0).contact.max_pressure - less.patches.at(0).contact.max_pressure) / (2.0 * kStep);
  EXPECT_LT(whole, 0.0);
  EXPECT_NEAR(by_radius, whole, kElements * std::abs(whole));
}

TEST(PairGradient, OfTheLeftIsTheMirrorImageToTheLastBit) {
  const Problem right = uneven_crowns(), left = mirrored(right);
  Pair pair(testing::two_crowns()), other(testing::two_crowns());
  const PairSolution s = pair.solve(right), t = other.solve(left);
  ASSERT_EQ(t.patches.size(), 2u);
  for (const Quantity number : {Quantity::max_pressure, Quantity::middle_y, Quantity::force_y}) {
    const PairGradient a = pair.gradient(right, s, {Of::patch, 1, number});
    PairGradient b = other.gradient(left, t, {Of::patch, 1, number});
    const double sign = number == Quantity::max_pressure ? 1.0 : -1.0;
    EXPECT_EQ(b.by_load, sign * a.by_load);
    for (std::size_t k = 0; k < 2; ++k) {
      reverse_rows(b.by_gap[k], t.patches[k].grid);
      for (double& value : b.by_gap[k]) value *= sign;
      EXPECT_EQ(b.by_gap[k], a.by_gap[k]) << k;
    }
  }
}

TEST(PairGradient, RefusesWhatItDoesNotHold) {
  const Problem problem = standard_problem();
  Pair pair(standard_geometry());
  const PairSolution s = pair.solve(problem);
  EXPECT_THROW(pair.gradient(problem, s, {Of::patch, 1}), Error);
  EXPECT_THROW(pair.gradient(problem, {}, {Of::height}), Error);
  Problem other = problem;
  other.rail_springs.emplace();
  EXPECT_THROW(pair.gradient(other, s, {Of::height}), Error);
  other = problem;
  other.longitudinal_force = 0.0;
  EXPECT_THROW(pair.gradient(other, s, {Of::height}), Error);
  other = problem;
  other.reference_surface = ReferenceSurface::curved;
  EXPECT_THROW(pair.gradient(other, s, {Of::height}), Error);
  other = problem;
  other.normal_model = kalker::NormalModel::kpec;
  EXPECT_THROW(pair.gradient(other, s, {Of::height}), Error);
}

}  // namespace
}  // namespace treadmark::wheelrail
