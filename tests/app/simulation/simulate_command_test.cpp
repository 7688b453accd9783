// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Simulate : public ::testing::Test {
 protected:
  ProgramResult run(std::vector<std::string> options) const {
    options.insert(options.begin(), {"simulate", input.path("simulation.toml")});
    return run_program(options);
  }
  std::string out() const { return input.path("out"); }
  SampleSimulation input;
};

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
  std::vector<double> column(const std::string& name) const {
    const auto at = static_cast<std::size_t>(ranges::find(names, name) - names.begin());
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row.at(at));
    return values;
  }
};

Table read_table(const std::string& text) {
  std::istringstream lines(text);
  std::string line, field;
  Table table;
  std::getline(lines, line);
  for (std::istringstream fields(line); std::getline(fields, field, ',');) table.names.push_back(field);
  while (std::getline(lines, line)) {
    table.rows.emplace_back();
    for (std::istringstream fields(line); std::getline(fields, field, ',');)
      table.rows.back().push_back(std::stod(field));
  }
  return table;
}

TEST_F(Simulate, WritesEveryFileAndASummary) {
  const ProgramResult r = run({"-o", out()});
  ASSERT_EQ(r.status, 0) << r.err;
  for (const char* word : {"A flat: complete", "q_max", "integration"}) EXPECT_THAT(r.out, HasSubstr(word));
  for (const char* file : {"simulation.h5", "history.csv", "events.csv", "modes.csv", "history.svg"})
    EXPECT_TRUE(std::filesystem::exists(out() + '/' + file)) << file;
  EXPECT_FALSE(std::filesystem::exists(out() + "/unfinished.h5"));
  EXPECT_THAT(input.read("out/history.csv"), StartsWith("t_s,x_m,Q_N,Ty_N,"));
  EXPECT_THAT(input.read("out/events.csv"), StartsWith("t_s,x_m,wheel,kind\n"));
}

TEST_F(Simulate, JsonSumsUpTheHistory) {
  const ProgramResult r = run({"-o", out(), "--json", "-"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_EQ(json["status"], "complete");
  const Table history = read_table(input.read("out/history.csv"));
  const auto q = history.column("Q_N"), x = history.column("x_m");
  const auto highest = ranges::max_element(q);
  EXPECT_EQ(json["summary"]["q_max_N"], *highest);
  EXPECT_EQ(json["summary"]["q_max_x_m"], x.at(static_cast<std::size_t>(highest - q.begin())));
  EXPECT_EQ(json["rows"], history.rows.size());
  EXPECT_GE(x.back(), 0.06 - 1e-9);
  EXPECT_EQ(json["static"]["ws1_left.Q_N"], q.front());
}

TEST_F(Simulate, TheSummaryCountsStepsThatAreNotWrittenDown) {
  const ProgramResult every = run({"-o", out(), "--json", "-"});
  const ProgramResult some = run({"-o", input.path("some"), "--json", "-", "--set", "simulation.output_every_mm=25"});
  ASSERT_EQ(every.status, 0) << every.err;
  ASSERT_EQ(some.status, 0) << some.err;
  const auto all_steps = nlohmann::json::parse(every.out), few_lines = nlohmann::json::parse(some.out);
  EXPECT_EQ(few_lines["summary"], all_steps["summary"]);
  const Table history = read_table(input.read("some/history.csv"));
  EXPECT_EQ(few_lines["rows"], history.rows.size());
  EXPECT_LT(5 * history.rows.size(), all_steps["rows"]);
  EXPECT_LT(ranges::max(history.column("Q_N")), few_lines["summary"]["q_max_N"])
      << "no peak is missing: the test says nothing";
}

TEST_F(Simulate, JsonGoesToAFileBesideTheTable) {
  const ProgramResult r = run({"--json", input.path("summary.json"), "--set", "simulation.distance_m=0.01"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("complete"));
  EXPECT_EQ(nlohmann::json::parse(input.read("summary.json"))["status"], "complete");
}

/// The load over the stiffness between sleepers, which is also where that stiffness comes out for a wheel that stands.
TEST_F(Simulate, RailsThatBendCarryTheWheels) {
  const std::string track =
      "simulation.track=" + std::string(TREADMARK_SOURCE_DIR) + "/examples/tracks/zhai-flexible.toml";
  const ProgramResult shown = run({"--set", track, "--receptance", input.path("track"), "--json", "-"});
  ASSERT_EQ(shown.status, 0) << shown.err;
  EXPECT_FALSE(std::filesystem::exists(out()));
  for (const char* file : {"receptance.csv", "track.svg"})
    EXPECT_TRUE(std::filesystem::exists(input.path("track/" + std::string(file)))) << file;
  const auto curves = nlohmann::json::parse(shown.out).at("curves");
  EXPECT_TRUE(curves.contains("lateral"));
  const double stiffness = curves.at("between").at("stiffness_at_rest_N_per_m");

  const ProgramResult r = run({"--set", track, "-o", out(), "--json", "-"});
  ASSERT_EQ(r.status, 0) << r.err;
  const Table history = read_table(input.read("out/history.csv"));
  const double load = history.column("Q_N").front();
  EXPECT_NEAR(history.column("rail_z_m").front(), load / stiffness, 1e-3 * load / stiffness);
  EXPECT_LT(std::abs(nlohmann::json::parse(r.out)["summary"]["energy_integration_error"].get<double>()), 1e-4);
}

/// A wheel flat leaves the rail and meets it again with friction used up: forces and motion agree, creep forces do not
/// flicker between both directions of sliding, and the vertical force is nearly that on rails that bend vertically
/// only.
TEST_F(Simulate, WheelsMeetRailsAgainThatBendSideways) {
  const std::string examples = TREADMARK_SOURCE_DIR "/examples/";
  double largest[2];
  int i = 0;
  for (const char* track : {"zhai-flexible", "zhai-sideways"}) {
    const ProgramResult r =
        run_program({"simulate", examples + "flat-at-speed.toml", "--set",
                     "simulation.track=tracks/" + std::string(track) + ".toml", "--set", "simulation.speed_m_s=10",
                     "--set", "simulation.distance_m=0.55", "--set", "simulation.wheels.0.pitch_deg=30", "--set",
                     "wheel.flats.0.length_mm=160", "--set", "case.regime=steady", "--set",
                     "solver.tangential_model=fastsim", "--json", "-"});
    ASSERT_EQ(r.status, 0) << r.err;
    const auto summary = nlohmann::json::parse(r.out)["summary"];
    largest[i++] = summary["q_max_N"];
    EXPECT_LT(std::abs(summary["energy_contact_error"].get<double>()), 2e-3) << track;
    EXPECT_LT(summary["ty_max_N"], 2e3) << track;
    EXPECT_GT(summary["ty_min_N"], -15e3) << track;
  }
  EXPECT_GT(largest[0], 100e3);
  EXPECT_NEAR(largest[1] / largest[0], 1.0, 0.01);
}

TEST_F(Simulate, ALumpedTrackShowsItsReceptance) {
  const ProgramResult shown = run({"--receptance", input.path("track"), "--json", "-"});
  ASSERT_EQ(shown.status, 0) << shown.err;
  EXPECT_NEAR(nlohmann::json::parse(shown.out).at("curves").at("rail").at("stiffness_at_rest_N_per_m").get<double>(),
              160e6, 1.0);
  input.edit("simulation.toml", "track = \"track.toml\"", "");
  EXPECT_THAT(run({"--receptance", input.path("rigid")}).err, HasSubstr("rigid"));
}

TEST_F(Simulate, ModesOnly) {
  const ProgramResult text = run({"--modes", "-o", out()});
  EXPECT_THAT(text.out, HasSubstr("ws1_right.Q_N"));
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("f [Hz]"));
  EXPECT_THAT(text.out, HasSubstr("mass.z"));
  EXPECT_FALSE(std::filesystem::exists(out()));
  const auto json = nlohmann::json::parse(run({"--modes", "--json", "-"}).out);
  const double bounce = std::sqrt(2.0 * 1.2e6 / 9000.0) / (2.0 * std::numbers::pi);  // the mass on its two springs
  EXPECT_NEAR(json["modes"].at(0)["frequency_Hz"], bounce, 0.01 * bounce) << "all below is much stiffer";
  EXPECT_EQ(json["rows"], 0);
}

TEST_F(Simulate, ModesGoToAFileBesideTheText) {
  const ProgramResult r = run({"--modes", "--json", input.path("modes.json")});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("f [Hz]"));
  EXPECT_FALSE(nlohmann::json::parse(input.read("modes.json"))["modes"].empty());
  const ProgramResult nowhere =
      run({"--modes", "--json", input.path("simulation.toml/modes.json")});  // a file, no folder
  EXPECT_EQ(nowhere.status, 2) << nowhere.err;
}

TEST_F(Simulate, SetChangesAKey) {
  const ProgramResult r =
      run({"-o", out(), "--set", "simulation.speed_m_s=10", "--set", "simulation.distance_m=0.02", "--json", "-"});
  ASSERT_EQ(r.status, 0) << r.err;
  const Table history = read_table(input.read("out/history.csv"));
  EXPECT_NEAR(history.column("x_m").back() / history.column("t_s").back(), 10.0, 1e-9);
  EXPECT_THAT(nlohmann::json::parse(r.out)["input"]["settings"].dump(), HasSubstr("simulation.speed_m_s=10"));
}

TEST_F(Simulate, QuietSaysNothingButResults) {
  input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.01");
  const ProgramResult r = run({"--quiet"});
  EXPECT_EQ(r.status, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_THAT(r.out, HasSubstr("complete"));
}

TEST_F(Simulate, FieldsAreDrawnAndStored) {
  const ProgramResult r =
      run({"-o", out(), "--set", "simulation.fields.position_m=[0.005]", "--set", "simulation.distance_m=0.01"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(std::filesystem::exists(out() + "/pressure.svg"));
  const io::SnapshotSeries snapshots = io::read_snapshots(out() + "/simulation.h5");
  ASSERT_GE(snapshots.run.cases.size(), 2u);
  ASSERT_EQ(snapshots.scenes.size(), snapshots.run.cases.size());
  EXPECT_TRUE(snapshots.scenes.front().nominal);
  for (const io::CaseResult& c : snapshots.run.cases) {
    ASSERT_TRUE(c.bodies);
    EXPECT_GE(io::surface_index(snapshots.run.sampled, c.wheel_surface), 0);
    EXPECT_GE(io::surface_index(snapshots.run.sampled, c.rail_surface), 0);
    ASSERT_FALSE(c.patches.empty());
    const io::PatchResult& p = c.patches.front();
    const Vec3 on_rail = c.bodies->X_TS.apply_inverse({p.x_tr, p.y_tr, p.z_tr});
    EXPECT_NEAR(on_rail.x(), c.s + p.x_tr, 1e-9) << "the rail passes below the wheel";
  }
}

TEST_F(Simulate, ContactWheelAndRailAreWrittenForParaViewOverTime) {
  const ProgramResult r = run({"-o", out(), "--vtk", "--set", "simulation.fields.position_m=[0.004, 0.008]", "--set",
                               "simulation.distance_m=0.01"});
  ASSERT_EQ(r.status, 0) << r.err;
  const io::SnapshotSeries snapshots = io::read_snapshots(out() + "/simulation.h5");
  const std::vector<double> history = read_table(input.read("out/history.csv")).column("t_s");
  std::map<double, std::set<std::string>> bodies, patches;
  const auto add = [&](const std::string& name, auto& to) {
    const XmlElement root = read_xml(input.read("out/vtk/" + name));
    for (const XmlElement* set : root.find("DataSet")) {
      to[std::stod(set->attributes.at("timestep"))].insert(set->attributes.at("file"));
      EXPECT_GT(std::filesystem::file_size(out() + "/vtk/" + set->attributes.at("file")), 1000u);
    }
  };
  add("bodies.pvd", bodies);
  add("snapshots.pvd", patches);
  const std::size_t cases = snapshots.run.cases.size();
  ASSERT_EQ(bodies.size(), 3u);  // at rest and at two places
  const std::size_t wheels = cases / bodies.size();
  ASSERT_EQ(cases, wheels * bodies.size());
  ASSERT_EQ(patches.size(), bodies.size());
  for (const auto& [time, files] : bodies) {
    EXPECT_TRUE(patches.contains(time));
    EXPECT_TRUE(ranges::any_of(history, [&](double t) { return std::fabs(t - time) < 1e-9; })) << time;
    EXPECT_EQ(files.size(), 2 * wheels);  // a wheel and a rail each
  }
  // The wheel goes on, the rail passes below it: no two places are the same.
  std::set<std::string> places;
  for (const auto& [time, files] : bodies) places.insert(files.begin(), files.end());
  EXPECT_EQ(places.size(), 2 * cases);
  const ProgramResult none = run({"-o", input.path("none"), "--vtk", "--set", "simulation.distance_m=0.01"});
  EXPECT_THAT(none.err, HasSubstr("simulation.fields"));
}

TEST_F(Simulate, AnyNumberOfThreadsGivesTheSameBytes) {
  ASSERT_EQ(run({"-o", input.path("one"), "--threads", "1"}).status, 0);
  ASSERT_EQ(run({"-o", input.path("three"), "--threads", "3"}).status, 0);
  for (const char* file : {"simulation.h5", "history.csv"})
    EXPECT_TRUE(input.read(std::string("one/") + file) == input.read(std::string("three/") + file)) << file;
}

TEST_F(Simulate, AnyNumberOfThreadsGivesTheSameBytesOnSharedRails) {
  input.share_rails();
  ASSERT_EQ(run({"-o", input.path("one"), "--threads", "1"}).status, 0);
  ASSERT_EQ(run({"-o", input.path("two"), "--threads", "2"}).status, 0);
  for (const char* file : {"simulation.h5", "history.csv"})
    EXPECT_TRUE(input.read(std::string("one/") + file) == input.read(std::string("two/") + file)) << file;
}

TEST_F(Simulate, AFailureOnTheWayKeepsWhatThereIs) {
  // Half a picometre of local error cannot be met with steps that may not become shorter than a microsecond.
  const ProgramResult r = run({"-o", out(), "--set", "simulation.tolerance_um=1e-9", "--set",
                               "simulation.min_step_us=1", "--set", "simulation.max_step_us=2"});
  EXPECT_EQ(r.status, 1) << r.out;
  EXPECT_THAT(r.err, StartsWith("treadmark: "));
  EXPECT_TRUE(std::filesystem::exists(out() + "/simulation.h5"));
  EXPECT_TRUE(std::filesystem::exists(out() + "/unfinished.h5"));
}

}  // namespace
}  // namespace treadmark::testing
