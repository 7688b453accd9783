// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <tuple>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;

std::string flat_case(const std::string& wheel) {
  return treadmark::testing::standard_case("1.0", wheel, "[[cases]]\nwheelset.pitch_deg = 1.5\n");
}

double largest_pressure(const std::filesystem::path& file) {
  return run_cases(io::read_any_case(file.string(), {})).cases.at(0).patches.at(0).pmax;
}

class Convert : public ::testing::TestWithParam<std::tuple<std::string, double>> {};

INSTANTIATE_TEST_SUITE_P(
    Kinds, Convert,
    ::testing::Values(std::tuple{std::string("wheel.ply"), 2e-3}, std::tuple{std::string("wheel.stl"), 2e-3},
                      std::tuple{std::string("wheel.obj"), 2e-3}, std::tuple{std::string("wheel.off"), 2e-3},
                      std::tuple{std::string("wheel.vdb"), 1e-3}, std::tuple{std::string("wheel.nvdb"), 1e-3},
                      std::tuple{std::string("wheel.slcw"), 1e-3}),
    [](const auto& which) { return std::get<0>(which.param).substr(6); });

TEST_P(Convert, TheFileGivesTheSameContact) {
  const auto [name, tolerance] = GetParam();
  if (name.ends_with("vdb")) {
    TREADMARK_NEEDS(name.ends_with(".nvdb") ? "nanovdb" : "openvdb");
  }
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", flat_case(treadmark::testing::kWheelWithFlat));
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 2e-3;
  settings.range_theta = {-0.28, 0.23};
  const Converted converted = convert_surface(input.folder() / "flat.toml", input.folder() / name, settings);
  EXPECT_LT(converted.fit.height_max, 1.5e-5);
  EXPECT_GT(converted.fit.points, 1000u);
  input.write("again.toml", flat_case("shape.file = \"" + name + "\"\n"));
  const double given = largest_pressure(input.folder() / "flat.toml"),
               again = largest_pressure(input.folder() / "again.toml");
  EXPECT_NEAR(again / given, 1.0, tolerance);
}

TEST(ConvertSurface, FromTrianglesToSlicesAndOffsets) {
  TREADMARK_NEEDS("openvdb");
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", flat_case(treadmark::testing::kWheelWithFlat));
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 1e-3;
  settings.range_theta = {-0.1, 0.1};
  const auto ply = input.folder() / "wheel.ply";
  convert_surface(input.folder() / "flat.toml", ply, settings);
  settings.range_theta.reset();
  settings.nominal_radius = 0.46;
  for (const char* name : {"again.slcw", "again.vdb"}) {
    const Converted c = convert_surface(ply, input.folder() / name, settings);
    EXPECT_LT(c.fit.height_max, 5e-6) << name;  // the part of the wheel is found, its ragged ends left out
    EXPECT_NEAR(c.written.region.u_max, 0.1, 2.0 * std::numbers::pi / 200.0) << name;  // stations of the median section
  }
}

TEST(ConvertSurface, OffsetsStayWhatTheyAre) {
  TREADMARK_NEEDS("nanovdb");
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", flat_case(treadmark::testing::kWheelWithFlat));
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 2e-3;
  settings.range_theta = {-0.28, 0.23};
  convert_surface(input.folder() / "flat.toml", input.folder() / "first.nvdb", settings);
  std::string before = "first.nvdb";
  for (const std::string name : {"second.nvdb", "third.vdb", "fourth.nvdb"}) {
    if (!has_part("openvdb") && (name == "third.vdb" || before == "third.vdb")) continue;
    const Converted c = convert_surface(input.folder() / before, input.folder() / name, {});
    EXPECT_EQ(c.fit.height_max, 0.0) << name;
    before = name;
  }
  EXPECT_EQ(input.read(before), input.read("first.nvdb"));
}

TEST(ConvertSurface, ClosesAWholeWheel) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", flat_case(treadmark::testing::kWheelWithFlat));
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 8e-3;
  const Converted c = convert_surface(input.folder() / "flat.toml", input.folder() / "wheel.slcw", settings);
  EXPECT_EQ(c.fit.missing, 0u);
  EXPECT_GT(c.fit.points, 10000u);
}

TEST(ConvertSurface, SaysWhatIsMissing) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", flat_case(treadmark::testing::kWheelWithFlat));
  const auto expect = [&](const char* in, const char* out, const ConvertSettings& settings, const char* words) {
    try {
      convert_surface(input.folder() / in, input.folder() / out, settings);
      ADD_FAILURE() << "accepted, expected: " << words;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), HasSubstr(words));
    }
    EXPECT_FALSE(std::filesystem::exists(input.folder() / out)) << out;
  };
  ConvertSettings wheel, rail;
  wheel.body = Body::wheel;
  rail.body = Body::rail;
  expect("flat.toml", "x.ply", {}, "--body");
  ConvertSettings scaled = wheel, changed = wheel;
  scaled.scale_to_mm = 25.4;
  expect("flat.toml", "x.ply", scaled, "--scale belongs to");
  changed.overrides = {"wheelset.y_mm=1"};
  expect("wheel.txt", "x.ply", changed, "--set changes keys of case files");
  expect("flat.toml", "x.dat", wheel, "cannot be written");
  expect("wheel.txt", "x.ply", wheel, "--nominal-radius");
  expect("flat.toml", "x.slcs", wheel, "*.slcw");
  rail.range_theta = {0.0, 1.0};
  expect("flat.toml", "x.ply", rail, "degrees");
  wheel.range_theta = {1.0, 0.0};
  expect("flat.toml", "x.ply", wheel, "smaller to a greater");
  wheel.range_theta = {0.0, 0.1};
  wheel.resolution = 1e-7;
  expect("flat.toml", "x.ply", wheel, "");
}

TEST(ConvertCommand, ReportsTheFit) {
  const treadmark::testing::SampleInput input;
  const auto out = input.folder() / "rail.stl";
  const auto r = treadmark::testing::run_program(
      {"convert", (input.folder() / "rail.prr").string(), out.string(), "--resolution", "2", "--range-mm=-50,50"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("triangles, rail as mesh at 2 mm: at most"));
  EXPECT_TRUE(std::filesystem::exists(out));
  EXPECT_EQ(treadmark::testing::run_program({"convert", (input.folder() / "none.prr").string(), out.string()}).status,
            3);
}

}  // namespace
}  // namespace treadmark::app
