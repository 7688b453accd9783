// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/kept_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/wheelrail/problem_bytes.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"
#include "treadmark/tests/support/file_content.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const vehicle::CreepTableOptions kCoarse{3, 2, 2.0, 8, 6};

std::vector<std::byte> bytes_of(const vehicle::CreepTable& table) {
  ByteWriter out;
  table.save(out);
  return out.bytes();
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(KeptTables, ThisBuildKnowsWhatComputes) {
  EXPECT_EQ(app::computing_identity().size(), 64u) << "no build ID in the program: nothing would ever be kept";
}

TEST(KeptTables, CreepTablesAreMadeOnce) {
  const SampleInput input;
  const io::ContentCache cache(input.folder() / "cache");
  int parts = 0;
  const auto report = [&](std::size_t, std::size_t) { ++parts; };
  const auto made = app::kept_creep_table(nullptr, 0.28, kCoarse, report);
  const int all = parts;
  EXPECT_GT(all, 0);
  EXPECT_EQ(bytes_of(*app::kept_creep_table(&cache, 0.28, kCoarse, report)), bytes_of(*made));
  EXPECT_EQ(parts, 2 * all);
  EXPECT_EQ(bytes_of(*app::kept_creep_table(&cache, 0.28, kCoarse, report)), bytes_of(*made));
  EXPECT_EQ(parts, 2 * all) << "it was made again";

  // Whatever decides it makes another entry.
  app::kept_creep_table(&cache, 0.29, kCoarse);
  for (auto change :
       {+[](vehicle::CreepTableOptions& o) { o.intervals = 2; },
        +[](vehicle::CreepTableOptions& o) { o.ratio_intervals = 3; },
        +[](vehicle::CreepTableOptions& o) { o.greatest_ratio = 3.0; },
        +[](vehicle::CreepTableOptions& o) { o.nx = 7; }, +[](vehicle::CreepTableOptions& o) { o.ny = 7; }}) {
    vehicle::CreepTableOptions other = kCoarse;
    change(other);
    app::kept_creep_table(&cache, 0.28, other);
  }
  EXPECT_EQ(entries(cache.folder()).size(), 7u);
}

TEST(KeptTables, WhatATableGrowsByIsKept) {
  const SampleInput input;
  const io::ContentCache cache(input.folder() / "cache");
  const wheelrail::Geometry bodies{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
                                   analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46), true, true};
  const auto grown = [&](const io::ContentCache* kept) {
    const auto table = app::kept_contact_table(kept, "these bodies", bodies, wheelrail::Problem(), 5e4);
    const vehicle::TableStretch* const beside = table->at(-14e-3);
    ByteWriter out;
    vehicle::write_columns(beside->columns, out);
    vehicle::write_columns(table->heavier(*beside)->columns, out);
    return out.bytes();
  };
  const auto made = grown(nullptr);
  EXPECT_EQ(grown(&cache), made);
  const auto kept = entries(cache.folder());
  EXPECT_EQ(kept.size(), 4u) << "round the middle and beside, without and with the heavier loads";
  EXPECT_EQ(grown(&cache), made);
  EXPECT_EQ(entries(cache.folder()), kept);
}

// An entry whose frame is whole but whose content is none (of a fault in some other program) does not count either.
TEST(KeptTables, ContentThatIsNoTableIsMadeAnew) {
  const SampleInput input;
  const io::ContentCache cache(input.folder() / "cache");
  const auto made = app::kept_creep_table(&cache, 0.28, kCoarse);
  const fs::path file = entries(cache.folder()).at(0);
  std::string text = content_of(file);
  const std::size_t from = text.find("creep table "), till = text.find(app::computing_identity()) + 64;
  ASSERT_LT(from, till);
  const std::string key = text.substr(from, till - from);
  ASSERT_TRUE(cache.find(key));
  std::vector<std::byte> shorter = *cache.find(key), longer = shorter;
  shorter.resize(shorter.size() - 8);
  longer.resize(longer.size() + 8);
  for (const auto& wrong : {shorter, longer, std::vector<std::byte>{}}) {
    cache.keep(key, wrong);
    EXPECT_EQ(bytes_of(*app::kept_creep_table(&cache, 0.28, kCoarse)), bytes_of(*made));
  }
}

TEST(KeptTables, EveryPartOfAProblemDecides) {
  const auto bytes = [](auto change) {
    wheelrail::Problem p;
    change(p);
    ByteWriter out;
    wheelrail::write(p, out);
    return out.bytes();
  };
  using P = wheelrail::Problem;
  const auto plain = bytes([](P&) {});
  EXPECT_EQ(bytes([](P&) {}), plain);
  const std::vector<std::function<void(P&)>> changes{
      [](P& p) { p.track.cant = 0.025; },
      [](P& p) { p.track.gauge_width += 1e-3; },
      [](P& p) { p.wheelset.tape_line = 0.0; },
      [](P& p) { p.wheelset.nominal_radius = 0.5; },
      [](P& p) {
        p.roller = wheelrail::Roller{1.0, 2.0};
      },
      [](P& p) { p.vertical_force = 1.0; },
      [](P& p) { p.discretisation.dx *= 2.0; },
      [](P& p) { p.discretisation.turning = 1e-3; },
      [](P& p) { p.discretisation.usual_dq_relative = 1.0; },
      [](P& p) {
        p.discretisation.search_method = wheelrail::Discretisation{}.search_method == SearchMethod::locus
                                             ? SearchMethod::full_grid
                                             : SearchMethod::locus;
      },
      [](P& p) { p.material.poisson_2 = 0.3; },
      [](P& p) { p.material.relaxation_time_2 = 1.0; },
      [](P& p) { p.friction.kinetic = 0.1; },
      [](P& p) { p.friction.temperature_range = 2.0; },
      [](P& p) { p.solver.eps = 1e-6; },
      [](P& p) { p.solver.conventions = Conventions::contact; },
      [](P& p) { p.fastsim.flexibility = 1.0; },
      [](P& p) { p.influence.inclination = {0.1}; },
      [](P& p) { p.thermal = Thermal{}; },
      [](P& p) { p.damping = Damping{}; },
      [](P& p) { p.surface_loads = true; },
      [](P& p) { p.friction_inclination = {0.1}; },
      [](P& p) { p.friction_laws = {FrictionLaw{}}; }};
  std::vector<std::vector<std::byte>> all{plain};
  for (const auto& change : changes) {
    const auto other = bytes(change);
    EXPECT_EQ(std::count(all.begin(), all.end(), other), 0) << "change " << all.size();
    all.push_back(other);
  }
}

/// Both wheels of the sample from a table, without a defect.
class TableRuns : public ::testing::Test {
 protected:
  void SetUp() override {
    input.edit("simulation.toml", "contact = \"full\"\npitch_deg", "contact = \"table\"\npitch_deg");
    input.edit("simulation.toml", "contact = \"full\"\ndefects", "contact = \"table\"\ndefects");
    input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.3");
  }
  /// TREADMARK_CACHE=cache treadmark simulate ...
  std::vector<std::string> command(const std::string& cache, const std::string& folder,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{
        "env", "TREADMARK_CACHE=" + cache, "treadmark", "simulate", input.path("simulation.toml"), "--quiet",
        "-o",  input.path(folder)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  void run(const std::string& cache, const std::string& folder, const std::vector<std::string>& more = {}) const {
    const ProgramResult r = RunningProgram(command(cache, folder, more)).wait();
    ASSERT_EQ(r.status, 0) << r.err;
  }
  void expect_same(const std::string& one, const std::string& other) const {
    for (const char* file : {"simulation.h5", "history.csv", "modes.csv"}) {
      const std::string bytes = input.read(one + '/' + file);
      EXPECT_FALSE(bytes.empty()) << file;
      EXPECT_TRUE(bytes == input.read(other + '/' + file)) << file << " differs";
    }
  }
  SampleSimulation input;
};

TEST_F(TableRuns, ACacheChangesNoByte) {
  const std::string cache = input.path("cache");
  run("off", "without");
  EXPECT_TRUE(entries(cache).empty());
  run(cache, "made");
  const auto kept = entries(cache);
  EXPECT_EQ(kept.size(), 1u);
  run(cache, "found");
  EXPECT_EQ(entries(cache), kept);
  expect_same("without", "made");
  expect_same("without", "found");

  // Damaged ones are made anew.
  const std::string whole = input.read("cache/" + kept.at(0).filename().string());
  std::ofstream(kept.at(0), std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() / 2);
  run(cache, "cut");
  expect_same("without", "cut");
  EXPECT_TRUE(input.read("cache/" + kept.at(0).filename().string()) == whole);

  // A place that cannot be written to does no harm.
  run("/proc/nowhere", "nowhere");
  expect_same("without", "nowhere");

  // Another friction is another table.
  run(cache, "slippery", {"--set", "friction.coefficient=0.1"});
  EXPECT_EQ(entries(cache).size(), 2u);
}

TEST_F(TableRuns, ProcessesAtTheSameTimeShareACache) {
  const std::string cache = input.path("cache");
  run("off", "without");
  {
    RunningProgram one(command(cache, "one")), two(command(cache, "two"));
    EXPECT_EQ(one.wait().status, 0);
    EXPECT_EQ(two.wait().status, 0);
  }
  expect_same("without", "one");
  expect_same("without", "two");
  EXPECT_EQ(entries(cache).size(), 1u);
}

TEST_F(TableRuns, CreepForcesOfTheExactTheory) {
  const std::string cache = input.path("cache");
  const std::vector<std::string> exact{"--set", "simulation.creep_forces=exact_table"};
  input.edit("simulation.toml", "distance_m = 0.3", "distance_m = 30");
  run(cache, "linear");
  run(cache, "exact", exact);
  EXPECT_EQ(entries(cache).size(), 2u) << "a table of contacts, and one of creep forces";
  EXPECT_NE(input.read("linear/history.csv"), input.read("exact/history.csv"));

  // Killed between two checkpoints and gone on with.
  input.edit("simulation.toml", "checkpoint_s = 0.02", "checkpoint_s = 0.001");
  run(cache, "undisturbed", exact);
  bool killed = false;
  for (int attempt = 0; attempt < 5 && !killed; ++attempt) {
    RunningProgram program(command(cache, "killed", exact));
    while (program.running() && !fs::exists(input.path("killed/unfinished.h5")))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    killed = program.running();
    program.send(SIGKILL);
    program.wait();
  }
  EXPECT_TRUE(killed) << "never killed between the first checkpoint and the end";
  std::vector<std::string> resume = exact;
  resume.push_back("--resume");
  run(cache, "killed", resume);
  expect_same("undisturbed", "killed");
}

TEST_F(TableRuns, MaterialsThatTheTableIsNotForAreRefused) {
  const ProgramResult r =
      run_program({"check", input.path("simulation.toml"), "--set", "simulation.creep_forces=exact_table", "--set",
                   "material.rail_shear_modulus_GPa=1"});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("creep forces from the table"));
  EXPECT_THAT(r.err, HasSubstr("simulation.creep_forces"));
}

}  // namespace
}  // namespace treadmark::testing
