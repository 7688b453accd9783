// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/interfaces/fmi/resources_of.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string case_text(const std::string& wheelset, const std::string& regime = "steady") {
  return "title = \"A <wheel> & \\\"its\\\" rail\"\n[case]\nregime = \"" + regime + R"("
[rail]
shape.standard = "60E1"
[wheel]
shape.standard = "S1002"
[track]
gauge_mm = 1435.0
cant = "1:40"
[friction]
coefficient = 0.3
[discretisation]
dx_mm = 2.0
ds_mm = 1.0
[wheelset]
nominal_radius_mm = 460
velocity_m_s = 20
vpitch_rad_s = -43.5
)" + wheelset;
}

/// The same without an FMU.
struct Direct {
  explicit Direct(const std::string& text, Side side = Side::right) {
    const io::CaseFile file = io::parse_case_text(text, "text");
    given = std::get<io::WheelRailCase>(file.cases.front().content);
    given.side = side;
    const auto& rail = store.get(given.rail, Body::rail, 0.0, Region{});
    const auto& wheel = store.get(given.wheel, Body::wheel, given.wheelset.nominal_radius, Region{});
    pair = std::make_unique<wheelrail::Pair>(
        wheelrail::Geometry{rail.represented.surface, wheel.represented.surface, true, true});
    problem = app::to_problem(given, true);
  }
  wheelrail::PairSolution solve() { return pair->solve(problem); }

  io::WheelRailCase given;
  app::SurfaceStore store;
  std::unique_ptr<wheelrail::Pair> pair;
  wheelrail::Problem problem;
};

std::vector<double> numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// From the patches: where they push against the wheelset, seen from the middle of its axle.
std::pair<Vec3, Vec3> load_on_wheelset(const wheelrail::PairSolution& s) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (const wheelrail::PatchSolution& patch : s.patches) {
    const Vec3 f = -(patch.frame.X_TC.rotation * patch.force_C);
    force += f;
    moment +=
        (patch.frame.X_TC.origin - s.placement.X_TWs.origin).cross(f) - patch.frame.X_TC.rotation * patch.moment_C;
  }
  return {force, moment};
}

/// Every number of the FMU that a solution has, bit for bit.
void expect_same(Importer& fmu, const std::string& prefix, const wheelrail::PairSolution& s) {
  EXPECT_EQ(fmu.get(prefix + "force_on_rail"), numbers(s.load.track.force));
  EXPECT_EQ(fmu.get(prefix + "moment_on_rail"), numbers(s.load.track.moment));
  EXPECT_EQ(fmu.number(prefix + "z"), s.z);
  EXPECT_EQ(fmu.number(prefix + "least_gap"), s.least_gap);
  EXPECT_EQ(fmu.number(prefix + "status"), static_cast<double>(s.status));
  ASSERT_EQ(fmu.number(prefix + "patches"), static_cast<double>(s.patches.size()));
  for (std::size_t k = 0; k < s.patches.size(); ++k) {
    const wheelrail::PatchSolution& p = s.patches[k];
    const auto expect = [&](const char* name, double value) {
      EXPECT_EQ(fmu.get(prefix + "patch." + name).at(k), value) << name << ' ' << k;
    };
    expect("fn", p.contact.force_n);
    expect("fx", p.contact.force_x);
    expect("fs", p.contact.force_y);
    expect("mn", p.moment_C.z());
    expect("pmax", p.contact.max_pressure);
    expect("approach", p.contact.approach);
    expect("xi", p.kinematics.xi);
    expect("eta", p.kinematics.eta);
    expect("phi", p.kinematics.phi);
    expect("angle", p.frame.angle);
    expect("y", p.frame.X_TC.origin.y());
    expect("area", p.contact.elements_contact * p.grid.cell_area());
  }
  for (std::size_t k = s.patches.size(); k < 4; ++k) EXPECT_EQ(fmu.get(prefix + "patch.fn").at(k), 0.0);
}

const std::string kPressed = case_text("y_mm = 2.0\nz_mm = 0.9\n");
constexpr double kStep = 1e-3;

struct Place {
  double y, z, yaw;
};
constexpr Place kPlaces[] = {{2e-3, 0.9e-3, 0.0}, {4e-3, 1.0e-3, 2e-3}, {-3e-3, 0.8e-3, -1e-3}, {6.5e-3, 0.7e-3, 0.0}};

class Versions : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Fmi, Versions, ::testing::Values(2, 3));

TEST_P(Versions, AWheelHasTheNumbersOfThePair) {
  const Fmu fmu(kPressed, GetParam());
  const auto it = fmu.open();
  Direct direct(kPressed);
  ASSERT_EQ(it->initialize(), kOk) << it->messages();
  expect_same(*it, "", direct.solve());
  double time = 0.0;
  for (const Place& place : kPlaces) {
    direct.problem.state.position.y = place.y;
    direct.problem.state.position.z = place.z;
    direct.problem.state.position.yaw = place.yaw;
    const wheelrail::PairSolution s = direct.solve();
    ASSERT_EQ(it->set("wheelset.y", place.y), kOk);
    ASSERT_EQ(it->set("wheelset.z", place.z), kOk);
    ASSERT_EQ(it->set("wheelset.yaw", place.yaw), kOk);
    ASSERT_EQ(it->step(time, kStep), kOk) << it->messages();
    time += kStep;
    EXPECT_EQ(it->number("time"), time);
    expect_same(*it, "", s);
    const auto [force, moment] = load_on_wheelset(s);
    const double kN = 1e-10 * force.norm();
    const auto f = it->get("force_on_wheelset"), m = it->get("moment_on_wheelset");
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(f[static_cast<std::size_t>(k)], force[k], kN);
      EXPECT_NEAR(m[static_cast<std::size_t>(k)], moment[k], kN);
    }
  }
  EXPECT_EQ(it->terminate(), kOk);
  EXPECT_EQ(it->messages(), "");
}

TEST_P(Versions, AWheelsetIsTwoWheels) {
  const Fmu fmu(kPressed, GetParam(), true);
  const auto it = fmu.open();
  Direct left(kPressed, Side::left), right(kPressed);
  ASSERT_EQ(it->initialize(), kOk) << it->messages();
  const wheelrail::PairSolution l = left.solve(), r = right.solve();
  expect_same(*it, "left.", l);
  expect_same(*it, "right.", r);
  const Vec3 sum = load_on_wheelset(l).first + load_on_wheelset(r).first;
  const auto force = it->get("force_on_wheelset");
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(force[static_cast<std::size_t>(k)], sum[k], 1e-10 * sum.norm());
  // In the middle of the track all is symmetric.
  ASSERT_EQ(it->set("wheelset.y", 0.0), kOk);
  ASSERT_EQ(it->step(0.0, kStep), kOk);
  EXPECT_EQ(it->get("left.patch.fn"), it->get("right.patch.fn"));
  EXPECT_EQ(it->get("force_on_wheelset").at(1), 0.0);
  EXPECT_EQ(it->get("moment_on_wheelset").at(0), 0.0);
}

TEST_P(Versions, SavedStatesGoOnToTheSameBits) {
  const Fmu fmu(case_text("y_mm = 2.0\nz_mm = 0.9\n", "transient"), GetParam());
  const auto it = fmu.open();
  Direct direct(case_text("y_mm = 2.0\nz_mm = 0.9\n", "transient"));
  ASSERT_EQ(it->initialize(), kOk) << it->messages();
  direct.problem.regime = Regime::steady;
  direct.problem.history = HistoryUse::start;
  expect_same(*it, "", direct.solve());
  direct.problem.regime = Regime::transient;
  direct.problem.history = HistoryUse::keep_going;
  double time = 0.0;
  const auto go_on = [&](Importer& fmu_at, int i) {
    EXPECT_EQ(fmu_at.set("wheelset.yaw", 1e-3 * std::sin(i)), kOk);
    const double length = i % 2 == 0 ? 5e-5 : 8e-5;  // lengths may differ
    EXPECT_EQ(fmu_at.step(time, length), kOk) << fmu_at.messages();
    time += length;
    return length;
  };
  for (int i = 0; i < 3; ++i) {
    const double before = time, length = go_on(*it, i);
    direct.problem.state.position.yaw = 1e-3 * std::sin(i);
    direct.problem.discretisation.dq_relative = 20.0 * ((before + length) - before) / 2e-3;
    expect_same(*it, "", direct.solve());
  }
  void *saved = nullptr, *again = nullptr;
  ASSERT_EQ(it->save(&saved), kOk);
  std::string bytes;
  ASSERT_EQ(it->to_bytes(saved, bytes), kOk);
  const double saved_time = time;
  const auto rest = [&](Importer& fmu_at) {
    time = saved_time;
    std::vector<double> all;
    for (int i = 3; i < 6; ++i) {
      go_on(fmu_at, i);
      for (const char* name : {"force_on_rail", "moment_on_rail", "patch.fx", "patch.pmax"})
        for (const double value : fmu_at.get(name)) all.push_back(value);
    }
    return all;
  };
  const std::vector<double> first = rest(*it);
  ASSERT_EQ(it->restore(saved), kOk);
  EXPECT_EQ(rest(*it), first);
  const auto other = fmu.open();  // as in another process
  ASSERT_EQ(other->from_bytes(bytes, &again), kOk) << other->messages();
  ASSERT_EQ(other->restore(again), kOk) << other->messages();
  std::string same_bytes;
  ASSERT_EQ(other->to_bytes(again, same_bytes), kOk);
  EXPECT_EQ(same_bytes, bytes);
  EXPECT_EQ(rest(*other), first);
  EXPECT_EQ(it->free_state(&saved), kOk);
  EXPECT_EQ(saved, nullptr);
  EXPECT_EQ(it->free_state(&saved), kOk);
  EXPECT_EQ(other->free_state(&again), kOk);
  // Back to the beginning.
  ASSERT_EQ(it->reset(), kOk);
  ASSERT_EQ(it->initialize(), kOk);
  direct.problem.state.position.yaw = 0.0;
  direct.problem.regime = Regime::steady;
  direct.problem.history = HistoryUse::start;
  expect_same(*it, "", direct.solve());
}

TEST_P(Versions, DerivativesAreThoseOfDifferences) {
  const Fmu fmu(kPressed, GetParam());
  const auto it = fmu.open();
  Direct direct(kPressed);
  ASSERT_EQ(it->initialize(), kOk);
  const std::vector<double> before = it->get("force_on_rail");
  // Of other steps than the FMU's own; two of the inputs at once.
  const auto at = [&](double h) {
    wheelrail::Problem p = direct.problem;
    p.state.position.z += 2.0 * h;
    p.state.position.y += h;
    return direct.pair->solve(p).load.track.force;
  };
  constexpr double kOther = 3e-6;
  const Vec3 expected = (at(kOther) - at(-kOther)) / (2.0 * kOther);
  std::vector<double> got(3);
  ASSERT_EQ(
      it->derivative(it->variables().at("force_on_rail").references,
                     {it->variables().at("wheelset.y").references[0], it->variables().at("wheelset.z").references[0]},
                     {1.0, 2.0}, got),
      kOk)
      << it->messages();
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[static_cast<std::size_t>(k)], expected[k], 5e-3 * expected.norm());
  EXPECT_GT(expected.z(), 1e8);
  EXPECT_EQ(it->get("force_on_rail"), before);
  ASSERT_EQ(it->derivative(it->variables().at("force_on_rail").references, it->variables().at("wheelset.y").references,
                           {0.0}, got),
            kOk);
  EXPECT_THAT(got, ElementsAre(0.0, 0.0, 0.0));
}

TEST_P(Versions, BadCallsAreErrorsAndChangeNothing) {
  const Fmu fmu(kPressed, GetParam());
  std::string messages;
  EXPECT_EQ(Importer::open(fmu.unpacked(), "another", &messages), nullptr);
  EXPECT_THAT(messages, HasSubstr("token"));
  UnpackedFmu nowhere = fmu.unpacked();
  nowhere.resources = "/nowhere";
  EXPECT_EQ(Importer::open(nowhere, nullptr, &messages), nullptr);
  EXPECT_THAT(messages, HasSubstr("/nowhere"));

  const auto it = fmu.open();
  const auto refused = [&](int status, const char* why) {
    EXPECT_EQ(status, kError) << why;
    EXPECT_THAT(it->messages(), HasSubstr(why));
    it->messages().clear();
  };
  const auto y = it->variables().at("wheelset.y").references, force = it->variables().at("force_on_rail").references,
             status = it->variables().at("status").references, dx = it->variables().at("discretisation.dx").references,
             time = it->variables().at("time").references;
  std::vector<double> one(1), three(3);
  std::vector<int> integer(1);
  refused(it->step(0.0, kStep), "before the initialization");
  refused(it->exit_initialization(), "before the initialization");
  refused(it->terminate(), "before the initialization");
  refused(it->get_reals(force, three), "no outputs before");
  refused(it->enter_initialization(std::numeric_limits<double>::quiet_NaN()), "not finite");
  ASSERT_EQ(it->initialize(), kOk);
  const std::vector<double> before = it->get("force_on_rail");
  refused(it->enter_initialization(0.0), "after the initialization");
  refused(it->set_reals({99999}, {1.0}), "99999");
  refused(it->get_reals({99999}, one), "99999");
  refused(it->get_reals(status, one), "is an integer");
  refused(it->get_integers(y, integer), "is no integer");
  refused(it->set_reals(y, {std::numeric_limits<double>::quiet_NaN()}), "wheelset.y must be finite");
  refused(it->set_reals(y, {std::numeric_limits<double>::infinity()}), "must be finite");
  refused(it->set_reals({y[0], 99999}, {0.1, 0.1}), "99999");
  refused(it->set_reals(force, {1.0, 1.0, 1.0}), "cannot be set");
  refused(it->set_reals(time, {1.0}), "cannot be set");
  refused(it->set_reals(dx, {1e-3}), "fixed");
  EXPECT_THAT(it->without_instance(), ::testing::Each(kError));
  EXPECT_THAT(it->for_nothing(), ::testing::Each(kError));
  refused(it->step(0.0, 0.0), "positive");
  refused(it->step(0.0, -1.0), "positive");
  refused(it->step(0.0, std::numeric_limits<double>::quiet_NaN()), "finite");
  refused(it->step(1.0, kStep), "stands at 0");
  refused(it->derivative(y, y, {1.0}, one), "is no output");
  refused(it->derivative(force, force, {1.0, 1.0, 1.0}, three), "is no input");
  refused(it->restore(nullptr), "null");
  refused(it->save(nullptr), "null");
  if (GetParam() == 3) refused(it->get_reals(force, one), "number of values");

  // Every prefix of a state, and a state with any byte changed, is refused.
  void* saved = nullptr;
  std::string bytes;
  ASSERT_EQ(it->save(&saved), kOk);
  ASSERT_EQ(it->to_bytes(saved, bytes), kOk);
  const auto refuse = [&](const std::string& damaged) {
    void* state = nullptr;
    EXPECT_EQ(it->from_bytes(damaged, &state), kError);
    EXPECT_EQ(state, nullptr);
  };
  for (std::size_t i = 0; i < bytes.size(); i += 1 + bytes.size() / 60) {
    refuse(bytes.substr(0, i));
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    refuse(damaged);
  }
  ASSERT_EQ(it->restore(saved), kOk);
  it->free_state(&saved);
  ASSERT_EQ(it->step(0.0, kStep), kOk) << it->messages();
  EXPECT_EQ(it->get("force_on_rail"), before);
  // What the solver refuses.
  ASSERT_EQ(it->set("friction.coefficient", -1.0), kOk);
  it->messages().clear();
  refused(it->step(kStep, kStep), "friction");
  ASSERT_EQ(it->set("friction.coefficient", 0.3), kOk);
  ASSERT_EQ(it->step(kStep, kStep), kOk);
  EXPECT_EQ(it->get("force_on_rail"), before);
}

TEST_P(Versions, AStepThatFailsMayBeRepeated) {
  const Fmu fmu(kPressed, GetParam());
  const auto it = fmu.open();
  ASSERT_EQ(it->initialize(), kOk);
  const auto before = it->get("force_on_rail");
  ASSERT_EQ(it->set("wheelset.z", 30e-3), kOk);  // the wheel inside the rail
  EXPECT_EQ(it->step(0.0, kStep), kDiscard);
  EXPECT_NE(it->messages(), "");
  EXPECT_EQ(it->number("time"), 0.0);
  ASSERT_EQ(it->set("wheelset.z", 0.9e-3), kOk);
  EXPECT_EQ(it->step(0.0, 0.5 * kStep), kOk);
  EXPECT_EQ(it->get("force_on_rail"), before);
}

TEST_P(Versions, LossOfContactIsNoEvent) {
  const Fmu fmu(kPressed, GetParam());
  const auto it = fmu.open();
  ASSERT_EQ(it->initialize(), kOk);
  ASSERT_EQ(it->set("wheelset.z", -1e-3), kOk);
  ASSERT_EQ(it->step(0.0, kStep), kOk);
  EXPECT_EQ(it->number("status"), 1.0);
  EXPECT_EQ(it->number("patches"), 0.0);
  EXPECT_GT(it->number("least_gap"), 0.5e-3);
  EXPECT_THAT(it->get("force_on_wheelset"), ElementsAre(0.0, 0.0, 0.0));
}

TEST_P(Versions, ALoadOfNothingIsLossOfContact) {
  for (const bool transient : {false, true}) {
    const Fmu fmu(case_text("y_mm = 2.0\nvertical_force_N = 80e3\n", transient ? "transient" : "steady"), GetParam());
    const auto it = fmu.open();
    ASSERT_EQ(it->initialize(), kOk) << it->messages();
    const double loaded = it->number("z");
    double time = 0.0;
    const double step = 1e-4;
    const auto go_on = [&](double force) {
      EXPECT_EQ(it->set("vertical_force", force), kOk);
      EXPECT_EQ(it->set("wheelset.s", 20.0 * (time + step)), kOk);
      EXPECT_EQ(it->step(time, step), kOk) << force << ' ' << it->messages();
      time += step;
    };
    for (const double force : {0.0, -5e4, 0.1, 1e-300}) {
      go_on(force);
      EXPECT_EQ(it->number("status"), 1.0) << force;
      EXPECT_EQ(it->number("patches"), 0.0) << force;
      EXPECT_EQ(it->number("doubts"), 0.0) << force;
      EXPECT_THAT(it->get("force_on_rail"), ElementsAre(0.0, 0.0, 0.0)) << force;
      EXPECT_NEAR(it->number("least_gap"), 0.0, 1e-8) << force;
      EXPECT_LT(it->number("z"), loaded) << force;
      EXPECT_NEAR(it->number("z"), loaded, 0.2e-3) << force;  // some tenth of a millimetre of approach
      go_on(80e3);
      EXPECT_EQ(it->number("status"), 0.0) << force;
      EXPECT_NEAR(it->get("force_on_rail")[2], 80e3, 80.0) << force;
    }
  }
}

/// Contacts of few elements bear more by jumps: no load on the way to nothing is an error for that.
TEST_P(Versions, LightLoadsAreNoErrors) {
  for (const char* size : {"0.5", "2", "5"})
    for (const char* y : {"0.0", "-3.0", "6.3"}) {
      std::string text = case_text(fmt::format("y_mm = {}\nvertical_force_N = 80e3\n", y));
      for (const auto& [given, other] : {std::pair{"dx_mm = 2.0", "dx_mm = "}, {"ds_mm = 1.0", "ds_mm = "}})
        text.replace(text.find(given), std::string(given).size(), other + std::string(size));
      const Fmu fmu(text, GetParam());
      const auto it = fmu.open();
      ASSERT_EQ(it->initialize(), kOk) << it->messages();
      double time = 0.0;
      for (const double force : {80.0, 30.0, 10.0, 5.0, 3.0, 2.0, 1.01}) {
        ASSERT_EQ(it->set("vertical_force", force), kOk);
        ASSERT_EQ(it->step(time, kStep), kOk) << size << ' ' << y << ' ' << force << ' ' << it->messages();
        time += kStep;
        EXPECT_NEAR(it->get("force_on_rail")[2], force, 0.1 * force) << size << ' ' << y;
      }
    }
}

TEST_P(Versions, TheStopTimeOfTheMasterEndsTheRun) {
  const Fmu fmu(kPressed, GetParam());
  const auto it = fmu.open();
  ASSERT_EQ(it->initialize(1.0, 1.0 + 3.0 * kStep), kOk);
  void* saved = nullptr;
  ASSERT_EQ(it->save(&saved), kOk);
  EXPECT_EQ(it->step(1.0, 4.0 * kStep), kError);
  EXPECT_THAT(it->messages(), HasSubstr("behind the stop time 1.003"));
  EXPECT_EQ(it->number("time"), 1.0);
  double time = 1.0;
  for (int i = 0; i < 3; ++i, time += kStep) EXPECT_EQ(it->step(time, kStep), kOk);
  EXPECT_EQ(it->step(time, kStep), kError);
  // A state holds it, and without one there is no end.
  const auto other = fmu.open();
  ASSERT_EQ(other->restore(saved), kOk);
  EXPECT_EQ(other->step(1.0, 4.0 * kStep), kError);
  it->free_state(&saved);
  ASSERT_EQ(it->reset(), kOk);
  ASSERT_EQ(it->initialize(), kOk);
  EXPECT_EQ(it->step(0.0, 100.0), kOk);
}

TEST_P(Versions, TheStepOfTheDescriptionCanBeTaken) {
  for (const char* regime : {"steady", "transient"})
    for (const bool wheelset : {false, true}) {
      const Fmu fmu(case_text("y_mm = 2.0\nz_mm = 0.9\n", regime), GetParam(), wheelset);
      const double step = std::stod(fmu.unpacked().attribute("stepSize"));
      EXPECT_GT(step, 0.0);
      if (std::string(regime) == "transient") {
        EXPECT_LE(step, 2.0 * 2e-3 / 20.0);
      }
      const auto it = fmu.open();
      ASSERT_EQ(it->initialize(), kOk);
      double time = 0.0;
      for (int i = 0; i < 3; ++i, time += step) {
        ASSERT_EQ(it->set("wheelset.s", 20.0 * (time + step)), kOk);
        EXPECT_EQ(it->step(time, step), kOk) << it->messages();
      }
    }
}

TEST_P(Versions, InstancesWorkAtOnce) {
  const Fmu fmu(kPressed, GetParam());
  const auto history = [&](double y0) {
    const auto it = fmu.open();
    std::vector<double> all;
    EXPECT_EQ(it->initialize(), kOk);
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(it->set("wheelset.y", y0 + 2e-4 * i), kOk);
      EXPECT_EQ(it->step(i * kStep, kStep), kOk);
      for (const double value : it->get("force_on_rail")) all.push_back(value);
    }
    return all;
  };
  const std::vector<double> a = history(1e-3), b = history(3e-3);
  std::vector<double> a_beside, b_beside;
  std::thread one([&] { a_beside = history(1e-3); }), two([&] { b_beside = history(3e-3); });
  one.join();
  two.join();
  EXPECT_EQ(a_beside, a);
  EXPECT_EQ(b_beside, b);
  EXPECT_NE(a, b);
}

TEST(Fmi, PrescribedForceAndTunableFriction) {
  const std::string text = case_text("y_mm = 2.0\nvertical_force_N = 80e3\n");
  const Fmu fmu(text);
  const auto it = fmu.open();
  EXPECT_FALSE(it->variables().contains("wheelset.z"));
  Direct direct(text);
  ASSERT_EQ(it->initialize(), kOk) << it->messages();
  expect_same(*it, "", direct.solve());
  ASSERT_EQ(it->set("vertical_force", 60e3), kOk);
  ASSERT_EQ(it->set("friction.coefficient", 0.15), kOk);
  ASSERT_EQ(it->step(0.0, kStep), kOk);
  direct.problem.vertical_force = 60e3;
  direct.problem.friction.kinetic = 0.15;
  expect_same(*it, "", direct.solve());
  // Sizes of elements may be chosen before.
  ASSERT_EQ(it->reset(), kOk);
  ASSERT_EQ(it->set("discretisation.dx", 1e-3), kOk);
  ASSERT_EQ(it->initialize(), kOk);
  Direct finer(text);
  finer.problem.discretisation.dx = 1e-3;
  expect_same(*it, "", finer.solve());
}

TEST(Fmi, InputsCountDuringInitialization) {
  const Fmu fmu(kPressed);
  const auto it = fmu.open();
  Direct direct(kPressed);
  ASSERT_EQ(it->enter_initialization(2.5), kOk);
  ASSERT_EQ(it->set("wheelset.y", 4e-3), kOk);
  direct.problem.state.position.y = 4e-3;
  expect_same(*it, "", direct.solve());
  ASSERT_EQ(it->set("wheelset.y", 5e-3), kOk);
  direct.problem.state.position.y = 5e-3;
  const auto s = direct.solve();
  expect_same(*it, "", s);
  ASSERT_EQ(it->exit_initialization(), kOk);
  expect_same(*it, "", s);
  EXPECT_EQ(it->number("time"), 2.5);
}

TEST(Fmi, FilesOfACaseTravelWithIt) {
  SampleInput input;
  const auto in_fmu = [&] {
    const Fmu fmu(input.inp(), 3);
    const auto it = fmu.open();
    EXPECT_EQ(it->initialize(), kOk) << it->messages();
    return it->get("force_on_rail");
  };
  const auto direct = [&] {
    const io::CaseFile file = io::read_any_case(input.inp());
    const auto& given = *app::first_wheelrail_case(file);
    app::SurfaceStore store;
    const auto& rail = store.get(given.rail, Body::rail, 0.0, Region{});
    const auto& wheel = store.get(given.wheel, Body::wheel, given.wheelset.nominal_radius, Region{});
    wheelrail::Pair pair({rail.represented.surface, wheel.represented.surface, true, wheel.constant_profile()});
    return numbers(pair.solve(app::to_problem(given, wheel.constant_profile())).load.track.force);
  };
  EXPECT_EQ(in_fmu(), direct());
  input.use_slices();
  EXPECT_EQ(in_fmu(), direct());
  // Nothing from outside of the slices' folder.
  std::string slices = input.read("wheel.slcw");
  for (std::size_t at = 0; (at = slices.find("'slice", at)) != std::string::npos; at += 4)
    slices.replace(at, 1, "'../");
  std::filesystem::create_directory(input.folder() / "inner");
  input.write("inner/wheel.slcw", slices);
  input.edit("case.inp", "'wheel.slcw'", "'inner/wheel.slcw'");
  try {
    in_fmu();
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("outside the folder of the slices"));
  }
}

/// Of a backend, and from files of both libraries.
TEST(Fmi, OffsetsNeedNoOpenVdb) {
  TREADMARK_NEEDS("nanovdb");
  const SampleInput input;
  input.write("flat.toml", standard_case("2.0", kWheelWithFlat));
  app::ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 2e-3;
  settings.range_theta = {-0.28, 0.23};
  std::vector<std::string> wheels{"backend = \"offset\"\nresolution_mm = 4\n" + kWheelWithFlat};
  for (const char* name : {"wheel.nvdb", "wheel.vdb"}) {
    if (!has_part("openvdb") && name == std::string("wheel.vdb")) continue;
    app::convert_surface(input.folder() / "flat.toml", input.folder() / name, settings);
    wheels.push_back("shape.file = \"" + std::string(name) + "\"\n");
  }
  for (const std::string& given_wheel : wheels) {
    SCOPED_TRACE(given_wheel);
    input.write("case.toml", standard_case("2.0", given_wheel));
    const Fmu fmu(input.folder() / "case.toml", 3);
    setenv("TREADMARK_MODULES", "/nowhere", 1);
    const auto it = fmu.open();
    EXPECT_EQ(it->initialize(), kOk) << it->messages();
    const std::vector<double> force = it->get("force_on_rail");
    unsetenv("TREADMARK_MODULES");
    const io::CaseFile file = io::read_any_case(input.folder() / "case.toml");
    const auto& given = *app::first_wheelrail_case(file);
    app::SurfaceStore store;
    const auto& rail = store.get(given.rail, Body::rail, 0.0, Region{});
    const auto& wheel = store.get(given.wheel, Body::wheel, given.wheelset.nominal_radius, Region{});
    wheelrail::Pair pair({rail.represented.surface, wheel.represented.surface, true, wheel.constant_profile()});
    EXPECT_EQ(force, numbers(pair.solve(app::to_problem(given, wheel.constant_profile())).load.track.force));
  }
}

std::string refusal(const std::string& text, bool wheelset = false) {
  try {
    const Fmu fmu(text, 3, wheelset);
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Fmi, WhatCannotBeAnFmuIsRefused) {
  EXPECT_THAT(refusal(case_text("z_mm = 0.9\n", "shift")), HasSubstr("a shift has no time"));
  EXPECT_THAT(refusal(kPressed + "[wheel.x]\n"), HasSubstr("unknown key"));
  std::string solid = kPressed, cad = kPressed;
  solid.replace(solid.find("[wheel]\n"), 8, "[wheel]\nbackend = \"level-set\"\n");
  EXPECT_THAT(refusal(solid), HasSubstr("OpenVDB"));
  const std::string rail = "shape.standard = \"60E1\"";
  cad.replace(cad.find(rail), rail.size(), "shape.file = \"" TREADMARK_SOURCE_DIR "/tests/io/cad/data/rail.step\"");
  EXPECT_THAT(refusal(cad), HasSubstr("OpenCASCADE"));
  EXPECT_THAT(refusal("[patch]\nnormal_force_N = 1e3\nmx = 10\nmy = 8\ndx_mm = 1\ndy_mm = 1\n[patch.gap]\n"
                      "coefficients_si = [1, 0, 1, 0, 0, 0]\n[case]\nregime = \"none\"\n"),
              HasSubstr("no case of a wheel on a rail"));
}

}  // namespace
}  // namespace treadmark::testing
