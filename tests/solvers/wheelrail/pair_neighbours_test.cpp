// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"
#include "treadmark/tests/solvers/wheelrail/two_crowns.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr double kSolved = 1e-11;     ///< accuracy of solutions that are differenced
constexpr double kSameSlope = 1e-5;   ///< against central differences of whole solutions
constexpr double kLeftOpen = 5e-11;   ///< of a number, by the accuracy of solutions and rounding of heights
constexpr double kZero = 3e-6;        ///< of a number's usual size within a parameter's usual range: nothing
constexpr double kLengthStep = 1e-6;  ///< of whole solutions [m]

/// A parameter, and over what whole solutions are differenced.
struct Tried {
  std::string name;
  double whole_step;
  PairParameter parameter;
  double range = 1e-2;  ///< over which numbers change by their usual sizes: a centimetre, a hundredth of a radian
};

template <class Place>
Tried of_problem(std::string name, double whole_step, double step, Place place) {
  return {std::move(name), whole_step, {[place](double by, Problem& p, Geometry&) { place(p) += by; }, step}, 1e-2};
}

/// Placement, motion, load and friction.
std::vector<Tried> tried_parameters(bool balanced) {
  constexpr double kLength = 5e-8, kAngle = 5e-8, kTurn = kLengthStep;
  std::vector<Tried> out{
      of_problem("y", kLengthStep, kLength, [](Problem& p) -> double& { return p.state.position.y; }),
      of_problem("roll", kTurn, kAngle, [](Problem& p) -> double& { return p.state.position.roll; }),
      of_problem("yaw", 10.0 * kTurn, kAngle, [](Problem& p) -> double& { return p.state.position.yaw; }),
      of_problem("cant", kTurn, kAngle, [](Problem& p) -> double& { return p.track.cant; }),
      of_problem("gauge", kLengthStep, kLength, [](Problem& p) -> double& { return p.track.gauge_width; }),
      of_problem("rail down", kLengthStep, kLength, [](Problem& p) -> double& { return p.track.dz; }),
      of_problem("flange back", kLengthStep, kLength,
                 [](Problem& p) -> double& { return p.wheelset.flange_back_position; }),
      of_problem("velocity aside", 1e-5, 1e-5, [](Problem& p) -> double& { return p.state.velocity.y; }),
      of_problem("pitch rate", 1e-5, 1e-5, [](Problem& p) -> double& { return p.state.velocity.pitch; }),
      of_problem("yaw rate", 1e-5, 1e-5, [](Problem& p) -> double& { return p.state.velocity.yaw; }),
      of_problem("friction", 1e-6, 1e-5, [](Problem& p) -> double& { return p.friction.kinetic; }),
  };
  out.push_back(balanced ? of_problem("load", 1.0, 1.0, [](Problem& p) -> double& { return *p.vertical_force; })
                         : of_problem("z", 2e-8, 1e-8, [](Problem& p) -> double& { return p.state.position.z; }));
  if (balanced) out.back().range = 1e5;  // [N]
  return out;
}

struct Number {
  std::string name;
  std::function<double(const PairSolution&)> of;
  double usual = 0.0;  ///< size, where that is more than the number has: of angles, creepages, spin, places, forces
};

std::vector<Number> numbers_of(std::size_t patches) {
  constexpr double kForce = 1e4, kMoment = 1e3, kSpinMoment = 1.0, kPlace = 1e-2, kAngle = 0.1;
  constexpr double kCreepage = 1e-3, kSpin = 0.1;
  std::vector<Number> out{
      {"z", [](const PairSolution& s) { return s.z; }, 1e-4},
      {"fx", [](const PairSolution& s) { return s.load.track.force.x(); }, kForce},
      {"fy", [](const PairSolution& s) { return s.load.track.force.y(); }, kForce},
      {"fz", [](const PairSolution& s) { return s.load.track.force.z(); }, kForce},
      {"mx", [](const PairSolution& s) { return s.load.track.moment.x(); }, kMoment},
      {"my on the wheelset", [](const PairSolution& s) { return s.load.wheelset.moment.y(); }, kMoment},
  };
  for (std::size_t k = 0; k < patches; ++k) {
    const auto add = [&](const char* name, double usual, auto of) {
      out.push_back({name + std::to_string(k), [k, of](const PairSolution& s) { return of(s.patches[k]); }, usual});
    };
    add("Fn ", kForce, [](const PatchSolution& p) { return p.contact.force_n; });
    add("Fx ", kForce, [](const PatchSolution& p) { return p.contact.force_x; });
    add("Fs ", kForce, [](const PatchSolution& p) { return p.contact.force_y; });
    add("Mn ", kSpinMoment, [](const PatchSolution& p) { return p.contact.moment_n; });
    add("pmax ", 0.0, [](const PatchSolution& p) { return p.contact.max_pressure; });
    add("approach ", 0.0, [](const PatchSolution& p) { return p.contact.approach; });
    add("energy ", 0.0, [](const PatchSolution& p) { return p.contact.elastic_energy; });
    add("power ", 0.0, [](const PatchSolution& p) { return p.contact.frictional_power; });
    add("angle ", kAngle, [](const PatchSolution& p) { return p.frame.angle; });
    add("y ", kPlace, [](const PatchSolution& p) { return p.frame.X_TC.origin.y(); });
    add("y of the wheel ", kPlace, [](const PatchSolution& p) { return p.reference_wheel.y(); });
    add("s of the rail ", kPlace, [](const PatchSolution& p) { return p.reference_s; });
    add("xi ", kCreepage, [](const PatchSolution& p) { return p.kinematics.xi; });
    add("eta ", kCreepage, [](const PatchSolution& p) { return p.kinematics.eta; });
    add("phi ", kSpin, [](const PatchSolution& p) { return p.kinematics.phi; });
  }
  return out;
}

bool same_elements(const PairSolution& a, const PairSolution& b) {
  const auto largest = [](const auto& field) { return std::max_element(field.begin(), field.end()) - field.begin(); };
  const auto least = [](const auto& field) { return std::min_element(field.begin(), field.end()) - field.begin(); };
  if (a.patches.size() != b.patches.size()) return false;
  for (std::size_t k = 0; k < a.patches.size(); ++k) {
    const PatchSolution &p = a.patches[k], &q = b.patches[k];
    if (!(p.grid == q.grid) || p.contact.state != q.contact.state || least(p.distance) != least(q.distance) ||
        largest(p.contact.pressure) != largest(q.contact.pressure))
      return false;
  }
  return true;
}

PairSolution solved_with(const Geometry& geometry, Problem problem, const Tried& tried, double by) {
  Geometry changed = geometry;
  if (tried.parameter.shape_of) {
    auto& surface = *tried.parameter.shape_of == Facing::up ? changed.rail : changed.wheel;
    surface = surface->changed(tried.parameter.shape, by);
  } else {
    tried.parameter.change(by, problem, changed);
  }
  return Pair(changed).solve(problem);
}

/// Of all numbers by all parameters, against central differences of whole solutions.
void expect_slopes(const Geometry& geometry, Problem problem, const std::vector<Tried>& tried,
                   std::size_t patches = 1) {
  problem.solver.eps = kSolved;
  problem.discretisation.max_elements = 0;
  Pair pair(geometry);
  const PairSolution s = pair.solve(problem);
  ASSERT_EQ(s.status, Status::ok) << s.message;
  ASSERT_EQ(s.patches.size(), patches);
  std::vector<PairParameter> parameters;
  for (const Tried& t : tried) parameters.push_back(t.parameter);
  const std::vector<PairNeighbours> found = pair.neighbours(problem, s, parameters);
  ASSERT_EQ(found.size(), tried.size());
  for (std::size_t i = 0; i < tried.size(); ++i) {
    ASSERT_EQ(found[i].report.status, Status::ok) << tried[i].name << found[i].report.message;
    // two steps, so that what is left over of third derivatives goes out
    double step = tried[i].whole_step;
    std::vector<PairSolution> beside;
    const auto same = [&] {
      return beside.size() == 4 && std::all_of(beside.begin(), beside.end(),
                                               [&](const PairSolution& other) { return same_elements(s, other); });
    };
    constexpr double kLeast = 0.02;
    for (; step > kLeast * tried[i].whole_step && !same(); step *= 0.5) {
      beside.clear();
      for (const double by : {step, -step, 0.5 * step, -0.5 * step})
        beside.push_back(solved_with(geometry, problem, tried[i], by));
    }
    step *= 2.0;
    ASSERT_TRUE(same()) << tried[i].name;
    for (const Number& number : numbers_of(patches)) {
      const auto slope = [&](std::size_t k, double length) {
        return (number.of(beside[k]) - number.of(beside[k + 1])) / (2.0 * length);
      };
      const double whole = (4.0 * slope(2, 0.5 * step) - slope(0, step)) / 3.0;
      const double size = std::max(std::abs(number.of(s)), number.usual);
      const double open = kLeftOpen * size / step + kZero * size / tried[i].range;
      EXPECT_NEAR(found[i].derivative(number.of), whole, kSameSlope * std::abs(whole) + open)
          << number.name << " by " << tried[i].name;
    }
  }
}

TEST(PairNeighbours, OfAWheelOnTwoCrowns) {
  Problem p = testing::crowns_problem();
  testing::group(p, testing::Grouping::apart);
  p.state.position.roll = 2e-4;
  p.state.velocity = {10.0, 0.01, 0.0, 0.0, 0.0, -10.0 / testing::kRadius * 0.9995};
  p.friction.kinetic = 0.3;
  std::vector<Tried> tried = tried_parameters(true);
  // a rail that is placed by itself has no gauge
  std::erase_if(tried, [](const Tried& t) { return t.name == "gauge"; });
  expect_slopes(testing::two_crowns(), p, tried, 2);
}

TEST(PairNeighbours, OfAStandardWheelUnderALoad) {
  expect_slopes(standard_geometry(), standard_problem(), tried_parameters(true));
}

TEST(PairNeighbours, OfAStandardWheelAtAHeight) {
  Problem p = standard_problem();
  p.state.position.z = Pair(standard_geometry()).solve(p).z;
  p.vertical_force.reset();
  expect_slopes(standard_geometry(), p, tried_parameters(false));
}

Tried of_shape(std::string name, Facing facing, std::size_t shape, double whole_step) {
  Tried out{std::move(name), whole_step, {}, 1e-2};
  out.parameter.shape_of = facing, out.parameter.shape = shape;
  return out;
}

TEST(PairNeighbours, OfAWheelOnItsFlat) {
  Defects defects;
  defects.flats = {{.length = 60e-3, .depth = 0.3e-3}};
  Geometry geometry = standard_geometry();
  geometry.wheel = analytic::add_defects(geometry.wheel, defects, Body::wheel, kStandardRadius);
  geometry.round_wheel = false;
  Problem p = standard_problem();
  p.state.position.pitch = 0.02;  // 9 mm beside the middle
  std::vector<Tried> tried = tried_parameters(true);
  tried.push_back(of_problem("pitch", kLengthStep, 5e-8, [](Problem& q) -> double& { return q.state.position.pitch; }));
  tried.push_back(of_shape("depth", Facing::down, geometry.wheel->parameter_count() - 1, 1e-3));
  expect_slopes(geometry, p, tried);
  Pair pair(geometry);
  const PairSolution s = pair.solve(p);
  EXPECT_EQ(pair.neighbours(p, s, {&tried.back().parameter, 1}).at(0).heights, HeightsBy::exact);
}

TEST(PairNeighbours, OfPointsOfAMeasuredRail) {
  Geometry geometry = standard_geometry();
  geometry.rail = spline::make_profile_surface(spline::testing::rail_head(), 0.0);
  Problem p = standard_problem();
  Pair pair(geometry);
  const PairSolution s = pair.solve(p);
  ASSERT_EQ(s.patches.size(), 1u);
  // points about the contact
  const std::size_t count = geometry.rail->parameters().size();
  const Vec2 above = s.patches[0].frame.X_TC.origin.head<2>();
  std::vector<Tried> tried;
  std::vector<double> height(1);
  for (std::size_t k = 0; k < count; ++k) {
    const PlaneGrid here{s.placement.X_TS.inverse(), {above.x(), above.y(), 1.0, 1.0, 1, 1}};
    ASSERT_EQ(geometry.rail->heights_by(k, here, height), HeightsBy::exact);
    constexpr double kNear = 0.02;
    if (std::abs(height[0]) > kNear) tried.push_back(of_shape("point " + std::to_string(k), Facing::up, k, 2e-8));
  }
  ASSERT_GE(tried.size(), 3u);
  expect_slopes(geometry, p, tried);
}

/// Hertz's theory: under a load F approach and largest pressure grow by 2/3 and 1/3 of their parts of it.
TEST(PairNeighbours, ByTheLoadIsHertzs) {
  Problem p = testing::crowns_problem();
  p.material.layer_flexibility = 0.0;
  p.discretisation.dx = p.discretisation.ds = 0.1e-3;
  p.discretisation.max_elements = 0;
  p.regime = kalker::Regime::frictionless;
  p.state.position.roll = 0.01;  // on one crown
  Pair pair(testing::two_crowns());
  const PairSolution s = pair.solve(p);
  ASSERT_EQ(s.patches.size(), 1u);
  const PairParameter load{[](double by, Problem& q, Geometry&) { *q.vertical_force += by; }, 1.0};
  const PairNeighbours by_load = pair.neighbours(p, s, {&load, 1}).at(0);
  ASSERT_EQ(by_load.report.status, Status::ok);
  const double share = 1.0 / *p.vertical_force;
  const auto relative = [&](auto number) { return by_load.derivative(number) / number(s) / share; };
  constexpr double kElements = 0.02;
  EXPECT_NEAR(relative([](const PairSolution& q) { return q.patches[0].contact.approach; }), 2.0 / 3.0, kElements);
  EXPECT_NEAR(relative([](const PairSolution& q) { return q.patches[0].contact.max_pressure; }), 1.0 / 3.0, kElements);
}

TEST(PairNeighbours, OfTheLeftAreTheMirrorImageToTheLastBit) {
  const Problem right = standard_problem(), left = mirrored(right);
  Pair pair(standard_geometry()), other(standard_geometry());
  const PairSolution s = pair.solve(right), t = other.solve(left);
  const auto aside = [](double sign) {
    return PairParameter{[sign](double by, Problem& p, Geometry&) { p.state.position.y += sign * by; }};
  };
  const PairParameter to_the_right = aside(1.0), to_the_left = aside(-1.0);
  const PairNeighbours a = pair.neighbours(right, s, {&to_the_right, 1}).at(0),
                       b = other.neighbours(left, t, {&to_the_left, 1}).at(0);
  for (const auto& [x, y] : {std::pair{&a.more, &b.more}, {&a.less, &b.less}}) {
    const PairSolution image = mirrored(*y);
    for (const Number& number : numbers_of(1)) EXPECT_EQ(number.of(*x), number.of(image)) << number.name;
  }
}

TEST(PairNeighbours, AreTheSameOnAnyNumberOfThreads) {
  const Problem problem = standard_problem();
  Pair pair(standard_geometry());
  const PairSolution s = pair.solve(problem);
  std::vector<PairParameter> parameters;
  for (const Tried& t : tried_parameters(true)) parameters.push_back(t.parameter);
  const auto found = [&](int threads) {
    const ThreadLimit limit(threads);
    return pair.neighbours(problem, s, parameters);
  };
  const std::vector<PairNeighbours> one = found(1), many = found(4);
  for (std::size_t i = 0; i < one.size(); ++i)
    for (const Number& number : numbers_of(1))
      EXPECT_EQ(one[i].derivative(number.of), many[i].derivative(number.of)) << i << number.name;
}

TEST(PairNeighbours, RefuseWhatTheyDoNotFollow) {
  const Problem problem = standard_problem();
  Pair pair(standard_geometry());
  const PairSolution s = pair.solve(problem);
  const auto refused = [&](const Problem& p, const PairSolution& of, const PairParameter& parameter) {
    EXPECT_THROW(pair.neighbours(p, of, {&parameter, 1}), Error);
  };
  const PairParameter aside{[](double by, Problem& p, Geometry&) { p.state.position.y += by; }};
  for (const PairParameter& unknown :
       {PairParameter{[](double by, Problem&p, Geometry&) { p.discretisation.dx += by; }},
        PairParameter{[](double by, Problem&p, Geometry&) { p.material.layer_flexibility += by; }},
        PairParameter{[](double by, Problem&p, Geometry&) { p.friction.amplitude_1 += by; }}}) {
    const Report report = pair.neighbours(problem, s, {&unknown, 1}).at(0).report;
    EXPECT_EQ(report.status, Status::failed);
    EXPECT_NE(report.message, "");
  }
  PairParameter shape;
  shape.shape_of = Facing::up, shape.shape = standard_geometry().rail->parameter_count();
  refused(problem, s, shape);
  refused(problem, s, {aside.change, 0.0});
  refused(problem, {}, aside);
  Problem other = problem;
  other.regime = kalker::Regime::transient;
  refused(other, s, aside);
  other = problem;
  other.damping.emplace();
  refused(other, s, aside);
  other = problem;
  other.longitudinal_force = 0.0;
  refused(other, s, aside);
  other = problem;
  other.reference_surface = ReferenceSurface::plane_surface_slip;
  refused(other, s, aside);
}

}  // namespace
}  // namespace treadmark::wheelrail
