// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_pictures.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/chart_marker.hpp"
#include "treadmark/io/results/comparison_cases.hpp"
#include "treadmark/io/results/picture_patch.hpp"
#include "treadmark/tests/io/results/comparison_sample.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string> texts(const testing::XmlElement& root) {
  std::vector<std::string> out;
  for (const auto* text : root.find("text")) out.push_back(text->text);
  return out;
}

bool says(const testing::XmlElement& root, const std::string& words) {
  const auto all = texts(root);
  return std::find(all.begin(), all.end(), words) != all.end();
}

/// Marks of a style, by the colour of their edge.
std::size_t count_marks(const testing::XmlElement& root, int style) {
  std::size_t count = 0;
  for (const auto* mark : root.find("path", "class", "mark"))
    count += mark->attributes.at("stroke") == io::chart_colour(style);
  return count;
}

TEST(TellingCases, TheFirstAndThoseWithTheWidestSpread) {
  io::Comparison comparison;
  comparison.candidates.resize(3);
  const std::vector<double> first{0.0, 0.3, -0.1, 0.0, 0.1}, second{0.0, 0.3, 0.15, kNan, -0.25};
  for (int i = 0; i < 5; ++i) {
    comparison.candidates[0].rows.push_back(testing::sample_row(10 + i, 0.0));
    comparison.candidates[1].rows.push_back(testing::sample_row(10 + i, first[static_cast<std::size_t>(i)]));
    comparison.candidates[2].rows.push_back(testing::sample_row(10 + i, second[static_cast<std::size_t>(i)]));
  }
  // Spreads with the truth's zero: 0, 0.3, 0.25, 0, 0.35.
  EXPECT_EQ(io::telling_cases(comparison, 3), (std::vector<int>{10, 11, 14}));
  EXPECT_EQ(io::telling_cases(comparison, 4), (std::vector<int>{10, 11, 12, 14}));
  EXPECT_EQ(io::telling_cases(comparison, 9).size(), 5u);
  EXPECT_TRUE(io::telling_cases({}, 3).empty());
  for (auto& candidate : comparison.candidates)
    for (auto& row : candidate.rows) row.comparable = false;
  EXPECT_EQ(io::telling_cases(comparison, 3), (std::vector<int>{10, 11, 12}));  // all equal: the earlier ones
}

TEST(PressuresSvg, APanelACandidateAndCase) {
  const testing::XmlElement root = testing::read_xml(io::pressures_svg(testing::sample_comparison()));
  EXPECT_EQ(root.find("g", "class", "panel").size(), 15u);  // five candidates, three of the four cases
  for (const char* words : {"analytic (truth)", "mesh 1 mm", "mesh 0.5 mm", "spline", "vdb 1 mm", "failed", "1000 MPa",
                            "1100 MPa, +10.0 %", "960 MPa, -20.0 %", "1200 MPa, 0.00 %"})
    EXPECT_TRUE(says(root, words)) << words;
  EXPECT_FALSE(says(root, "case 4, pitch -22.92°"));
  EXPECT_TRUE(says(root, "case 2, pitch -11.46°"));
}

TEST(PressuresSvg, ColoursAndWindowAreTheSameAlongARow) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates.resize(2);
  for (auto& candidate : comparison.candidates) {
    candidate.rows.resize(1);
    candidate.results.resize(1);
  }
  comparison.candidates[1].results[0].patches[0] = testing::ball_patch(20, 16, 0.5e9);  // half of the truth's
  comparison.candidates[1].results[0].patches[0].fields.X_TC.origin.x() = 2e-3;
  const testing::XmlElement root = testing::read_xml(io::pressures_svg(comparison));
  const auto panels = root.find("g", "class", "panel");
  ASSERT_EQ(panels.size(), 2u);
  const auto steps = [](const testing::XmlElement& panel) {
    int count = 0;
    for (int step = 0; step < io::kPressureSteps; ++step)
      count += !panel.find("path", "fill", io::step_colour(step)).empty();
    return count;
  };
  EXPECT_EQ(steps(*panels[0]), io::kPressureSteps);
  EXPECT_LE(steps(*panels[1]), io::kPressureSteps / 2 + 1);
  EXPECT_GE(steps(*panels[1]), io::kPressureSteps / 2 - 1);
  std::vector<std::string> numbers[2];
  for (int i = 0; i < 2; ++i)
    for (const std::string& text : texts(*panels[i]))
      if (text.find_first_not_of("-.0123456789") == std::string::npos) numbers[i].push_back(text);
  EXPECT_GE(numbers[0].size(), 6u);
  EXPECT_EQ(numbers[0], numbers[1]);
}

TEST(PressuresSvg, ShowsThePatchThatCarriesMost) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates.resize(1);
  auto& patches = comparison.candidates[0].results[0].patches;
  patches.insert(patches.begin(), testing::ball_patch(10, 10, 1e8));  // 100 cells of which some are in contact
  const testing::XmlElement root = testing::read_xml(io::pressures_svg(comparison));
  const testing::XmlElement alone = [] {
    io::Comparison one = testing::sample_comparison();
    one.candidates.resize(1);
    return testing::read_xml(io::pressures_svg(one));
  }();
  const auto base = [](const testing::XmlElement& picture) {
    return picture.find("path", "fill", io::step_colour(0)).at(0)->attributes.at("d");
  };
  EXPECT_EQ(base(root), base(alone));
}

TEST(PressuresSvg, RefusesFieldsThatDoNotMatchTheirGrid) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[1].results[0].patches[0].fields.pressure.pop_back();
  EXPECT_THROW(io::pressures_svg(comparison), Error);
}

TEST(ErrorSvg, APointForEachResolutionAndALevelWithoutOne) {
  const testing::XmlElement root = testing::read_xml(io::error_svg(testing::sample_comparison()));
  const auto charts = root.find("g", "class", "chart");
  ASSERT_EQ(charts.size(), 2u);
  // Styles go by the order of the names: analytic 0, mesh 1, spline 2, vdb 3. The truth is not shown.
  EXPECT_EQ(count_marks(*charts[0], 0), 0u);
  EXPECT_EQ(count_marks(*charts[0], 1), 2u);
  EXPECT_EQ(count_marks(*charts[0], 2), 0u);
  EXPECT_EQ(charts[0]->find("path", "class", "line").size(), 1u);
  EXPECT_EQ(charts[0]->find("path", "class", "level").size(), 1u);  // spline: zero, at the floor
  EXPECT_EQ(count_marks(*charts[1], 1), 2u);
  EXPECT_EQ(charts[1]->find("path", "class", "level").size(), 0u);  // its surface was not measured
  const auto titles = charts[0]->find("title");
  ASSERT_EQ(titles.size(), 2u);
  EXPECT_EQ(titles[0]->text, "mesh 0.5 mm: 5 %");
  EXPECT_EQ(titles[1]->text, "mesh 1 mm: 20 %");
  EXPECT_TRUE(says(root, "truth: analytic &lt;profiles&gt; &amp; flats"));
  EXPECT_TRUE(says(root, "resolution [mm]"));
}

TEST(CostSvg, AMarkACandidateAndTheRestInWords) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[2].wheel.memory_bytes = 15000000;  // 16 MB against 4 MB: twice the width
  const testing::XmlElement root = testing::read_xml(io::cost_svg(comparison));
  const auto marks = root.find("g", "class", "chart").at(0)->find("path", "class", "mark");
  ASSERT_EQ(marks.size(), 4u);
  for (const char* words :
       {"analytic (truth)", "mesh 1 mm", "mesh 0.5 mm", "spline", "not drawn: vdb 1 mm (failed)", "16 MB", "4 MB"})
    EXPECT_TRUE(says(root, words)) << words;
  // Errors of zero are drawn hollow at the floor.
  int hollow = 0;
  for (const auto* mark : marks) hollow += mark->attributes.at("fill") == "#ffffff";
  EXPECT_EQ(hollow, 2);
  const auto titles = root.find("title");
  ASSERT_EQ(titles.size(), 4u);
  EXPECT_EQ(titles[1]->text, "mesh 0.5 mm: 11 ms, 5 %, 16 MB");  // the larger marker first
}

/// Every picture is well-formed and has no script and no number that is none.
void expect_sound(const io::Comparison& comparison) {
  for (const std::string& svg : {io::pressures_svg(comparison), io::error_svg(comparison), io::cost_svg(comparison)}) {
    const testing::XmlElement root = testing::read_xml(svg);
    EXPECT_EQ(root.name, "svg");
    EXPECT_TRUE(root.find("script").empty());
    std::vector<const testing::XmlElement*> stack{&root};
    while (!stack.empty()) {
      const testing::XmlElement& element = *stack.back();
      stack.pop_back();
      for (const auto& [name, value] : element.attributes) {
        EXPECT_FALSE(name.starts_with("on"));
        EXPECT_EQ(value.find("nan"), std::string::npos) << element.name << " " << name << "=" << value;
        EXPECT_EQ(value.find("inf"), std::string::npos) << element.name << " " << name << "=" << value;
      }
      for (const auto& child : element.children) stack.push_back(&child);
    }
  }
}

TEST(ComparisonPictures, AreSoundForEveryContent) {
  const io::Comparison sample = testing::sample_comparison();
  expect_sound({});
  expect_sound(sample);
  for (const std::size_t count : {1u, 2u}) {
    io::Comparison few = sample;
    few.candidates.resize(count);
    expect_sound(few);
  }
  io::Comparison failed = sample;
  failed.candidates.erase(failed.candidates.begin(), failed.candidates.end() - 1);
  expect_sound(failed);
  io::Comparison named = sample;
  named.candidates[1].name = "<b a=\"c\">&\x01\xff";
  named.truth = "]]> -- &amp;";
  expect_sound(named);
  io::Comparison bare = sample;  // rows without fields
  for (auto& candidate : bare.candidates) candidate.results.clear();
  expect_sound(bare);
  EXPECT_NE(io::pressures_svg(bare).find("no fields"), std::string::npos);
}

TEST(ComparisonPictures, AreSoundForEveryNumber) {
  for (const double value : {0.0, -1.0, kNan, kInfinity, -kInfinity, 1e308, 5e-324}) {
    io::Comparison comparison = testing::sample_comparison();
    for (auto& candidate : comparison.candidates) {
      for (auto& row : candidate.rows) row.pmax_error = row.search_s = row.pmax = value;
      candidate.wheel.difference.height_max = candidate.rail.difference.height_max = value;
    }
    expect_sound(comparison);
    for (auto& candidate : comparison.candidates) candidate.resolution = value;
    expect_sound(comparison);
    for (double& pressure : comparison.candidates[1].results[0].patches[0].fields.pressure) pressure = value;
    expect_sound(comparison);
  }
}

TEST(ComparisonPictures, FilesAppearWhole) {
  const testing::TemporaryFolder folder;
  const io::Comparison comparison = testing::sample_comparison();
  io::write_pressures_svg(folder.path() / "pressures.svg", comparison);
  io::write_error_svg(folder.path() / "errors.svg", comparison);
  io::write_cost_svg(folder.path() / "costs.svg", comparison);
  EXPECT_EQ(folder.count_files(), 3u);
  EXPECT_EQ(testing::read_text(folder.path() / "pressures.svg"), io::pressures_svg(comparison));
  EXPECT_EQ(testing::read_text(folder.path() / "errors.svg"), io::error_svg(comparison));
  EXPECT_EQ(testing::read_text(folder.path() / "costs.svg"), io::cost_svg(comparison));
  EXPECT_THROW(io::write_cost_svg(folder.path(), comparison), Error);
}

}  // namespace
}  // namespace treadmark
