// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/history_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/io/histories/sample_history.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

TEST(HistoryCsv, EveryNumberReadsBackExactly) {
  const testing::TemporaryFolder folder;
  io::SimulationResult result = testing::sample_simulation(33.3, 101);
  result.columns[3].name = "a,\"b\"";
  result.values[2] = 0.1 + 0.2;
  result.values[3] = -std::numeric_limits<double>::quiet_NaN();
  result.values[7] = 5e-324;
  io::write_history_csv(folder.path() / "history.csv", result);
  const auto lines = testing::read_lines(testing::read_text(folder.path() / "history.csv"));
  ASSERT_EQ(lines.size(), 102u);
  EXPECT_EQ(lines[0], "t_s,x_m,ws1_right.Q_N,\"a,\"\"b\"\"\"");
  for (std::size_t row = 0; row < 101; ++row) {
    std::istringstream line(lines[row + 1]);
    for (std::size_t column = 0; column < 4; ++column) {
      std::string cell;
      ASSERT_TRUE(std::getline(line, cell, ','));
      const double wanted = result.values[4 * row + column], read = std::strtod(cell.c_str(), nullptr);
      EXPECT_TRUE(read == wanted || (std::isnan(wanted) && cell == "nan")) << cell;
    }
  }
}

TEST(HistoryCsv, EventsAndModesHaveTheirTables) {
  const testing::TemporaryFolder folder;
  io::SimulationResult result = testing::sample_simulation(10.0, 11);
  result.events[0].position = 0.45;
  io::write_events_csv(folder.path() / "events.csv", result);
  io::write_modes_csv(folder.path() / "modes.csv", result);
  EXPECT_EQ(testing::read_text(folder.path() / "events.csv"),
            "t_s,x_m,wheel,kind\n0.045,0.45,ws1_right,contact lost\n0.05,0.5,ws1_right,contact regained\n");
  EXPECT_EQ(testing::read_text(folder.path() / "modes.csv"),
            "frequency_Hz,damping_ratio,shape\n1.2,0.15,bounce of the body\n45,0.08,\"wheelset, \"\"vertical\"\"\"\n");
}

TEST(HistoryCsv, RefusesRowsThatAreNotWhole) {
  const testing::TemporaryFolder folder;
  io::SimulationResult result = testing::sample_simulation(40.0, 11);
  result.values.push_back(0.0);
  EXPECT_THROW(io::write_history_csv(folder.path() / "history.csv", result), Error);
  EXPECT_EQ(folder.count_files(), 0u);
}

}  // namespace
}  // namespace treadmark
