// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/histories/patches_svg.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/report/pictures/outline.hpp"
#include "treadmark/tests/io/histories/sample_history.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark {
namespace {

struct Field {
  Grid2 grid{-10e-3, -8e-3, 0.25e-3, 0.5e-3, 81, 33};
  std::vector<double> values;
  template <class Function>
  explicit Field(Function function) {
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) values.push_back(function(grid.x(ix), grid.y(iy)));
  }
};

TEST(ContourLines, ACircleClosesAndHasItsRadius) {
  const Field cone([](double x, double y) { return std::hypot(x, y); });
  const auto lines = pictures::contour_lines(cone.grid, cone.values, 5e-3);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < lines[0].size(); ++i) {
    const auto &a = lines[0][i], &b = lines[0][i + 1];
    EXPECT_NEAR(std::hypot(a[0], a[1]), 5e-3, 1e-5);  // cells of 0.25 mm x 0.5 mm: sagitta 6 um
    area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
  }
  EXPECT_NEAR(std::abs(area), M_PI * 25e-6, 0.01 * M_PI * 25e-6);
}

TEST(ContourLines, APlaneGivesItsStraightLineFromRimToRim) {
  const Field plane([](double x, double y) { return 2.0 * x + 3.0 * y; });
  const auto lines = pictures::contour_lines(plane.grid, plane.values, 1.3e-3);
  ASSERT_EQ(lines.size(), 1u);
  for (const auto& [x, y] : lines[0]) EXPECT_NEAR(2.0 * x + 3.0 * y, 1.3e-3, 1e-12);
  const auto on_rim = [&](const std::array<double, 2>& p) {
    const Grid2& grid = plane.grid;
    double distance = 1.0;
    for (const double d : {p[0] - grid.x0, grid.x(grid.nx - 1) - p[0], p[1] - grid.y0, grid.y(grid.ny - 1) - p[1]})
      distance = std::min(distance, std::abs(d));
    return distance < 1e-12;
  };
  EXPECT_TRUE(on_rim(lines[0].front()));
  EXPECT_TRUE(on_rim(lines[0].back()));
}

TEST(ContourLines, SaddlesHolesAndWrongSizes) {
  const Grid2 cell{0, 0, 1, 1, 2, 2};
  EXPECT_EQ(pictures::contour_lines(cell, std::vector<double>{1, 0, 0, 1}, 0.4).size(), 2u);
  EXPECT_EQ(pictures::contour_lines(cell, std::vector<double>{1, 0, 0, 1}, 0.6).size(), 2u);
  EXPECT_TRUE(pictures::contour_lines(cell, std::vector<double>{1, 0, kNaN, 1}, 0.5).empty());
  EXPECT_TRUE(pictures::contour_lines(cell, std::vector<double>{1, 1, 1, 1}, 1.0).empty());
  EXPECT_THROW(pictures::contour_lines(cell, std::vector<double>{1, 0, 0}, 0.5), Error);
}

class PatchesSvg : public ::testing::Test {
 protected:
  PatchesSvg() {
    round_.patches.push_back(testing::ball_patch(40, 36, 1e9));
    for (int i = 0; i < 3; ++i) {
      io::CaseResult one;
      one.number = i + 1;
      one.pitch = 0.02 * i;
      one.patches.push_back(testing::ball_patch(50, 30, 1.2e9));
      one.patches[0].fn = 60e3;
      one.patches[0].pmax = 1.2e9;
      one.patches[0].fields.X_TC.origin.x() = 10.0 + 2e-3 * i;  // the wheelset stands at x = 10 m
      one.patches[0].fields.X_TC.origin.y() = 0.75;
      cases_.push_back(one);
    }
    round_.patches[0].fields.X_TC.origin = cases_[0].patches[0].fields.X_TC.origin;
    const Field flat([](double x, double y) { return 1.4e-3 * std::exp(-(x * x + 2.0 * y * y) / 4e-5); });
    depth_ = flat.values;
    grid_ = flat.grid;
    grid_.x0 += 10.0;
    grid_.y0 += 0.75;
    for (const io::CaseResult& one : cases_) panels_.push_back({&one, &round_, grid_, depth_, 10.0, {}});
  }

  io::CaseResult round_;
  std::vector<io::CaseResult> cases_;
  Grid2 grid_;
  std::vector<double> depth_;
  std::vector<pictures::PatchesPanel> panels_;
};

TEST_F(PatchesSvg, TheRollingDirectionIsUpwards) {
  const pictures::PatchesView view = pictures::make_patches_view(panels_);
  const pictures::PatchPicture plain = pictures::make_patch_picture(cases_[1].patches[0].fields);
  const pictures::PatchPicture& turned = view.contact[1].at(0);
  EXPECT_EQ(turned.nx, plain.ny);
  EXPECT_EQ(turned.ny, plain.nx);
  EXPECT_NEAR(turned.y_low, plain.x_low - 10e3, 1e-9);
  EXPECT_EQ(turned.x_low, plain.y_low);
  for (int ix = 0; ix < plain.nx; ++ix)
    for (int iy = 0; iy < plain.ny; ++iy) {
      const auto from = static_cast<std::size_t>(ix + plain.nx * iy),
                 to = static_cast<std::size_t>(iy + turned.nx * ix);
      EXPECT_EQ(turned.values[to], plain.values[from]);
      EXPECT_EQ(turned.adhesion[to], plain.adhesion[from]);
    }
  EXPECT_EQ(view.top_pressure, *std::max_element(plain.values.begin(), plain.values.end()));
  EXPECT_LT(view.window.y_low, -4.0);
  EXPECT_GT(view.window.y_high, 8.0);
}

TEST_F(PatchesSvg, PanelsHaveTheirPartsAndTitles) {
  panels_[2].title = "at the \"end\" <";
  const std::string svg = pictures::patches_svg(panels_, "flat & rail");
  const testing::XmlElement root = testing::read_xml(svg);
  const auto panels = root.find("g", "class", "panel");
  ASSERT_EQ(panels.size(), 3u);
  for (const auto* panel : panels) {
    EXPECT_EQ(panel->find("path", "class", "contact").size(), 1u);
    EXPECT_EQ(panel->find("path", "class", "round").size(), 1u);
    EXPECT_EQ(panel->find("path", "class", "depth").size(), 1u);
  }
  EXPECT_NE(svg.find(">pitch 0.00°<"), std::string::npos);
  EXPECT_NE(svg.find(">pitch 1.15°<"), std::string::npos);
  EXPECT_NE(svg.find(">60 kN, 1200 MPa<"), std::string::npos);
  EXPECT_NE(svg.find("at the \"end\" &lt;"), std::string::npos);
  EXPECT_NE(svg.find("flat &amp; rail"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

/// Extent of a path of M, H, V corners: x low, x high, y low, y high.
std::array<double, 4> extent(const std::string& path) {
  std::array<double, 4> out{1e9, -1e9, 1e9, -1e9};
  const auto grow = [&](std::size_t first, double value) {
    out[first] = std::min(out[first], value);
    out[first + 1] = std::max(out[first + 1], value);
  };
  const std::regex corner("M(-?[0-9.]+) (-?[0-9.]+)|H(-?[0-9.]+)|V(-?[0-9.]+)");
  for (std::sregex_iterator it(path.begin(), path.end(), corner), end; it != end; ++it) {
    if ((*it)[1].matched) grow(0, std::stod((*it)[1]));
    if ((*it)[2].matched) grow(2, std::stod((*it)[2]));
    if ((*it)[3].matched) grow(0, std::stod((*it)[3]));
    if ((*it)[4].matched) grow(2, std::stod((*it)[4]));
  }
  return out;
}

TEST_F(PatchesSvg, ContactMovesUpWhileTheRoundWheelStays) {
  const testing::XmlElement root = testing::read_xml(pictures::patches_svg(panels_, ""));
  const auto panels = root.find("g", "class", "panel");
  const auto of = [&](std::size_t panel, const char* name) {
    return extent(panels[panel]->find("path", "class", name).at(0)->attributes.at("d"));
  };
  EXPECT_EQ(of(0, "round"), of(2, "round"));
  const pictures::PatchesView view = pictures::make_patches_view(panels_);
  const double scale = 230.0 / std::max(view.window.width(), view.window.height());
  EXPECT_NEAR(of(0, "contact")[2] - of(2, "contact")[2], 4.0 * scale, 0.15);  // 4 mm upwards
  EXPECT_NEAR(of(0, "contact")[0], of(2, "contact")[0], 0.15);
}

TEST_F(PatchesSvg, TheTableHoldsThePlottedNumbers) {
  const auto lines = testing::read_lines(pictures::patches_csv(panels_));
  EXPECT_EQ(lines[0], "panel,pitch_rad,kind,x_m,y_m,value");
  double force = 0.0, deepest = 0.0;
  for (const std::string& line : lines) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    if (cells[0] != "2") continue;
    if (cells[2] == "pressure_Pa") force += std::stod(cells[5]) * cases_[1].patches[0].fields.grid.cell_area();
    if (cells[2] == "defect_depth_m") deepest = std::max(deepest, std::stod(cells[5]));
  }
  EXPECT_NEAR(force, 1.2e9 * 2.0 / 3.0 * M_PI * 16e-6, 0.02 * 4e4);
  EXPECT_NEAR(deepest, 1.4e-3, 1e-6);
}

TEST_F(PatchesSvg, RefusesWrongSizesAndShowsEmptyPanels) {
  panels_[1].depth.pop_back();
  EXPECT_THROW(pictures::patches_svg(panels_, ""), Error);
  EXPECT_THROW(pictures::patches_csv(panels_), Error);
  panels_[1].depth.clear();
  EXPECT_NO_THROW(testing::read_xml(pictures::patches_svg(panels_, "")));
  cases_[1].patches[0].fields.pressure.pop_back();
  EXPECT_THROW(pictures::patches_svg(panels_, ""), Error);
  cases_[1].patches.clear();
  cases_[1].status = Status::no_contact;
  EXPECT_NE(pictures::patches_svg(panels_, "").find(">no contact<"), std::string::npos);
  panels_[1].result = nullptr;
  EXPECT_THROW(pictures::patches_svg(panels_, ""), Error);
  EXPECT_NO_THROW(testing::read_xml(pictures::patches_svg({}, "nothing")));
}

}  // namespace
}  // namespace treadmark
