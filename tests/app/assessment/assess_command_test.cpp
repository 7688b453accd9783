// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "treadmark/core/parts.hpp"
#include "treadmark/io/histories/channels.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// Two metres and more on tables, with a point on the mass.
class AssessCommand : public ::testing::Test {
 protected:
  AssessCommand() {
    input_.write("run.toml", R"(title = "on tables"

[simulation]
vehicle = "vehicle.toml"
track = "track.toml"
speed_m_s = 20
distance_m = 6
max_step_us = 200

[[simulation.points]]
name = "floor"
body = "mass"
at_m = [0.5, 0.2, -1]

[assessment]
spectra = ["axle_box.*.az_m_s2"]

[[assessment.sections]]
name = "middle"
from_m = 1
to_m = 5
kind = "curve"

[wheel]
shape.standard = "S1002"
[rail]
shape.standard = "60E1"
[track]
cant = "1:40"
)");
  }
  std::string path(const std::string& name) const { return input_.path(name); }
  ProgramResult simulate(const std::string& folder, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"--quiet", "simulate", path("run.toml"), "-o", path(folder)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
  SampleSimulation input_;
};

TEST_F(AssessCommand, SimulationsAreAssessedAsTheirFileSaysAndAfterwards) {
  const ProgramResult made = simulate("a", {"--json", path("a.json")});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("middle, 1 to 5 m, curve"), HasSubstr("sumY_2m"), HasSubstr("Q_qst")));
  for (const char* file : {"assessment.csv", "assessment.json", "spectra.csv"})
    EXPECT_TRUE(fs::exists(path("a") + '/' + file)) << file;
  const auto json = nlohmann::json::parse(input_.read("a.json"));
  EXPECT_GT(json.at("assessment").at("assessed").size(), 8u);
  const ProgramResult again = run_program(
      {"assess", path("a"), "--section", "middle:1:5:curve", "--spectra", "axle_box.*.az_m_s2", "--csv", "-"});
  ASSERT_EQ(again.status, 0) << again.err;
  // the names of the runs differ: title and folder
  std::string own = input_.read("a/assessment.csv");
  for (std::size_t at = 0; (at = own.find("\non tables,", at)) != std::string::npos;) own.replace(at, 11, "\na,");
  EXPECT_EQ(again.out, own);
}

TEST_F(AssessCommand, ColumnsOfRunningAndPointsAreTheForcesAndMotionsThatStandBeside) {
  ASSERT_EQ(simulate("a", {"--set", "simulation.distance_m=6"}).status, 0);
  const io::SimulationResult r = io::read_simulation(path("a") + "/simulation.h5");
  const auto column = [&](const std::string& name) {
    const std::string wanted[] = {name};
    return io::column_values(r, io::fitting_columns(r.columns, wanted).at(0));
  };
  const auto q = column("ws1_left.Q_N"), y = column("ws1_left.Y_N"), other = column("ws1_right.Y_N");
  const auto ratio = column("ws1_left.Y_over_Q"), sum = column("ws1.sumY_N"), wear = column("ws1_left.Tgamma_N");
  for (std::size_t i = 0; i < q.size(); ++i) {
    EXPECT_DOUBLE_EQ(ratio[i], y[i] / q[i]);
    EXPECT_DOUBLE_EQ(sum[i], y[i] + other[i]);
    EXPECT_GE(wear[i], 0.0);
    EXPECT_LT(wear[i], q[i]);
  }
  EXPECT_THAT(
      input_.read("a/history.csv"),
      AllOf(HasSubstr("car_body.floor.az_m_s2"), HasSubstr("car_body.floor.roll_rate_rad_s"), HasSubstr("ws1.sumY_N"),
            HasSubstr("axle_box.ws1_left.ay"), Not(HasSubstr("axle_box.ws1_left.ax"))));
}

/// Over a flat: of the scheme's steps v' = v + h ((1 - g) a + g a'), where g follows from its spectral radius of 0.8.
TEST_F(AssessCommand, AccelerationsMakeTheVelocitiesThatStandBeside) {
  input_.edit("simulation.toml", "[[simulation.wheels]]",
              "[[simulation.points]]\nname = \"floor\"\nbody = \"mass\"\nat_m = [0.5, 0.2, -1]\n\n"
              "[[simulation.points]]\nname = \"end\"\nbody = \"axle\"\nat_m = [0, 1, -0.46]\nkind = \"axle_box\"\n\n"
              "[[simulation.wheels]]");
  ASSERT_EQ(run_program({"--quiet", "simulate", path("simulation.toml"), "-o", path("flat")}).status, 0);
  const io::SimulationResult r = io::read_simulation(path("flat") + "/simulation.h5");
  const auto column = [&](const std::string& name) { return io::column_values(r, io::column_index(r, name)); };
  const std::vector<double> t = column("t_s"), z = column("axle.z_rate_m_s"), roll = column("axle.roll_rate_rad_s");
  EXPECT_EQ(column("axle_box.ws1_right.az_m_s2"), column("axle_box.end.az_m_s2"));
  const double alpha = (0.8 - 1.0) / (0.8 + 1.0), gamma = 0.5 - alpha;
  const auto expect_velocity = [&](const std::string& name, const std::vector<double>& velocity,
                                   const std::vector<double>& lean = {}) {
    std::vector<double> a = column(name);
    for (std::size_t i = 0; i < lean.size(); ++i) a[i] += 9.81 * lean[i];
    double most = 0.0;
    for (std::size_t i = 1; i < t.size(); ++i) {
      const double rate = (velocity[i] - velocity[i - 1]) / (t[i] - t[i - 1]);
      EXPECT_NEAR(rate, (1.0 - gamma) * a[i - 1] + gamma * a[i], 1e-6 * (1.0 + std::fabs(rate))) << name;
      most = std::max(most, std::fabs(a[i]));
    }
    EXPECT_GT(most, 1e-3) << name;
  };
  expect_velocity("car_body.floor.az_m_s2", column("mass.z_rate_m_s"));
  EXPECT_EQ(column("axle_box.end.roll_rate_rad_s"), roll);
  expect_velocity("axle_box.ws1_left.ay_m_s2", column("axle.y_rate_m_s"), column("axle.roll_rad"));
  for (const double side : {-1.0, 1.0}) {
    std::vector<double> velocity = z;
    for (std::size_t i = 0; i < z.size(); ++i) velocity[i] += side * roll[i];
    expect_velocity(side < 0.0 ? "axle_box.ws1_left.az_m_s2" : "axle_box.ws1_right.az_m_s2", velocity);
  }
}

TEST_F(AssessCommand, OnlyTheChannelsThatAreChosenAreWrittenDown) {
  const ProgramResult made = simulate("a", {"--set", R"(simulation.channels=["ws1_*.Q_N", "ws1_*.Y_N", "mass.z_m"])",
                                            "--set", "assessment.spectra=[]"});
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string csv = input_.read("a/history.csv");
  EXPECT_THAT(csv.substr(0, csv.find('\n')), "t_s,x_m,Q_N,Y_N,ws1_right.Q_N,ws1_right.Y_N,mass.z_m");
  EXPECT_EQ(run_program({"assess", path("a")}).status, 0);
  const ProgramResult wrong = simulate("b", {"--set", R"(simulation.channels=["ws1_*.Q"])"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("no channel of the history is called 'ws1_*.Q'")));
  EXPECT_FALSE(fs::exists(path("b") + "/simulation.h5"));
  const ProgramResult spectra = simulate("b", {"--set", R"(assessment.spectra=["axle_bx.*"])"});
  EXPECT_EQ(spectra.status, 2);
  EXPECT_THAT(spectra.err, HasSubstr("axle_bx.*"));
}

/// At 20 m/s a line every 1.25 ms, for the weightings up to 100 Hz, is 25 mm, less a step of 200 us: 21 mm.
TEST_F(AssessCommand, LinesTooFarApartAreRefusedBeforeTheRun) {
  const ProgramResult refused = simulate("a", {"--set", "simulation.output_every_mm=100"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("simulation.output_every_mm is too coarse for [assessment]"),
                                 HasSubstr("1.25 ms"), HasSubstr("give at most 21,")));
  EXPECT_FALSE(fs::exists(path("a")));
  const ProgramResult most = simulate("a", {"--set", "simulation.output_every_mm=21"});
  EXPECT_EQ(most.status, 0) << most.err;
  EXPECT_THAT(most.out, Not(HasSubstr("too_coarse")));
  // forces alone: 20 Hz
  EXPECT_EQ(simulate("b", {"--set", "simulation.output_every_mm=100", "--set", "simulation.points=[]"}).status, 0);
}

/// Below 15 N of T gamma there is no damage, and means of wear are the wear of the mean.
TEST_F(AssessCommand, LawsAreAskedOfTheWheels) {
  const ProgramResult made = simulate("a", {"--set", R"(assessment.laws=["british-rail", "burstow-r220"])"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("mm3/km"), HasSubstr("warning: the law burstow-r220 is unverified")));
  std::map<std::string, double> found;
  const auto json = nlohmann::json::parse(input_.read("a/assessment.json"));
  for (const auto& one : json.at("runs").at(0).at("assessed"))
    if (one["place"] == "ws1_left" && one["status"] == "ok") found[one["quantity"]] = one["value"];
  ASSERT_LT(found.at("Tgamma"), 15.0);
  EXPECT_NEAR(found.at("british-rail"), 1e-12 * 0.25 * std::numbers::pi * found.at("Tgamma"), 1e-17);
  EXPECT_GT(found.at("british-rail"), 0.0);
  EXPECT_EQ(found.at("burstow-r220"), 0.0);
  const auto refusal = [&](const char* law) { return run_program({"assess", path("a"), "--laws", law}).err; };
  EXPECT_THAT(refusal("british-rial"), HasSubstr("law 'british-rial' is not known (did you mean 'british-rail'?)"));
  EXPECT_THAT(refusal("nothing-like-it"), AllOf(HasSubstr("burstow-r220"), Not(HasSubstr("jendel"))));
  EXPECT_THAT(refusal("british-rail,british-rail"), HasSubstr("asked for twice"));
  EXPECT_THAT(refusal("jendel"), HasSubstr("use it in treadmark evolve"));
  const ProgramResult before = simulate("b", {"--set", R"(assessment.laws=["sheffield-r8t"])"});
  EXPECT_EQ(before.status, 2);
  EXPECT_THAT(before.err, HasSubstr("no wheel has the channels that the law sheffield-r8t needs"));
  EXPECT_FALSE(fs::exists(path("b")));
}

/// Of a file, before the run and afterwards, by the radius of what the history says of the line: a straight.
TEST_F(AssessCommand, LimitsAreThoseOfTheFile) {
  input_.write("limits.toml",
               "edition = \"made up 2026\"\n[[limits]]\nquantity = \"Q\"\nvalue = 80e3\n"
               "[[limits]]\nquantity = \"Y_qst\"\nto_radius_m = 500\nvalue = 1\n");
  const ProgramResult made = simulate("a", {"--set", "assessment.limits=\"limits.toml\""});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("limits: made up 2026, not verified against its text"), HasSubstr("limit 80,"),
                              HasSubstr("warning: the limits of made up 2026 are unverified"),
                              HasSubstr("limits by radius are those of a straight")));
  const auto json = nlohmann::json::parse(input_.read("a/assessment.json"));
  const auto& limits = json.at("runs").at(0).at("limits");
  EXPECT_EQ(limits.at("usual"), false);
  EXPECT_EQ(limits.at("limits").at(1).at("to_radius_m"), 500.0);
  for (const auto& one : json.at("runs").at(0).at("assessed"))
    EXPECT_EQ(one["quantity"] == "Q" && one["status"] == "ok", !one["limit"].is_null()) << one;
  const ProgramResult again = run_program({"assess", path("a"), "--section", "middle:1:5:curve", "--limits",
                                           path("limits.toml"), "--spectra", "axle_box.*.az_m_s2", "--csv", "-"});
  std::string own = input_.read("a/assessment.csv");
  for (std::size_t at = 0; (at = own.find("\non tables,", at)) != std::string::npos;) own.replace(at, 11, "\na,");
  EXPECT_EQ(again.out, own);
  if (has_part("report")) {  // which reads the limits of assessment.json
    ASSERT_EQ(run_program({"report", path("a"), "-o", path("a.html")}).status, 0);
    EXPECT_THAT(input_.read("a.html"), HasSubstr("made up 2026, not verified"));
  }
  EXPECT_THAT(run_program({"assess", path("a")}).out,
              HasSubstr("limits: UIC 518 and EN 14363 as the literature quotes"));
  input_.write("limits.toml", "edition = \"made up 2026\"\n[[limits]]\nquantity = \"Yqst\"\nvalue = 80e3\n");
  const ProgramResult wrong = run_program({"assess", path("a"), "--limits", path("limits.toml")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err,
              AllOf(HasSubstr("limits.toml:2:"), HasSubstr("quantity 'Yqst' is not assessed"), HasSubstr("'Y_qst'")));
  EXPECT_EQ(run_program({"assess", path("a"), "--limits", path("none.toml")}).status, 2);
}

TEST_F(AssessCommand, RunsStandSideBySide) {
  ASSERT_EQ(simulate("a").status, 0);
  ASSERT_EQ(simulate("b", {"--set", "simulation.speed_m_s=30"}).status, 0);
  std::vector<std::string> arguments{"assess",
                                     path("a"),
                                     path("b"),
                                     "-o",
                                     path("both"),
                                     "--json",
                                     path("both.json"),
                                     "--channels",
                                     "ws1_left.Q_N,ws1.sumY_N"};
  if (has_part("report")) arguments.insert(arguments.end(), {"--report", path("both.html")});
  const ProgramResult r = run_program(arguments);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("a: on tables"), HasSubstr("b: on tables"), HasSubstr("run, 0 to 6 m")));
  EXPECT_THAT(input_.read("both/runs.csv"), AllOf(HasSubstr("\na,"), HasSubstr("\nb,")));
  EXPECT_EQ(input_.read("both/assessment.json"), input_.read("both.json"));
  if (has_part("report")) {
    EXPECT_THAT(input_.read("both.html"),
                AllOf(HasSubstr("share of limit, b"), HasSubstr("Channels over the distance")));
    ASSERT_EQ(run_program({"report", path("a"), "-o", path("a.html")}).status, 0);
    EXPECT_THAT(input_.read("a.html"), HasSubstr("Worst wheel, wheelset or point of each section"));
  }
}

TEST_F(AssessCommand, BadRequestsAreRefusedOrNamed) {
  ASSERT_EQ(simulate("a", {"--set", "assessment.sections=[]", "--set", "simulation.distance_m=1"}).status, 0);
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"assess", path("a")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult r = run_program(arguments);
    EXPECT_EQ(r.status, 2) << r.out;
    return r.err;
  };
  EXPECT_THAT(refused({"--section", "s:0.2:4"}), HasSubstr("does not lie within the run of a"));
  EXPECT_THAT(refused({"--section", "s:0.2"}), HasSubstr("write NAME:FROM:TO"));
  EXPECT_THAT(refused({"--section", "s:0.2:x"}), HasSubstr("'x' is no number"));
  EXPECT_THAT(refused({"--section", "s:0.2:0.8:bend"}), HasSubstr("kinds: straight, curve, transition"));
  EXPECT_THAT(refused({"--channels", "ws1_left.q_N"}), HasSubstr("did you mean 'ws1_left.Q_N'?"));
  EXPECT_THAT(refused({"--json", path("a")}), HasSubstr("it is a folder"));
  refused({"--vehicle", "tram"});
  EXPECT_NE(run_program({"assess", input_.folder().string()}).status, 0);
  EXPECT_NE(run_program({"assess", path("vehicle.toml")}).status, 0);
  // a metre holds no window of two
  const ProgramResult brief = run_program({"assess", path("a")});
  EXPECT_EQ(brief.status, 0);
  EXPECT_THAT(brief.out, AllOf(HasSubstr("no value: the section is shorter than a mean or a filter needs (too_short)"),
                               Not(HasSubstr("YQ_2m  "))));
}

}  // namespace
}  // namespace treadmark::testing
