// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

// Contacts that are chosen between table and full contact.

namespace treadmark::testing {
namespace {

class ChosenContacts : public ::testing::Test {
 protected:
  io::SimulationResult run(std::vector<std::string> overrides) {
    overrides.insert(overrides.begin(), {"simulation.wheels=[]", "simulation.distance_m=0.15", "wheel.flats=[]"});
    return app::run_simulation(io::read_simulation_file(input.path("simulation.toml"), overrides), store, {}, {});
  }
  static double summary(const io::SimulationResult& r, const std::string& name) {
    const auto found = ranges::find(r.summary, name, &io::NamedValue::name);
    if (found != r.summary.end()) return found->value;
    ADD_FAILURE() << "no " << name;
    return 0.0;
  }

  static double last(const io::SimulationResult& of, const char* column) {
    return io::column_values(of, io::column_index(of, column)).back();
  }

  SampleSimulation input;
  app::SurfaceStore store;
};

TEST_F(ChosenContacts, AreTablesWhereTheseAreGoodEnough) {
  const io::SimulationResult tables = run({}),
                             chosen = run({"simulation.contact=auto", "simulation.auto_force_error=10",
                                           "simulation.auto_wear_error=1e6"});
  for (const char* column : {"Q_N", "ws1_right.Q_N"}) {
    const double of_tables = last(tables, column);
    EXPECT_NEAR(last(chosen, column), of_tables, 1e-4 * of_tables) << column;
  }
  EXPECT_EQ(summary(chosen, "ws1_left.full_share"), 0.0);
  EXPECT_GT(summary(chosen, "ws1_left.table_error_max"), 0.0) << "elements of 2 mm";
  EXPECT_LE(summary(chosen, "ws1_left.table_error_rms"), summary(chosen, "ws1_left.table_error_max"));
  EXPECT_TRUE(chosen.events.empty());
}

TEST_F(ChosenContacts, AreFullWhereTheyAreNot) {
  const std::vector<std::string> strict{"simulation.contact=auto", "simulation.auto_force_error=1e-9"};
  const io::SimulationResult r = run(strict);
  EXPECT_EQ(r.status, "complete") << r.message;
  for (const char* wheel : {"ws1_left", "ws1_right"}) {
    // From the start on, but for half of the 50 mm in which forces go over.
    EXPECT_NEAR(summary(r, std::string(wheel) + ".full_share"), 1.0 - 0.025 / 0.15, 0.02) << wheel;
    EXPECT_EQ(ranges::count(r.events, std::string(wheel), &io::HistoryEvent::wheel), 1) << wheel;
  }
  EXPECT_EQ(r.events.front().kind, "full contact from here");
  EXPECT_NEAR(r.events.front().position, 0.025, 0.005);
  const auto share = io::column_values(r, io::column_index(r, "full_share"));
  EXPECT_EQ(share.front(), 0.0);
  EXPECT_EQ(share.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(share.begin(), share.end()));
  // As a run whose contacts are full all the way; the change has shaken it.
  const io::SimulationResult full = run({"simulation.contact=full"});
  EXPECT_NEAR(last(r, "Q_N"), last(full, "Q_N"), 0.1 * last(full, "Q_N"));

  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(run(strict).values, r.values) << threads;
  }
}

TEST_F(ChosenContacts, AreRefusedForWheelsThatAreNotRound) {
  try {
    app::run_simulation(io::read_simulation_file(input.path("simulation.toml"),
                                                 std::vector<std::string>{"simulation.wheels.0.contact=auto"}),
                        store, {}, {});
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_THAT(e.message(), ::testing::HasSubstr("is not round"));
  }
}

}  // namespace
}  // namespace treadmark::testing
