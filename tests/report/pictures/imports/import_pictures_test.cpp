// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/imports/import_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/io/imports/sample_report.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"
#include "treadmark/tests/report/pictures/png_reader.hpp"
#include "treadmark/tests/support/file_content.hpp"

namespace treadmark {
namespace {

using treadmark::testing::content_of;

constexpr std::size_t kLargestFile = 500000;  // bytes

std::vector<std::string> all_pictures(const io::ImportReport& report) {
  return {pictures::import_before_svg(report), pictures::import_removed_svg(report),
          pictures::import_fitted_svg(report), pictures::import_residual_svg(report)};
}

std::vector<testing::PngImage> images(const testing::XmlElement& root) {
  std::vector<testing::PngImage> out;
  const std::string head = "data:image/png;base64,";
  for (const auto* image : root.find("image")) {
    const std::string& link = image->attributes.at("xlink:href");
    EXPECT_TRUE(link.starts_with(head));
    out.push_back(testing::read_png(testing::from_base64(link.substr(head.size()))));
  }
  return out;
}

bool says(const testing::XmlElement& root, const std::string& part) {
  for (const auto* text : root.find("text"))
    if (text->text.find(part) != std::string::npos) return true;
  return false;
}

/// Numbers are written as numbers, and everything can be read.
void expect_sound_import(const io::ImportReport& report) {
  for (const std::string& picture : all_pictures(report)) {
    const testing::XmlElement root = testing::read_xml(picture);
    EXPECT_EQ(root.name, "svg");
    EXPECT_LT(picture.size(), kLargestFile);
    for (const char* name : {"path", "rect", "image", "ellipse", "circle", "text"})
      for (const auto* element : root.find(name))
        for (const auto& [key, value] : element->attributes) {
          if (key == "xlink:href") continue;
          EXPECT_EQ(value.find("nan"), std::string::npos) << name << " " << key << " " << value.substr(0, 80);
          EXPECT_EQ(value.find("inf"), std::string::npos) << name << " " << key << " " << value.substr(0, 80);
        }
    images(root);
  }
}

TEST(ImportPictures, ARealisticReport) {
  const io::ImportReport report = testing::sample_report();
  expect_sound_import(report);
  EXPECT_EQ(all_pictures(report), all_pictures(report));
}

TEST(ImportPictures, MapsAndEmptyReportsSayWhatIsMissing) {
  expect_sound_import(testing::sample_map_report());
  expect_sound_import({});
  EXPECT_TRUE(says(testing::read_xml(pictures::import_fitted_svg({})), "no values"));
  EXPECT_TRUE(says(testing::read_xml(pictures::import_before_svg({})), "no points"));
  EXPECT_TRUE(says(testing::read_xml(pictures::import_removed_svg({})), "nothing was looked for"));
  EXPECT_TRUE(says(testing::read_xml(pictures::import_residual_svg({})), "no residuals"));
  EXPECT_TRUE(says(testing::read_xml(pictures::import_fitted_svg(testing::sample_map_report())), "no nominal profile"));
}

TEST(ImportPictures, ValuesBeyondAllBoundsDoNoHarm) {
  for (const double bad : {kNaN, kInfinity, -1e300, 1e300, 1e12}) {
    io::ImportReport report = testing::sample_report();
    for (io::BandMap* map : {&report.density, &report.removed_map, &report.fitted, &report.residual, &report.noise_map})
      map->value[5] = static_cast<float>(bad > 1e38 ? 1e38 : bad < -1e38 ? -1e38 : bad);
    report.section[10] = {bad, 0.0};
    report.nominal_section[10] = {0.0, bad};
    report.raw_section[10] = report.removed_section[10] = {bad, bad};
    report.damage[0].length = report.damage[1].u = report.damage[2].depth = bad;
    report.holes[0].diameter = report.holes[1].y = bad;
    report.noise = report.damage_threshold = bad;
    report.removed[0].count = std::numeric_limits<std::size_t>::max();
    expect_sound_import(report);
    report.nominal_radius = report.residual_range = bad;
    report.fitted.a_max = report.residual.s_min = bad;
    expect_sound_import(report);
    EXPECT_FALSE(io::import_summary(report).empty());
  }
}

TEST(ImportPictures, MapsThatDoNotFitTheirSizesAreNotDrawn) {
  io::ImportReport report = testing::sample_report();
  report.density.value.pop_back();
  report.fitted.rows = std::size_t{1} << 40;
  report.residual.value.clear();
  report.noise_map.s_max = report.noise_map.s_min;
  expect_sound_import(report);
  EXPECT_TRUE(says(testing::read_xml(pictures::import_before_svg(report)), "no values"));
}

TEST(ImportPictures, NoiseStaysBelowTheSizeOfAFile) {
  io::ImportReport report = testing::sample_report();
  std::uint64_t state = 1;
  for (io::BandMap* map : {&report.density, &report.residual, &report.noise_map, &report.removed_map}) {
    map->rows = 4000;
    map->columns = 600;
    map->value.resize(map->rows * map->columns);
    for (float& v : map->value) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      v = static_cast<float>(static_cast<double>(state >> 40) / 16777216.0 * 1e-3);
    }
  }
  report.raw_section.clear();
  for (int i = 0; i < 300000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    report.raw_section.push_back({-0.07 + 0.13 * static_cast<double>(state >> 40) / 16777216.0, 1e-7 * (i % 300000)});
  }
  expect_sound_import(report);
}

TEST(ImportPictures, DamageIsWhereTheSurfaceIsDeep) {
  const io::ImportReport report = testing::sample_report();
  const testing::XmlElement root = testing::read_xml(pictures::import_fitted_svg(report));
  const auto* image = root.find("image").at(0);
  const testing::PngImage map = images(root).at(0);
  const auto number = [](const testing::XmlElement* element, const char* key) {
    return std::stod(element->attributes.at(key));
  };
  const auto blue = [&](double x, double y) {  // blue less red of the pixel at a place of the picture
    const double i = (x - number(image, "x")) / number(image, "width") * static_cast<double>(map.width);
    const double j = (y - number(image, "y")) / number(image, "height") * static_cast<double>(map.height);
    const auto& p = map.pixels.at(static_cast<std::size_t>(j) * map.width + static_cast<std::size_t>(i));
    return p[3] == 0 ? 0 : p[2] - p[0];
  };
  const auto marks = root.find("g", "class", "chart").at(0)->find("rect", "class", "damage");
  ASSERT_EQ(marks.size(), 4u);  // the third one lies across the seam
  const auto middle = [&](std::size_t i) {
    return blue(number(marks[i], "x") + 0.5 * number(marks[i], "width"),
                number(marks[i], "y") + 0.5 * number(marks[i], "height"));
  };
  EXPECT_GT(middle(0), 60);
  EXPECT_GT(middle(1), 40);
  EXPECT_LT(middle(2), -20);  // stands out: brown
  EXPECT_LT(std::abs(blue(number(marks[0], "x") - 15.0, number(marks[0], "y") - 8.0)), 30);
  EXPECT_TRUE(says(root, "1: 0.850 mm"));
  EXPECT_TRUE(says(root, "3: 0.300 mm high"));

  const auto holes = root.find("ellipse", "class", "hole");
  ASSERT_EQ(holes.size(), 2u);
  const double i =
      (number(holes[0], "cx") - number(image, "x")) / number(image, "width") * static_cast<double>(map.width);
  const double j =
      (number(holes[0], "cy") - number(image, "y")) / number(image, "height") * static_cast<double>(map.height);
  EXPECT_EQ(map.pixels.at(static_cast<std::size_t>(j) * map.width + static_cast<std::size_t>(i))[3], 0);
}

TEST(ImportPictures, NamesWithMarkupAreText) {
  io::ImportReport report = testing::sample_report();
  report.inputs[0].file = "a<b>&\"c\xff.ply";
  report.unit = report.unit_from = report.nominal = report.removed[1].reason = report.removed[1].why = "</svg>&";
  expect_sound_import(report);
  EXPECT_TRUE(says(testing::read_xml(pictures::import_before_svg(report)), "a<b>&\"c?.ply") ||
              pictures::import_before_svg(report).find("a&lt;b&gt;&amp;\"c?.ply") != std::string::npos);
  EXPECT_EQ(pictures::import_removed_svg(report).find("</svg>&"), std::string::npos);
}

TEST(ImportPictures, BarsOfReasonsAreLogarithmic) {
  io::ImportReport report;
  report.points_read = 1000000;
  report.removed = {{"a", 10, ""}, {"b", 10000, ""}, {"c", 0, ""}};
  const testing::XmlElement root = testing::read_xml(pictures::import_removed_svg(report));
  const auto bars = root.find("rect", "class", "bar");
  ASSERT_EQ(bars.size(), 3u);
  EXPECT_NEAR(std::stod(bars[1]->attributes.at("width")) / std::stod(bars[0]->attributes.at("width")), 4.0, 0.01);
  EXPECT_EQ(std::stod(bars[2]->attributes.at("width")), 0.0);
  EXPECT_TRUE(says(root, "10 000"));
  EXPECT_TRUE(says(root, "1.00 %"));
}

TEST(ImportFiles, TheSameReportGivesTheSameFiles) {
  const auto place = std::filesystem::path(TREADMARK_BINARY_DIR) / "import_files_test";
  std::filesystem::remove_all(place);
  io::ImportReport report = testing::sample_report();
  pictures::write_import_report((place / "one").string(), report);
  report.steps[0].seconds = 99.0;
  pictures::write_import_report((place / "two").string(), report);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(place / "one")) {
    ++files;
    const std::string one = content_of(entry.path()), two = content_of(place / "two" / entry.path().filename());
    EXPECT_FALSE(one.empty());
    EXPECT_EQ(one == two, entry.path().filename() != "times.json") << entry.path();
  }
  EXPECT_EQ(files, 9u);
  EXPECT_EQ(content_of(place / "one" / "settings.toml"), report.settings_toml);
  EXPECT_EQ(content_of(place / "one" / "summary.txt"), io::import_summary(report));
  EXPECT_EQ(content_of(place / "one" / "report.json"), io::import_json(report, false));
  std::filesystem::remove_all(place);
}

TEST(ImportFiles, AFolderThatCannotBeWrittenIsAnError) {
  const auto place = std::filesystem::path(TREADMARK_BINARY_DIR) / "import_files_file";
  std::ofstream(place) << "x";
  try {
    pictures::write_import_report(place.string(), {});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
  }
  std::filesystem::remove(place);
}

}  // namespace
}  // namespace treadmark
