// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/pressure_svg.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>

#include "treadmark/core/error.hpp"
#include "treadmark/report/pictures/outline.hpp"
#include "treadmark/report/pictures/patch_picture.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark {
namespace {

/// Area inside path data made of M, h, v and z, by the shoelace formula; also checks that every loop closes on a side.
double path_area(const std::string& path) {
  std::istringstream in(path);
  double area = 0.0;
  char command = 0;
  int x = 0, y = 0, start_x = 0, start_y = 0, length = 0;
  while (in >> command) {
    if (command == 'M') {
      in >> x >> y;
      start_x = x;
      start_y = y;
    } else if (command == 'h') {
      in >> length;
      area -= static_cast<double>(y) * length;
      x += length;
    } else if (command == 'v') {
      in >> length;
      y += length;
    } else {
      EXPECT_EQ(command, 'z');
      EXPECT_TRUE(x == start_x || y == start_y);
      area -= static_cast<double>(y) * (start_x - x);
    }
  }
  return area;
}

TEST(Outline, EnclosesExactlyTheCells) {
  std::mt19937 random(20240229);
  for (int trial = 0; trial < 200; ++trial) {
    pictures::CellMask mask{1 + trial % 13, 1 + trial % 7, {}};
    int count = 0;
    for (int i = 0; i < mask.nx * mask.ny; ++i) {
      mask.inside.push_back(random() % 3 != 0);  // holes, islands and cells touching at corners
      count += mask.inside.back();
    }
    EXPECT_EQ(path_area(pictures::path_in_cells(pictures::outline(mask))), count);
  }
}

TEST(Outline, ARectangleIsOneLoopOfFourSides) {
  const auto loops = pictures::outline({3, 2, std::vector<char>(6, 1)});
  EXPECT_EQ(pictures::path_in_cells(loops), "M0 0h3v2h-3z");
  EXPECT_EQ(pictures::path_at(loops, 10.0, 20.0, 2.0, -0.5), "M10.0 20.0H16.0V19.0H10.0z");
  EXPECT_TRUE(pictures::outline({3, 2, std::vector<char>(6, 0)}).empty());
}

TEST(ColourMap, LightnessGrowsEvenly) {
  const auto lightness = [](double value) {  // CIE L* of an sRGB colour
    unsigned red = 0, green = 0, blue = 0;
    EXPECT_EQ(std::sscanf(pictures::colour(value).c_str(), "#%2x%2x%2x", &red, &green, &blue), 3);
    const auto linear = [](unsigned c) {
      return c <= 10 ? c / 255.0 / 12.92 : std::pow((c / 255.0 + 0.055) / 1.055, 2.4);
    };
    return 116.0 * std::cbrt(0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue)) - 16.0;
  };
  const int steps = 24;
  const double mean = (lightness(1.0) - lightness(0.0)) / steps;
  EXPECT_GT(mean * steps, 70.0);
  for (int i = 0; i < steps; ++i) {
    const double step = lightness((i + 1.0) / steps) - lightness(static_cast<double>(i) / steps);
    EXPECT_GT(step, 0.5 * mean);
    EXPECT_LT(step, 1.6 * mean);
  }
  EXPECT_EQ(pictures::colour(-3.0), pictures::colour(0.0));
  EXPECT_EQ(pictures::colour(7.0), pictures::colour(1.0));
  EXPECT_EQ(pictures::colour(std::nan("")), "#999999");
}

TEST(PatchPicture, CoarseningKeepsPlaceAreaAndForce) {
  const io::PatchResult patch = testing::ball_patch(500, 400, 1e9);
  const pictures::PatchPicture picture = pictures::make_patch_picture(patch.fields);
  EXPECT_LE(picture.nx, 96);
  EXPECT_LE(picture.ny, 96);
  double force = 0.0, area = 0.0;
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    force += picture.contact[i] ? picture.values[i] * picture.dx * picture.dy * 1e-6 : 0.0;
    area += picture.contact[i] ? picture.dx * picture.dy : 0.0;
  }
  const double kBlocks = 0.01;  // blocks at the edge are taken whole or not at all
  EXPECT_NEAR(force, patch.fn, kBlocks * patch.fn);
  EXPECT_NEAR(area, M_PI * 16.0, kBlocks * M_PI * 16.0);
  EXPECT_NEAR(picture.extent().x_low, -4.0, picture.dx);
  EXPECT_NEAR(picture.extent().y_high, 4.0, 2.0 * picture.dy);
}

TEST(PressureSvg, OnePanelACaseAndWellFormed) {
  const std::string svg = pictures::pressure_svg(testing::sample_run());
  const testing::XmlElement root = testing::read_xml(svg);
  EXPECT_EQ(root.name, "svg");
  EXPECT_EQ(root.find("g", "class", "panel").size(), 4u);
  EXPECT_NE(svg.find("pitch -25.00"), std::string::npos);
  EXPECT_NE(svg.find(">no contact<"), std::string::npos);
  EXPECT_NE(svg.find(">case 2<"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(PressureSvg, WheelsetsThatDifferInTheirPlaceOnlyAreToldApartByIt) {
  io::RunResult run = testing::sample_run();
  run.cases.resize(2, run.cases.front());
  run.cases[1] = run.cases[0];
  run.cases[0].has_wheelset = run.cases[1].has_wheelset = true;
  run.cases[1].s = run.cases[0].s - 30.5e-3;
  const std::string shown = fmt::format(">s {:.4g} mm<", 1e3 * run.cases[1].s);
  EXPECT_NE(pictures::pressure_svg(run).find(shown), std::string::npos);
  run.cases[1].pitch += 0.1;
  EXPECT_EQ(pictures::pressure_svg(run).find(shown), std::string::npos);
}

TEST(PressureSvg, TheFilledBaseCoversTheElementsInContact) {
  io::RunResult run;
  run.cases.emplace_back();
  run.cases[0].patches.push_back(testing::ball_patch(40, 36, 1e9));
  const testing::XmlElement root = testing::read_xml(pictures::pressure_svg(run));
  const auto base = root.find("path", "fill", pictures::step_colour(0, pictures::kPatchSteps));
  ASSERT_EQ(base.size(), 1u);
  EXPECT_EQ(path_area(base[0]->attributes.at("d")), run.cases[0].patches[0].ncon);
  // Steps of equal pressure, darkest to lightest, each inside the one before.
  double before = run.cases[0].patches[0].ncon + 1.0;
  for (std::size_t step = 0; step < pictures::kPatchSteps; ++step) {
    const auto layer = root.find("path", "fill", pictures::step_colour(step, pictures::kPatchSteps));
    ASSERT_EQ(layer.size(), 1u);
    const double area = path_area(layer[0]->attributes.at("d"));
    EXPECT_LE(area, before);
    before = area;
  }
}

TEST(PressureSvg, ThirteenCasesStaySmall) {
  io::RunResult run;
  for (int i = 0; i < 13; ++i) {
    run.cases.emplace_back();
    run.cases.back().patches.push_back(testing::ball_patch(60 + i, 60, 1e9));
  }
  EXPECT_LT(pictures::pressure_svg(run).size(), 300000u);
}

TEST(PressureSvg, OfThousandsOfCasesItSaysHowManyItShows) {
  io::RunResult run;
  for (int i = 0; i < 3000; ++i) run.cases.emplace_back().number = i + 1;
  const std::string svg = pictures::pressure_svg(run);
  EXPECT_EQ(testing::read_xml(svg).find("g", "class", "panel").size(), 500u);
  for (const char* words : {"500 of 3000 cases", ">case 1<", ">case 3000<"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
}

TEST(PressureSvg, AnEmptyRunAndMissingFieldsStillGiveAPicture) {
  EXPECT_NO_THROW(testing::read_xml(pictures::pressure_svg({})));
  io::RunResult run;
  run.cases.emplace_back();
  run.cases[0].patches.emplace_back();
  EXPECT_NE(pictures::pressure_svg(run).find("no fields"), std::string::npos);
}

TEST(PressureSvg, RefusesFieldsThatDoNotMatchTheirGrid) {
  io::RunResult run = testing::sample_run();
  run.cases[0].patches[0].fields.pressure.pop_back();
  EXPECT_THROW(pictures::pressure_svg(run), Error);
}

}  // namespace
}  // namespace treadmark
