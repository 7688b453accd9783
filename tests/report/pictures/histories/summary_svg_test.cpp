// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/histories/summary_svg.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/io/histories/sample_history.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark {
namespace {

class SummarySvg : public ::testing::Test {
 protected:
  SummarySvg() {
    int number = 0;
    for (const char* cant : {"0", "1:40 <new>"})
      for (const double speed : {60.0, 20.0, 100.0}) {
        io::SimulationRun run;
        run.number = ++number;
        run.swept = {{"vehicle.speed", fmt::format("{}", speed)}, {"rail.cant", cant}};
        run.status = "complete";
        run.summary = {{"q_max_N", 1e5 + 1e3 * speed + number, "N", "largest vertical force"}};
        study_.runs.push_back(run);
      }
    chart_.title = "impact & load";
    chart_.key = "vehicle.speed";
    chart_.x_label = "V [m/s]";
    chart_.quantity = "q_max_N";
    chart_.y_label = "Q [kN]";
    chart_.y_factor = 1e-3;
    chart_.references = {{60.0, 462e3, "paper: 462 kN at 60 m/s"}};
    chart_.level = 62e3;
    chart_.level_label = "static load";
  }

  io::StudyResult study_;
  pictures::SummaryChart chart_;
};

TEST_F(SummarySvg, ALineForEachChoiceOfTheOtherKeys) {
  const std::string svg = pictures::summary_svg(study_, chart_);
  const testing::XmlElement root = testing::read_xml(svg);
  EXPECT_EQ(root.find("g", "class", "chart").at(0)->find("path", "class", "line").size(), 2u);
  EXPECT_EQ(root.find("g", "class", "chart").at(0)->find("path", "class", "level").size(), 1u);
  EXPECT_EQ(root.find("g", "class", "chart").at(0)->find("path", "class", "mark").size(), 7u);
  EXPECT_NE(svg.find("rail.cant = 1:40 &lt;new&gt;"), std::string::npos);
  EXPECT_NE(svg.find(">paper: 462 kN at 60 m/s</text>"), std::string::npos);
  EXPECT_NE(svg.find(">static load<"), std::string::npos);
}

TEST_F(SummarySvg, TheTableIsSortedByTheKey) {
  const auto lines = testing::read_lines(pictures::summary_chart_csv(study_, chart_));
  ASSERT_EQ(lines.size(), 9u);
  EXPECT_EQ(lines[0], "kind,line,run,vehicle.speed,q_max_N");
  EXPECT_EQ(lines[1], "run,rail.cant = 0,2,20,120002");
  EXPECT_EQ(lines[3], "run,rail.cant = 0,3,100,200003");
  EXPECT_EQ(lines[6], "run,rail.cant = 1:40 <new>,6,100,200006");
  EXPECT_EQ(lines[7], "reference,paper: 462 kN at 60 m/s,,60,462000");
  EXPECT_EQ(lines[8], "level,static load,,,62000");
}

TEST_F(SummarySvg, RunsWithoutAResultAreNamed) {
  study_.runs[1].summary.clear();
  study_.runs[1].status = "failed";
  study_.runs[1].label = "V20";
  const std::string svg = pictures::summary_svg(study_, chart_);
  EXPECT_NE(svg.find("not drawn: run 2, V20 (failed)"), std::string::npos);
  EXPECT_EQ(testing::read_lines(pictures::summary_chart_csv(study_, chart_)).size(), 8u);
}

TEST_F(SummarySvg, RefusesWhatCannotBeDrawn) {
  const auto expect_refused = [&](const std::string& words) {
    try {
      pictures::summary_svg(study_, chart_);
      FAIL() << words;
    } catch (const Error& error) {
      EXPECT_NE(error.message().find(words), std::string::npos) << error.message();
    }
  };
  chart_.key = "speed";
  expect_refused("no run has the swept key speed");
  chart_.key = "vehicle.speed";
  chart_.quantity = "q";
  expect_refused("no run has the quantity q");
  chart_.quantity = "q_max_N";
  chart_.x_factor = 0.0;
  expect_refused("factor");
  chart_.x_factor = 1.0;
  study_.runs[3].swept[0].second = "60 m/s";
  expect_refused("\"60 m/s\", vehicle.speed of run 4, is no number");
}

}  // namespace
}  // namespace treadmark
