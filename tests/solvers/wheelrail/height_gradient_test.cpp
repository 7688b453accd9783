// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Derivatives by all that surfaces follow from, backwards: against central differences of whole solutions, against what
// moves as a whole, and against those by one parameter after the other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/pair_step.hpp"
#include "treadmark/solvers/wheelrail/rail_memory.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

using ::testing::HasSubstr;

constexpr double kSolvedTo = 1e-11;    ///< accuracy of solutions that are differenced
constexpr double kOpenPart = 5e-11;    ///< of a number, by that and rounding of heights
constexpr double kSameAsWhole = 1e-5;  ///< of the largest derivative of a number
constexpr double kOtherPoints = 1e-3;  ///< the same, where the detector looks at points laid out from other ends

struct Told {
  const char* name;
  double usual;  ///< size, where that is more than the number has
  double (*of)(const PairSolution&);
};
constexpr std::array<Told, 9> kTold{{
    {"pmax", 0.0, [](const PairSolution& s) { return s.patches[0].contact.max_pressure; }},
    {"approach", 0.0, [](const PairSolution& s) { return s.patches[0].contact.approach; }},
    {"z", 1e-4, [](const PairSolution& s) { return s.z; }},
    {"fx", 1e4, [](const PairSolution& s) { return s.load.track.force.x(); }},
    {"fy", 1e4, [](const PairSolution& s) { return s.load.track.force.y(); }},
    {"power", 0.0, [](const PairSolution& s) { return s.patches[0].contact.frictional_power; }},
    {"angle", 0.1, [](const PairSolution& s) { return s.patches[0].frame.angle; }},
    {"y", 1e-2, [](const PairSolution& s) { return s.patches[0].frame.X_TC.origin.y(); }},
    {"xi", 1e-3, [](const PairSolution& s) { return s.patches[0].kinematics.xi; }},
}};

void tell(const PairSolution& s, std::span<double> values) {
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = kTold[n].of(s);
}

bool on_the_same_elements(const PairSolution& a, const PairSolution& b) {
  if (a.status != Status::ok || b.status != Status::ok || a.patches.size() != b.patches.size()) return false;
  const PatchSolution &p = a.patches[0], &q = b.patches[0];
  const auto highest = [](const auto& field) { return std::max_element(field.begin(), field.end()) - field.begin(); };
  const auto least = [](const auto& field) { return std::min_element(field.begin(), field.end()) - field.begin(); };
  return p.grid == q.grid && p.contact.state == q.contact.state && least(p.distance) == least(q.distance) &&
         highest(p.contact.pressure) == highest(q.contact.pressure);
}

std::shared_ptr<const Surface>& body_of(Geometry& geometry, Facing facing) {
  return facing == Facing::up ? geometry.rail : geometry.wheel;
}

/// Whether a section grows or shrinks at its ends.
bool moves_ends(const Surface& surface, std::size_t parameter, double step) {
  constexpr Rectangle kAll{-1.0, 1.0, -1.0, 1.0};
  const auto low = [&](const Surface& one) { return one.height_bounds(Pose{}, kAll).z_max; };
  return low(surface) != low(*surface.changed(parameter, step));
}

/// By those parameters of a surface on which the largest pressure depends most, steps so many of theirs; of so many of
/// kTold.
void expect_whole_slopes(Geometry geometry, Problem problem, Facing facing, std::size_t most, double steps,
                         double same = kSameAsWhole, HeightsBy how = HeightsBy::exact,
                         std::size_t numbers = kTold.size()) {
  problem.solver.eps = kSolvedTo;
  problem.discretisation.max_elements = 0;
  Pair pair(geometry);
  const PairSolution s = pair.solve(problem);
  ASSERT_EQ(s.status, Status::ok) << s.message;
  ASSERT_EQ(s.patches.size(), 1u);
  const std::vector<HeightGradient> found = pair.height_gradients(problem, s, numbers, tell);
  const std::shared_ptr<const Surface> surface = body_of(geometry, facing);
  const std::vector<ShapeParameter> all = surface->parameters();
  std::vector<ShapeGradient> by;
  for (const HeightGradient& one : found) {
    ASSERT_EQ(one.report.status, Status::ok) << one.report.message;
    by.push_back(pulled_back(*surface, facing == Facing::up ? one.rail : one.wheel));
    EXPECT_EQ(by.back().heights, how);
    ASSERT_EQ(by.back().by.size(), all.size());
  }
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(by[0].by[a]) * all[a].step > std::abs(by[0].by[b]) * all[b].step;
  });
  order.resize(std::min(most, order.size()));
  struct Compared {
    std::size_t parameter;
    double step;
    bool moves_ends;
    std::array<double, kTold.size()> slopes;
  };
  std::vector<Compared> compared;
  for (const std::size_t k : order) {
    double step = steps * all[k].step;
    std::vector<PairSolution> beside;
    constexpr double kLeast = 0.02;
    const auto same_elements = [&] {
      return beside.size() == 4 && std::all_of(beside.begin(), beside.end(),
                                               [&](const PairSolution& t) { return on_the_same_elements(s, t); });
    };
    for (; step > kLeast * steps * all[k].step && !same_elements(); step *= 0.5) {
      beside.clear();
      for (const double amount : {step, -step, 0.5 * step, -0.5 * step}) {
        Geometry changed = geometry;
        body_of(changed, facing) = surface->changed(k, amount);
        beside.push_back(Pair(changed).solve(problem));
      }
    }
    step *= 2.0;
    ASSERT_TRUE(same_elements()) << all[k].name;
    Compared& one = compared.emplace_back(Compared{k, step, moves_ends(*surface, k, step), {}});
    for (std::size_t n = 0; n < numbers; ++n) {  // what is left over of third derivatives goes out
      const auto slope = [&](std::size_t i, double length) {
        return (kTold[n].of(beside[i]) - kTold[n].of(beside[i + 1])) / (2.0 * length);
      };
      one.slopes[n] = (4.0 * slope(2, 0.5 * step) - slope(0, step)) / 3.0;
    }
  }
  for (std::size_t n = 0; n < numbers; ++n) {
    double largest = 0.0;
    for (const Compared& one : compared) largest = std::max(largest, std::abs(one.slopes[n]) * all[one.parameter].step);
    const double size = std::max(std::abs(kTold[n].of(s)), kTold[n].usual);
    for (const Compared& one : compared)
      EXPECT_NEAR(by[n].by[one.parameter], one.slopes[n],
                  (same + (one.moves_ends ? kOtherPoints : 0.0)) * largest / all[one.parameter].step +
                      kOpenPart * size / one.step)
          << kTold[n].name << " by " << all[one.parameter].name;
  }
}

Geometry on_a_measured_rail() {
  Geometry geometry = standard_geometry();
  geometry.rail = spline::make_profile_surface(spline::testing::rail_head(), 0.0);
  return geometry;
}

TEST(HeightGradient, ByPointsOfAMeasuredRailIsThatOfWholeSolutions) {
  expect_whole_slopes(on_a_measured_rail(), standard_problem(), Facing::up, 4, 20.0);
}

TEST(HeightGradient, ByPiecesOfAFormulaIsThatOfWholeSolutions) {
  // outlines of the interpenetration are interpolated
  expect_whole_slopes(standard_geometry(), standard_problem(), Facing::down, 3, 50.0, 3.0 * kSameAsWhole);
  expect_whole_slopes(standard_geometry(), standard_problem(), Facing::up, 3, 50.0, 3.0 * kSameAsWhole,
                      HeightsBy::differences);
}

/// A crown with a squat under a wheel of the standard, in a representation.
Geometry on_a_squat(const Representation& wanted) {
  SurfaceSpec spec;
  spec.shape = analytic::cylinder_chain(0.15, 0.2);
  Squat squat;
  squat.length = 50e-3, squat.width = 30e-3, squat.depth = 0.1e-3, squat.x_center = 6e-3;
  spec.defects.squats = {squat};
  Geometry geometry = standard_geometry();
  geometry.rail = represent(create_natural(spec), wanted).surface;
  geometry.prismatic_rail = false;
  return geometry;
}
Problem squat_problem() {
  Problem p = standard_problem();
  p.track.gauge_based = false;
  p.track.rail_y0 = 0.7635;
  p.track.cant = 0.0;
  return p;
}
const Region kAboutTheSquat{-0.12, 0.12};

TEST(HeightGradient, ByADefectIsThatOfWholeSolutions) {
  expect_whole_slopes(on_a_squat({}), squat_problem(), Facing::up, 3, 10.0, 3.0 * kSameAsWhole, HeightsBy::differences);
}

TEST(HeightGradient, ByNodesOfOffsetsIsThatOfWholeSolutions) {
  // arcs of the base are differenced, nodes are not
  expect_whole_slopes(on_a_squat({"offset", 1e-3, kAboutTheSquat}), squat_problem(), Facing::up, 3, 20.0, kSameAsWhole,
                      HeightsBy::differences);
}

TEST(HeightGradient, ByVerticesOfAMeshIsThatOfWholeSolutions) {
  constexpr double kSinglePrecision = 5e-3;  // fits are kept in single precision
  // each vertex near the contact takes milliseconds: few of them, and one number
  expect_whole_slopes(on_a_squat({"mesh", 2e-3, kAboutTheSquat}), squat_problem(), Facing::up, 2, 25.0,
                      kSinglePrecision, HeightsBy::differences, 1);
}

/// All points of a profile up by the same is the rail up, which a rail that is held by its top and gauge does not
/// notice.
TEST(HeightGradient, OfAHeightThatIsTheSameEverywhere) {
  const Geometry geometry = on_a_measured_rail();
  Pair pair(geometry);
  const auto sums = [&](const Problem& problem, std::vector<double>* sizes) {
    const PairSolution s = pair.solve(problem);
    std::vector<double> out;
    for (const HeightGradient& one : pair.height_gradients(problem, s, kTold.size(), tell)) {
      EXPECT_EQ(one.report.status, Status::ok) << one.report.message;
      const std::vector<double> by = pulled_back(*geometry.rail, one.rail).by;
      out.push_back(std::accumulate(by.begin(), by.end(), 0.0));
      if (sizes == nullptr) continue;
      sizes->push_back(0.0);
      for (const double each : by) sizes->back() += std::abs(each);
    }
    return out;
  };
  Problem placed = squat_problem();
  const std::vector<double> found = sums(placed, nullptr);
  const PairSolution s = pair.solve(placed);
  const PairParameter down{[](double by, Problem& p, Geometry&) { p.track.dz += by; }};
  const PairNeighbours whole = pair.neighbours(placed, s, {&down, 1}).at(0);
  for (std::size_t n = 0; n < kTold.size(); ++n) {
    const double size = std::max(std::abs(kTold[n].of(s)), kTold[n].usual) / 1e-2;
    EXPECT_NEAR(found[n], whole.derivative(kTold[n].of), 1e-5 * size) << kTold[n].name;
  }
  EXPECT_NEAR(found[2], 1.0, 1e-5) << "the wheel follows";

  std::vector<double> sizes;
  const std::vector<double> held = sums(standard_problem(), &sizes);
  for (std::size_t n = 0; n < kTold.size(); ++n) EXPECT_NEAR(held[n], 0.0, 1e-5 * sizes[n]) << kTold[n].name;
}

/// The same as what one parameter after the other gives, also of the wheel and at a height.
TEST(HeightGradient, IsThatOfNeighbours) {
  Geometry geometry = on_a_measured_rail();
  const auto tread = [](double y) { return -y / 40.0 + 0.5 * y * y; };
  geometry.wheel = spline::make_profile_surface(spline::testing::graph_profile(Body::wheel, 55e-3, -40e-3, 120, tread),
                                                kStandardRadius);
  Pair pair(geometry);
  Problem problem = standard_problem();
  problem.wheelset.tape_line = 2e-3;
  for (const bool balanced : {true, false}) {
    if (!balanced) problem.state.position.z = pair.solve(problem).z, problem.vertical_force.reset();
    const PairSolution s = pair.solve(problem);
    ASSERT_EQ(s.status, Status::ok) << s.message;
    ASSERT_EQ(s.patches.size(), 1u);
    const std::vector<HeightGradient> found = pair.height_gradients(problem, s, kTold.size(), tell);
    for (const Facing facing : {Facing::up, Facing::down}) {
      const Surface& surface = *body_of(geometry, facing);
      std::vector<PairParameter> parameters(surface.parameter_count());
      for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k].shape_of = facing, parameters[k].shape = k;
      const std::vector<PairNeighbours> each = pair.neighbours(problem, s, parameters);
      for (std::size_t n = 0; n < kTold.size(); ++n) {
        const std::vector<double> by = pulled_back(surface, facing == Facing::up ? found[n].rail : found[n].wheel).by;
        double largest = 0.0;
        for (const double one : by) largest = std::max(largest, std::abs(one));
        constexpr double kForwards = 1e-4;  // where planes lie is differenced over some ten picometres there
        for (std::size_t k = 0; k < by.size(); ++k)
          EXPECT_NEAR(by[k], each[k].derivative(kTold[n].of), kForwards * largest) << kTold[n].name << ' ' << k;
      }
    }
  }
}

TEST(HeightGradient, OfTheLeftIsTheMirrorImageAndOfAnyThreadsTheSameToTheLastBit) {
  const Geometry geometry = on_a_measured_rail();
  const Problem right = standard_problem(), left = mirrored(right);
  const auto found = [&](const Problem& problem, int threads) {
    const ThreadLimit limit(threads);
    Pair pair(geometry);
    const PairSolution s = pair.solve(problem);
    return std::pair{s, pair.height_gradients(problem, s, kTold.size(), tell)};
  };
  const auto [s, one] = found(right, 1);
  const auto [t, many] = found(right, 4);
  const auto [u, mirror] = found(left, 1);
  for (std::size_t n = 0; n < kTold.size(); ++n) {
    const std::string name = kTold[n].name;
    const double sign = name == "fy" || name == "angle" || name == "y" ? -1.0 : 1.0;
    std::vector<double> by = pulled_back(*geometry.rail, one[n].rail).by;
    EXPECT_EQ(pulled_back(*geometry.rail, many[n].rail).by, by) << name;
    for (double& each : by) each *= sign;
    EXPECT_EQ(pulled_back(*geometry.rail, mirror[n].rail).by, by) << name;
    std::vector<double> field = mirror[n].wheel_field[0];
    reverse_rows(field, u.patches[0].grid);
    for (double& each : field) each *= sign;
    EXPECT_EQ(field, one[n].wheel_field[0]) << name;
  }
}

TEST(HeightGradient, OfAReferenceIsTheSameWhateverWasAskedBefore) {
  const Geometry geometry = standard_geometry();
  const Problem problem = standard_problem();
  const PairSolution s = Pair(geometry).solve(problem);
  detection::BodyPair bodies;
  bodies.rail = geometry.rail.get(), bodies.wheel = geometry.wheel.get();
  bodies.wheel_profile = detection::whole_profile(*geometry.wheel);
  const auto with_step = [&](const auto& ask) {
    RailMemory memory(*geometry.rail);
    std::vector<kalker::ContactSolver> none;
    PhaseTimes times;
    const Instant before;
    PairStep step(geometry, problem, before, none, none, times, bodies, memory);
    EXPECT_TRUE(step.place(0.0));
    return ask(step);
  };
  const auto region = with_step([&](PairStep& p) { return p.lay(s.z, s.patches).at(0).region; });
  const auto count = [&](bool looked) {
    return with_step([&](PairStep& p) {
      if (looked) p.lay(s.z, s.patches);
      return p.reference_change(s.z, region).value().wheel.size();
    });
  };
  EXPECT_EQ(count(true), count(false));
}

/// However many parameters there are: of a pressure under a load three linear systems.
TEST(HeightGradient, CostsALinearSystemForEachNumberAndTwoForTheBalance) {
  const Problem problem = standard_problem();
  Pair pair(on_a_measured_rail());
  const PairSolution s = pair.solve(problem);
  const HeightGradient found = pair.height_gradients(problem, s, 1, tell).at(0);
  kalker::ContactProblem patch = contact_problem_of(problem, s.patches.at(0));
  patch.sub_patches.count = static_cast<int>(s.patches[0].region.parts.size());
  int iterations = 0;
  for (const kalker::Quantity q :
       {kalker::Quantity::force_n, kalker::Quantity::max_pressure, kalker::Quantity::force_y})
    iterations += kalker::ContactSolver().gradient(patch, s.patches[0].contact, q).report.iterations;
  EXPECT_GT(found.report.iterations, 0);
  EXPECT_LE(found.report.iterations, iterations);
}

TEST(HeightGradient, SaysWhatItDoesNotKnow) {
  Problem problem = standard_problem();
  Pair pair(standard_geometry());
  const PairSolution s = pair.solve(problem);
  const HeightGradient arc =
      pair.height_gradients(problem, s, 1,
                            [](const PairSolution& t, std::span<double> v) { v[0] = t.patches[0].reference_s; })
          .at(0);
  EXPECT_EQ(arc.report.status, Status::failed);
  EXPECT_THAT(arc.report.message, HasSubstr("arc lengths"));
  problem.discretisation.reference_at_deepest = true;
  const PairSolution deepest = pair.solve(problem);
  const HeightGradient unknown = pair.height_gradients(problem, deepest, 1, tell).at(0);
  EXPECT_EQ(unknown.report.status, Status::failed);
  EXPECT_THAT(unknown.report.message, HasSubstr("detector"));
  EXPECT_THROW(pair.height_gradients(problem, {}, 1, tell), Error);
}

}  // namespace
}  // namespace treadmark::wheelrail
