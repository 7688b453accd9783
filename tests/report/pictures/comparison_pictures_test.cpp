// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/comparison_pictures.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/comparison_cases.hpp"
#include "treadmark/report/pictures/patch_picture.hpp"
#include "treadmark/tests/io/results/comparison_sample.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark {
namespace {

std::vector<std::string> texts(const testing::XmlElement& root) {
  std::vector<std::string> out;
  for (const auto* text : root.find("text")) out.push_back(text->text);
  return out;
}

bool has_text(const testing::XmlElement& root, const std::string& words) {
  const auto all = texts(root);
  return std::find(all.begin(), all.end(), words) != all.end();
}

/// Marks of a style, by the colour of their edge.
std::size_t count_marks(const testing::XmlElement& root, int style) {
  std::size_t count = 0;
  for (const auto* mark : root.find("path", "class", "mark"))
    count += mark->attributes.at("stroke") == pictures::chart_colour(style);
  return count;
}

TEST(TellingCases, TheFirstAndThoseWithTheWidestSpread) {
  io::Comparison comparison;
  comparison.candidates.resize(3);
  const std::vector<double> first{0.0, 0.3, -0.1, 0.0, 0.1}, second{0.0, 0.3, 0.15, kNaN, -0.25};
  for (int i = 0; i < 5; ++i) {
    comparison.candidates[0].rows.push_back(testing::sample_row(10 + i, 0.0));
    comparison.candidates[1].rows.push_back(testing::sample_row(10 + i, first[static_cast<std::size_t>(i)]));
    comparison.candidates[2].rows.push_back(testing::sample_row(10 + i, second[static_cast<std::size_t>(i)]));
  }
  // Spreads with the truth's zero: 0, 0.3, 0.25, 0, 0.35.
  EXPECT_EQ(pictures::telling_cases(comparison, 3), (std::vector<int>{10, 11, 14}));
  EXPECT_EQ(pictures::telling_cases(comparison, 4), (std::vector<int>{10, 11, 12, 14}));
  EXPECT_EQ(pictures::telling_cases(comparison, 9).size(), 5u);
  EXPECT_TRUE(pictures::telling_cases({}, 3).empty());
  for (auto& candidate : comparison.candidates)
    for (auto& row : candidate.rows) row.comparable = false;
  EXPECT_EQ(pictures::telling_cases(comparison, 3), (std::vector<int>{10, 11, 12}));  // all equal: the earlier ones
}

TEST(PressuresSvg, APanelACandidateAndCase) {
  const testing::XmlElement root = testing::read_xml(pictures::pressures_svg(testing::sample_comparison()));
  EXPECT_EQ(root.find("g", "class", "panel").size(), 15u);  // five candidates, three of the four cases
  for (const char* words : {"analytic (reference)", "mesh 1 mm", "mesh 0.5 mm", "spline", "vdb 1 mm", "failed",
                            "1000 MPa", "1100 MPa, +10.0 %", "960 MPa, -20.0 %", "1200 MPa, 0.00 %"})
    EXPECT_TRUE(has_text(root, words)) << words;
  EXPECT_FALSE(has_text(root, "case 4, pitch -22.92°"));
  EXPECT_TRUE(has_text(root, "case 2, pitch -11.46°"));
}

struct Point {
  double x = 0.0, y = 0.0;
};

Point moved(const testing::XmlElement& group) {
  Point out;
  const std::string& words = group.attributes.at("transform");
  EXPECT_EQ(std::sscanf(words.c_str(), "translate(%lf %lf)", &out.x, &out.y), 2) << words;
  return out;
}

/// A panel as it stands in the picture.
struct SeenPanel {
  std::string name;  ///< lines joined by a blank
  Point corner;
  double width = 0.0, height = 0.0;
};

std::vector<SeenPanel> seen_panels(const testing::XmlElement& block) {
  const Point origin = moved(block);
  std::vector<SeenPanel> out;
  for (const auto* panel : block.find("g", "class", "panel")) {
    SeenPanel seen;
    for (const auto* line : panel->find("text", "class", "title"))
      seen.name += (seen.name.empty() || seen.name.back() == '+' ? "" : " ") + line->text;
    const Point corner = moved(*panel);
    seen.corner = {origin.x + corner.x, origin.y + corner.y};
    const auto* frame = panel->find("rect", "class", "tick").at(0);
    seen.width = std::stod(frame->attributes.at("width"));
    seen.height = std::stod(frame->attributes.at("height"));
    out.push_back(seen);
  }
  return out;
}

/// The sample's first candidate and then all backends at all resolutions [m].
io::Comparison sample_of(const std::vector<std::string>& backends, const std::vector<double>& resolutions) {
  io::Comparison out = testing::sample_comparison();
  const io::ComparisonCandidate pattern = out.candidates[1];
  out.candidates.resize(1);
  for (const std::string& backend : backends)
    for (const double resolution : resolutions) {
      out.candidates.push_back(pattern);
      out.candidates.back().name = backend;
      out.candidates.back().resolution = resolution;
    }
  return out;
}

const std::vector<std::string> kAllBackends{"spline",           "nurbs",          "mesh", "mesh-flat", "offset",
                                            "offset-quadratic", "offset-bilinear"};

/// Which panel is at a column and row, by the order of the corners' coordinates; "" where there is none.
std::vector<std::vector<std::string>> table_of(const std::vector<SeenPanel>& panels) {
  std::set<double> across, down;
  for (const SeenPanel& panel : panels) {
    across.insert(panel.corner.x);
    down.insert(panel.corner.y);
  }
  std::vector<std::vector<std::string>> table(down.size(), std::vector<std::string>(across.size()));
  for (const SeenPanel& panel : panels) {
    const auto row = static_cast<std::size_t>(std::distance(down.begin(), down.find(panel.corner.y)));
    const auto column = static_cast<std::size_t>(std::distance(across.begin(), across.find(panel.corner.x)));
    EXPECT_EQ(table[row][column], "");
    table[row][column] = panel.name;
  }
  return table;
}

using Table = std::vector<std::vector<std::string>>;

TEST(PressuresSvg, AColumnABackendAndARowAResolutionFromCoarseToFine) {
  const testing::XmlElement root =
      testing::read_xml(pictures::pressures_svg(sample_of({"mesh", "spline"}, {0.5e-3, 1e-3, 0.25e-3})));
  const auto blocks = root.find("g", "class", "block");
  ASSERT_EQ(blocks.size(), 3u);
  for (const auto* block : blocks)
    EXPECT_EQ(table_of(seen_panels(*block)), (Table{{"analytic (reference)", "mesh 1 mm", "spline 1 mm"},
                                                    {"", "mesh 0.5 mm", "spline 0.5 mm"},
                                                    {"", "mesh 0.25 mm", "spline 0.25 mm"}}));
}

TEST(PressuresSvg, DataAsGivenStandInTheFirstRow) {
  // The sample: the truth, mesh at two resolutions, spline as given, vdb at one of them; and spline sampled too.
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates.push_back(comparison.candidates[1]);
  comparison.candidates.back().name = "spline";
  const testing::XmlElement root = testing::read_xml(pictures::pressures_svg(comparison));
  EXPECT_EQ(table_of(seen_panels(*root.find("g", "class", "block").at(0))),
            (Table{{"analytic (reference)", "mesh 1 mm", "spline", "vdb 1 mm", "spline 1 mm"},
                   {"", "mesh 0.5 mm", "", "", ""}}));
}

TEST(PressuresSvg, NamesOfTheTruthAndRepetitionsTakeNoOthersPlace) {
  // The truth is itself of a backend that is compared; one candidate appears twice.
  io::Comparison comparison = sample_of({"analytic", "mesh"}, {1e-3, 1e-3});
  const testing::XmlElement root = testing::read_xml(pictures::pressures_svg(comparison));
  EXPECT_EQ(table_of(seen_panels(*root.find("g", "class", "block").at(0))),
            (Table{{"analytic (reference)", "analytic 1 mm", "analytic 1 mm", "mesh 1 mm", "mesh 1 mm"}}));
}

TEST(PressuresSvg, AllBackendsFitBesideEachOtherAndMoreAreSpreadEvenly) {
  const testing::XmlElement all =
      testing::read_xml(pictures::pressures_svg(sample_of(kAllBackends, {1e-3, 0.5e-3, 0.25e-3})));
  for (const auto* block : all.find("g", "class", "block")) {
    const Table table = table_of(seen_panels(*block));
    ASSERT_EQ(table.size(), 3u);
    EXPECT_EQ(table[0].size(), 8u);
    EXPECT_EQ(table[2][4], "mesh-flat 0.25 mm");
  }
  // Wheel and rail in every combination of three, at one resolution: ten panels.
  std::vector<std::string> pairs;
  for (const char* wheel : {"mesh", "spline", "offset-quadratic"})
    for (const char* rail : {"mesh", "spline", "offset-quadratic"}) pairs.push_back(std::string(wheel) + "+" + rail);
  const testing::XmlElement mixed = testing::read_xml(pictures::pressures_svg(sample_of(pairs, {0.5e-3})));
  const Table table = table_of(seen_panels(*mixed.find("g", "class", "block").at(0)));
  EXPECT_EQ(table, (Table{{"analytic (reference)", "mesh+mesh 0.5 mm", "mesh+spline 0.5 mm",
                           "mesh+offset-quadratic 0.5 mm", "spline+mesh 0.5 mm"},
                          {"spline+spline 0.5 mm", "spline+offset-quadratic 0.5 mm", "offset-quadratic+mesh 0.5 mm",
                           "offset-quadratic+spline 0.5 mm", "offset-quadratic+offset-quadratic 0.5 mm"}}));
}

TEST(PressuresSvg, PanelsKeepApartAndInsideThePicture) {
  for (const std::size_t count : {1u, 2u, 7u})
    for (const std::vector<double>& resolutions :
         std::vector<std::vector<double>>{{1e-3}, {1e-3, 0.5e-3, 0.25e-3, 0.125e-3}}) {
      const io::Comparison comparison =
          sample_of({kAllBackends.begin(), kAllBackends.begin() + static_cast<std::ptrdiff_t>(count)}, resolutions);
      const testing::XmlElement root = testing::read_xml(pictures::pressures_svg(comparison));
      const double width = std::stod(root.attributes.at("width")), height = std::stod(root.attributes.at("height"));
      std::vector<SeenPanel> panels;
      for (const auto* block : root.find("g", "class", "block"))
        for (const SeenPanel& panel : seen_panels(*block)) panels.push_back(panel);
      ASSERT_EQ(panels.size(), 3 * comparison.candidates.size());
      constexpr double kTitles = 14.0, kNumbers = 33.0;  // [px] above and below a panel
      for (std::size_t i = 0; i < panels.size(); ++i) {
        const SeenPanel& a = panels[i];
        EXPECT_NEAR(a.width, 170.0, 0.1);
        EXPECT_GE(a.corner.x, 50.0);  // numbers of y
        EXPECT_LE(a.corner.x + a.width, width);
        EXPECT_GE(a.corner.y, kTitles);
        EXPECT_LE(a.corner.y + a.height + kNumbers, height);
        for (std::size_t k = 0; k < i; ++k) {
          const SeenPanel& b = panels[k];
          const bool beside = std::abs(a.corner.x - b.corner.x) >= a.width + 10.0;
          const double between =
              a.corner.y > b.corner.y ? a.corner.y - b.corner.y - b.height : b.corner.y - a.corner.y - a.height;
          EXPECT_TRUE(beside || between >= kTitles + kNumbers) << a.name << " and " << b.name;
        }
      }
    }
}

TEST(PressuresSvg, NumbersOfYStandWhereNoPanelIsOnTheLeft) {
  const testing::XmlElement root =
      testing::read_xml(pictures::pressures_svg(sample_of({"mesh", "spline"}, {1e-3, 0.5e-3})));
  const auto panels = root.find("g", "class", "block").at(0)->find("g", "class", "panel");
  ASSERT_EQ(panels.size(), 5u);
  std::vector<bool> numbered;
  for (const auto* panel : panels) numbered.push_back(!panel->find("text", "text-anchor", "end").empty());
  EXPECT_EQ(numbered, (std::vector<bool>{true, false, true, false, false}));  // truth, mesh 1, mesh 0.5, spline ...
}

TEST(PressuresSvg, ColoursAndWindowAreTheSameInACase) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates.resize(2);
  for (auto& candidate : comparison.candidates) {
    candidate.rows.resize(1);
    candidate.results.resize(1);
  }
  comparison.candidates[1].results[0].patches[0] = testing::ball_patch(20, 16, 0.5e9);  // half of the truth's
  comparison.candidates[1].results[0].patches[0].fields.X_TC.origin.x() = 2e-3;
  const testing::XmlElement root = testing::read_xml(pictures::pressures_svg(comparison));
  const auto panels = root.find("g", "class", "panel");
  ASSERT_EQ(panels.size(), 2u);
  const auto steps = [](const testing::XmlElement& panel) {
    std::size_t count = 0;
    for (std::size_t step = 0; step < pictures::kPatchSteps; ++step)
      count += !panel.find("path", "fill", pictures::step_colour(step, pictures::kPatchSteps)).empty();
    return count;
  };
  EXPECT_EQ(steps(*panels[0]), pictures::kPatchSteps);
  EXPECT_LE(steps(*panels[1]), pictures::kPatchSteps / 2 + 1);
  EXPECT_GE(steps(*panels[1]), pictures::kPatchSteps / 2 - 1);
  // The same ticks at the same places, and the same numbers of x.
  std::vector<std::string> ticks[2], numbers[2];
  for (int i = 0; i < 2; ++i) {
    for (const auto* tick : panels[i]->find("path", "class", "tick")) ticks[i].push_back(tick->attributes.at("d"));
    for (const auto* text : panels[i]->find("text", "text-anchor", "middle"))
      if (text->text.find_first_not_of("-.0123456789") == std::string::npos)
        numbers[i].push_back(text->text + " at " + text->attributes.at("x"));
  }
  EXPECT_GE(ticks[0].size(), 6u);
  EXPECT_EQ(ticks[0], ticks[1]);
  EXPECT_GE(numbers[0].size(), 3u);
  EXPECT_EQ(numbers[0], numbers[1]);
}

TEST(PressuresSvg, ShowsThePatchThatCarriesMost) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates.resize(1);
  auto& patches = comparison.candidates[0].results[0].patches;
  patches.insert(patches.begin(), testing::ball_patch(10, 10, 1e8));  // 100 cells of which some are in contact
  const testing::XmlElement root = testing::read_xml(pictures::pressures_svg(comparison));
  const testing::XmlElement alone = [] {
    io::Comparison one = testing::sample_comparison();
    one.candidates.resize(1);
    return testing::read_xml(pictures::pressures_svg(one));
  }();
  const auto base = [](const testing::XmlElement& picture) {
    return picture.find("path", "fill", pictures::step_colour(0, pictures::kPatchSteps)).at(0)->attributes.at("d");
  };
  EXPECT_EQ(base(root), base(alone));
}

TEST(PressuresSvg, RefusesFieldsThatDoNotMatchTheirGrid) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[1].results[0].patches[0].fields.pressure.pop_back();
  EXPECT_THROW(pictures::pressures_svg(comparison), Error);
}

TEST(ErrorSvg, APointForEachResolutionAndALevelWithoutOne) {
  const testing::XmlElement root = testing::read_xml(pictures::error_svg(testing::sample_comparison()));
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
  EXPECT_TRUE(has_text(root, "reference: analytic &lt;profiles&gt; &amp; flats"));
  EXPECT_TRUE(has_text(root, "resolution [mm]"));
}

/// Smallest and largest x of the corners of a path.
double path_width(const std::string& path) {
  double low = kInfinity, high = -kInfinity;
  for (std::size_t at = path.find_first_of("ML"); at != std::string::npos; at = path.find_first_of("ML", at + 1)) {
    const double x = std::stod(path.substr(at + 1));
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return high - low;
}

TEST(ErrorSvg, EqualSeriesShowBelowEachOther) {
  const testing::XmlElement root = testing::read_xml(
      pictures::error_svg(sample_of({"spline", "nurbs", "mesh"}, {1e-3, 0.5e-3})));  // all with equal errors
  const testing::XmlElement& chart = *root.find("g", "class", "chart").at(0);
  const auto lines = chart.find("path", "class", "line");
  ASSERT_EQ(lines.size(), 3u);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(lines[i]->attributes.at("d"), lines[0]->attributes.at("d"));
    EXPECT_LE(std::stod(lines[i]->attributes.at("stroke-width")),
              std::stod(lines[i - 1]->attributes.at("stroke-width")) - 0.3);
    EXPECT_NE(lines[i]->attributes.contains("stroke-dasharray"), lines[i - 1]->attributes.contains("stroke-dasharray"));
  }
  const auto marks = chart.find("path", "class", "mark");  // spline 1 to 3 in two places each
  ASSERT_EQ(marks.size(), 6u);
  const auto area_width = [&](std::size_t i) {
    const auto corners = pictures::chart_marker_corners(static_cast<int>(i / 2) + 1, 1.0);
    double low = 0.0, high = 0.0;
    for (const auto& corner : corners) {
      low = std::min(low, corner[0]);
      high = std::max(high, corner[0]);
    }
    return path_width(marks[i]->attributes.at("d")) / (high - low);  // the marker's radius
  };
  EXPECT_NEAR(area_width(0), area_width(1), 0.02);  // coordinates have two decimals
  EXPECT_LE(area_width(2), area_width(0) - 0.5);
  EXPECT_LE(area_width(4), area_width(2) - 0.5);
  // The legend shows them as they are.
  const auto samples = root.find("g", "class", "legend").at(0)->find("path", "class", "line");
  ASSERT_EQ(samples.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(samples[i]->attributes.at("stroke-width"), lines[i]->attributes.at("stroke-width"));
}

TEST(CostSvg, AMarkACandidateAndTheRestInWords) {
  io::Comparison comparison = testing::sample_comparison();
  comparison.candidates[2].wheel.memory_bytes = 15000000;  // 16 MB against 4 MB: twice the width
  const testing::XmlElement root = testing::read_xml(pictures::cost_svg(comparison));
  const auto marks = root.find("g", "class", "chart").at(0)->find("path", "class", "mark");
  ASSERT_EQ(marks.size(), 4u);
  for (const char* words :
       {"analytic (reference)", "mesh 1 mm", "mesh 0.5 mm", "spline", "not drawn: vdb 1 mm (failed)", "16 MB", "4 MB"})
    EXPECT_TRUE(has_text(root, words)) << words;
  // Errors of zero are drawn hollow at the floor.
  int hollow = 0;
  for (const auto* mark : marks) hollow += mark->attributes.at("fill") == "#ffffff";
  EXPECT_EQ(hollow, 2);
  const auto titles = root.find("title");
  ASSERT_EQ(titles.size(), 4u);
  EXPECT_EQ(titles[1]->text, "mesh 0.5 mm: 11 ms, 5 %, 16 MB");  // the larger marker first
}

/// Every picture is well-formed and has no script and no number that is none.
void expect_sound_comparison(const io::Comparison& comparison) {
  for (const std::string& svg :
       {pictures::pressures_svg(comparison), pictures::error_svg(comparison), pictures::cost_svg(comparison)}) {
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
  expect_sound_comparison({});
  expect_sound_comparison(sample);
  for (const std::size_t count : {1u, 2u}) {
    io::Comparison few = sample;
    few.candidates.resize(count);
    expect_sound_comparison(few);
  }
  io::Comparison failed = sample;
  failed.candidates.erase(failed.candidates.begin(), failed.candidates.end() - 1);
  expect_sound_comparison(failed);
  io::Comparison named = sample;
  named.candidates[1].name = "<b a=\"c\">&\x01\xff";
  named.truth = "]]> -- &amp;";
  expect_sound_comparison(named);
  io::Comparison bare = sample;  // rows without fields
  for (auto& candidate : bare.candidates) candidate.results.clear();
  expect_sound_comparison(bare);
  EXPECT_NE(pictures::pressures_svg(bare).find("no fields"), std::string::npos);
}

TEST(ComparisonPictures, AreSoundForEveryNumber) {
  for (const double value : {0.0, -1.0, kNaN, kInfinity, -kInfinity, 1e308, 5e-324}) {
    io::Comparison comparison = testing::sample_comparison();
    for (auto& candidate : comparison.candidates) {
      for (auto& row : candidate.rows) row.pmax_error = row.search_s = row.pmax = value;
      candidate.wheel.difference.height_max = candidate.rail.difference.height_max = value;
    }
    expect_sound_comparison(comparison);
    for (auto& candidate : comparison.candidates) candidate.resolution = value;
    expect_sound_comparison(comparison);
    for (double& pressure : comparison.candidates[1].results[0].patches[0].fields.pressure) pressure = value;
    expect_sound_comparison(comparison);
  }
}

}  // namespace
}  // namespace treadmark
