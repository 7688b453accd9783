// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/tables/shown.hpp"
#include "treadmark/tests/io/imports/sample_report.hpp"

namespace treadmark {
namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST(ImportSummary, UnitAndWarningsComeFirst) {
  const std::vector<std::string> page = lines(io::import_summary(testing::sample_report()));
  ASSERT_GT(page.size(), 30u);
  EXPECT_LT(page.size(), 70u);
  EXPECT_EQ(page[0], "Treadmark 1.2.3: import of a wheel");
  EXPECT_EQ(page[1], "unit of the file: mm, from: the size of the wheel");
  EXPECT_EQ(page[3], "WARNINGS: 2");
  EXPECT_TRUE(page[4].starts_with("  ! 2.1 % of the band"));
  for (const std::string& line : page) EXPECT_LE(line.size(), 112u) << line;
}

TEST(ImportSummary, CountsAreAlignedAndHaveTheirParts) {
  const std::vector<std::string> page = lines(io::import_summary(testing::sample_report()));
  std::size_t end = 0;
  int found = 0;
  for (const std::string& line : page)
    for (const auto& [name, count, part] :
         {std::tuple("  read  ", "1 600 000", "100.0 %"), std::tuple("  stray points", "9 100", "0.569 %"),
          std::tuple("  used  ", "1 571 000", "98.2 %")})
      if (line.starts_with(name)) {
        ++found;
        const std::size_t at = line.find(count);
        ASSERT_NE(at, std::string::npos) << line;
        EXPECT_NE(line.find(part), std::string::npos) << line;
        if (end == 0) end = at + std::string(count).size();
        EXPECT_EQ(at + std::string(count).size(), end) << line;
      }
  EXPECT_EQ(found, 3);
}

TEST(ImportSummary, ANameCannotBreakTheLines) {
  io::ImportReport report = testing::sample_report();
  report.inputs[0].file = "a\nWARNINGS: 9\x1b[31m";
  report.warnings = {"first\nsecond"};
  for (const std::string& line : lines(io::import_summary(report))) {
    EXPECT_FALSE(line.starts_with("WARNINGS: 9"));
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
  }
}

TEST(ImportSummary, AMapHasNoPointsAndAnEmptyReportIsPlain) {
  const std::string map = io::import_summary(testing::sample_map_report());
  EXPECT_NE(map.find("from a map of deviations"), std::string::npos);
  EXPECT_NE(map.find("no warnings"), std::string::npos);
  EXPECT_EQ(map.find("\npoints\n"), std::string::npos);
  EXPECT_EQ(map.find("\nplaced\n"), std::string::npos);
  EXPECT_NE(io::import_summary({}).find("unit of the file: unknown"), std::string::npos);
}

TEST(ImportWords, Numbers) {
  EXPECT_EQ(io::grouped(0), "0");
  EXPECT_EQ(io::grouped(999), "999");
  EXPECT_EQ(io::grouped(1234567), "1 234 567");
  EXPECT_EQ(io::percent(1, 0), "-");
  EXPECT_EQ(io::percent(0, 5), "0 %");
  EXPECT_EQ(io::percent(1, 3), "33.3 %");
  EXPECT_EQ(io::length_text(0.85e-3), "0.850 mm");
  io::ImportReport held;
  EXPECT_EQ(io::surface_error_text(held), "not known");
  // 20 000 points of 30 um: their mean square is known to 1 %, so that 4.2 um are told from nothing.
  held.held_out_points = 20000, held.held_out_rms = 30e-6, held.held_out_error = 0.0;
  EXPECT_EQ(io::surface_error_text(held), "below 4.24 um");
  held.held_out_error = 3e-6;
  EXPECT_EQ(io::surface_error_text(held), "below 5.20 um");
  held.held_out_error = 6e-6;
  EXPECT_EQ(io::surface_error_text(held), "6.00 um");
  held.errors = ErrorSize{3e-6, 12e-6};
  EXPECT_EQ(io::surface_error_text(held), "3.00 um rms, 12.0 um largest");
  EXPECT_EQ(io::length_text(35e-6), "35.0 um");
  EXPECT_EQ(io::length_text(12.0), "12.0 m");
  EXPECT_EQ(io::length_text(std::nan("")), "-");
  EXPECT_EQ(io::shown_number(-0.001, 1), "0.0");
  EXPECT_EQ(io::shortened("abcdef", 4), "abc\u2026");
  EXPECT_EQ(io::shortened("\u00e4\u00f6\u00fc", 3), "\u00e4\u00f6\u00fc");
}

}  // namespace
}  // namespace treadmark
