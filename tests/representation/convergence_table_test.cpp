// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/representation/example_cases.hpp"
#include "treadmark/tests/representation/kinds.hpp"

namespace treadmark::testing {
namespace {

/// One line of the table in docs/convergence.md: errors of a representation whose samples lie `spacing_mm` apart.
struct Line {
  std::string backend;
  double spacing_mm = 0.0;
  double max = 0.0, rms = 0.0, slope = 0.0;  ///< [m], [m], [rad]
  std::vector<double> errors() const { return {max, rms, slope}; }
};

const NaturalSurface& flat_wheel() {
  static const NaturalSurface wheel = [] {
    io::CaseFile file = wheel_flat_example({0.0});
    const io::WheelRailCase& input = wheel_rail(file.cases.front());
    return create_natural({Body::wheel, input.wheelset.nominal_radius, std::get<StandardProfile>(input.wheel.geometry),
                           input.wheel.defects});
  }();
  return wheel;
}

Line compute(const std::string& backend, double spacing_mm) {
  Region sampled, compared;
  sampled.u_min = -0.2;
  sampled.u_max = 0.2;
  // off the ends of the flat (theta = +-0.163, y = -24 and 36 mm) and the joints of S1002 (y = -26 and 32 mm), where
  // the curvature jumps
  compared.u_min = -0.12;
  compared.u_max = 0.12;
  compared.y_min = -0.012;
  compared.y_max = 0.020;
  const NaturalSurface& wheel = flat_wheel();
  const RepresentedSurface r = represent(wheel, {backend, 1e-3 * spacing_mm, sampled});
  const Distance d = distance(*wheel.surface, *r.surface, Body::wheel, compared, 4000, 0.0, 0.01);
  EXPECT_EQ(d.points, 4000);
  return {backend, spacing_mm, d.max, d.rms, d.slope};
}

std::vector<Line> documented() {
  std::ifstream file(std::string(TREADMARK_SOURCE_DIR) + "/docs/convergence.md");
  std::vector<Line> lines;
  bool inside = false;
  for (std::string text; std::getline(file, text);) {
    if (text.starts_with("## ")) inside = text == "## Representations of a wheel flat";
    Line line;
    char bar = 0;
    std::istringstream words(text);
    if (inside && words >> bar >> line.backend >> bar >> line.spacing_mm >> bar >> line.max >> bar >> line.rms >> bar >>
                      line.slope)
      lines.push_back(line);
  }
  return lines;
}

std::string markdown(const Line& line) {
  char text[160];
  std::snprintf(text, sizeof text, "| %s | %g | %.1e | %.1e | %.1e |", line.backend.c_str(), line.spacing_mm, line.max,
                line.rms, line.slope);
  return text;
}

class RepresentationTable : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Backends, RepresentationTable,
                         ::testing::Values("spline", "nurbs", "mesh", "mesh-flat", "offset", "offset-quadratic",
                                           "offset-bilinear"),
                         [](const auto& which) {
                           std::string name = which.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

/// Stated orders of heights (max, rms) and of slopes.
struct Orders {
  double max, rms, slope;
};

TEST_P(RepresentationTable, DocumentShowsWhatIsComputedAndOrdersHold) {
  static const std::map<std::string, Orders> promised{
      {"spline", {4.0, 4.0, 3.0}},         {"nurbs", {4.0, 4.0, 3.0}},     {"mesh", {4.0, 4.0, 3.0}},
      {"offset", {4.0, 4.0, 3.0}},         {"mesh-flat", {2.0, 2.0, 1.0}}, {"offset-quadratic", {3.0, 3.0, 2.0}},
      {"offset-bilinear", {2.0, 2.0, 1.0}}};
  // Below this the 32-bit numbers of the offsets are what is left [m]; splines in 64 bits go on.
  constexpr double kLeast = 3e-10;
  constexpr double kIrregular = 0.4;  // of the order: where the points of comparison lie in the cells
  const std::vector<Line> printed = documented();
  const Orders orders = promised.at(GetParam());
  std::vector<Line> lines;
  for (const double spacing : {4.0, 2.0, 1.0, 0.5}) {
    lines.push_back(compute(GetParam(), spacing));
    const Line& line = lines.back();
    const auto same = [&](const Line& p) { return p.backend == line.backend && p.spacing_mm == spacing; };
    const auto shown = ranges::find_if(printed, same);
    if (shown == printed.end()) {
      ADD_FAILURE() << "docs/convergence.md lacks\n" << markdown(line);
      continue;
    }
    const auto expected = line.errors(), found = shown->errors();
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // Two digits are shown; a little more than half a unit of the second one, for the last bits.
      const double unit = 0.1 * std::pow(10.0, std::floor(std::log10(expected[i])));
      EXPECT_NEAR(found[i], expected[i], 0.52 * unit) << "the table should read\n" << markdown(line);
    }
  }
  EXPECT_EQ(printed.size(), promised.size() * lines.size());
  // from the coarsest to the finest spacing that is not at the floor
  std::size_t last = lines.size() - 1;
  while (GetParam() == "offset" && last > 1 && lines[last].max < kLeast) --last;
  const double halvings = static_cast<double>(last);
  const auto order = [&](double Line::*error) {
    return std::log2(lines.front().*error / (lines[last].*error)) / halvings;
  };
  EXPECT_GT(order(&Line::max), orders.max - kIrregular);
  EXPECT_GT(order(&Line::rms), orders.rms - kIrregular);
  EXPECT_GT(order(&Line::slope), orders.slope - kIrregular);
  RecordProperty("orders", std::to_string(order(&Line::max)) + " " + std::to_string(order(&Line::rms)) + " " +
                               std::to_string(order(&Line::slope)));
}

}  // namespace
}  // namespace treadmark::testing
