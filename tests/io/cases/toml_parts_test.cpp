// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "treadmark/io/cases/read_toml.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;

const std::string kWheel = "wheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1e5\n";
const std::string kParts = kWheel + R"([[rail.parts]]
standard = "60E1"
crossing = "nose"
crossing_x_mm = 200
crossing_slope = 0.05
crossing_length_mm = 300
crossing_rounding_mm = 80
y_mm = -40
z_mm = 1.5
backend = "mesh"
resolution_mm = 0.7
[[rail.parts]]
file = 'sub\wing.slcs'
mirror_y = true
scale_to_mm = 1000
x_mm = 12
[[rail.parts]]
arcs = [{ length_mm = 20, radius_mm = 300 }, { length_mm = 10 }]
start_y_mm = -10
start_z_mm = 1
start_angle_deg = 5
)";

WheelRailCase parts_case(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return std::get<WheelRailCase>(parse_case_text(text, "folder/study.toml", overrides).cases.at(0).content);
}

void expect_refused(const std::string& text, const char* words, const std::vector<std::string>& overrides = {}) {
  try {
    parts_case(text, overrides);
    ADD_FAILURE() << "accepted, expected: " << words;
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::configuration);
    EXPECT_THAT(e.what(), HasSubstr(words));
  }
}

TEST(TomlParts, EveryKeyFindsItsPlace) {
  const SurfaceSource rail = parts_case(kParts).rail;
  ASSERT_EQ(rail.parts.size(), 3u);
  const SurfaceSource &nose = rail.parts[0], &wing = rail.parts[1], &chain = rail.parts[2];
  EXPECT_EQ(std::get<StandardProfile>(nose.geometry).name, "60E1");
  EXPECT_EQ(nose.crossing.part, CrossingInput::Part::nose);
  EXPECT_DOUBLE_EQ(nose.crossing.x, 0.2);
  EXPECT_DOUBLE_EQ(nose.crossing.slope, 0.05);
  EXPECT_DOUBLE_EQ(nose.crossing.length, 0.3);
  EXPECT_DOUBLE_EQ(nose.crossing.rounding, 0.08);
  EXPECT_LE((nose.offset - Vec3(0.0, -0.04, 1.5e-3)).norm(), 1e-15);
  EXPECT_EQ(nose.backend, "mesh");
  EXPECT_DOUBLE_EQ(nose.resolution, 0.7e-3);
  const GeometryFile& file = std::get<GeometryFile>(wing.geometry);
  EXPECT_EQ(file.file, "folder/sub/wing.slcs");
  EXPECT_EQ(file.options.mirror_y, 1);
  EXPECT_EQ(file.options.scale, 1000.0);
  EXPECT_DOUBLE_EQ(wing.offset.x(), 0.012);
  EXPECT_EQ(wing.crossing, CrossingInput{});
  EXPECT_EQ(wing.where.line, 15);
  const ArcChain& arcs = std::get<ArcChain>(chain.geometry);
  ASSERT_EQ(arcs.segments.size(), 2u);
  EXPECT_DOUBLE_EQ(arcs.segments[0].curvature, 1.0 / 0.3);
  EXPECT_DOUBLE_EQ(arcs.start_y, -0.01);
  EXPECT_NEAR(arcs.start_angle, 0.0872664626, 1e-9);
}

TEST(TomlParts, OverridesReachIntoParts) {
  const SurfaceSource rail =
      parts_case(kParts, {"rail.parts.0.crossing_slope=0.02", "rail.parts.1.file=/data/wing.slcs",
                          "rail.parts.2.backend=nurbs", "rail.parts.2.arcs.1.length_mm=15"})
          .rail;
  EXPECT_DOUBLE_EQ(rail.parts[0].crossing.slope, 0.02);
  EXPECT_EQ(std::get<GeometryFile>(rail.parts[1].geometry).file, "/data/wing.slcs");
  EXPECT_EQ(rail.parts[2].backend, "nurbs");
  EXPECT_DOUBLE_EQ(std::get<ArcChain>(rail.parts[2].geometry).segments[1].length, 0.015);
  expect_refused(kParts, "full path", {"rail.parts.1.file=other.slcs"});
  expect_refused(kParts, "number 3 (counted from 0) does not exist", {"rail.parts.3.y_mm=1"});
}

TEST(TomlParts, OneRailCanMoveItsSectionToo) {
  const SurfaceSource rail =
      parts_case(kWheel + "[rail.shape]\nstandard = \"60E1\"\ncrossing = \"wing\"\ncrossing_y_mm = 3\n").rail;
  EXPECT_EQ(rail.crossing.part, CrossingInput::Part::wing);
  EXPECT_DOUBLE_EQ(rail.crossing.y, 3e-3);
  EXPECT_DOUBLE_EQ(rail.crossing.slope, 0.1);
}

TEST(TomlParts, RefusesContradictions) {
  expect_refused(kParts + "[rail.shape]\nstandard = \"60E1\"\n", "rail.shape and rail.parts exclude each other");
  expect_refused(kParts + "[rail.shape]\ncrossing = \"nose\"\n", "rail.shape.crossing does not belong to rail.parts");
  expect_refused(kParts + "[[rail.squats]]\nlength_mm = 20\nwidth_mm = 20\ndepth_mm = 0.1\n",
                 "defects cannot be added to rail.parts");
  expect_refused(kWheel + "[[rail.parts]]\ny_mm = 3\n", "rail.parts[0].shape is missing");
  expect_refused(kWheel + "[[rail.parts]]\nstandard = \"60E1\"\nfile = \"a.prr\"\n", "exclude each other");
  expect_refused(kWheel + "[[rail.parts]]\nstandard = \"60E1\"\nmirror_y = true\n",
                 "mirror_y belongs to a part given by a file");
  expect_refused(kWheel + "[[rail.parts]]\nstandard = \"60E1\"\nstart_y_mm = 1\n",
                 "start_y_mm belongs to a part given by arcs");
  expect_refused(kWheel + "[[rail.parts]]\nstandard = \"60E1\"\ncrossing_length_mm = 40\ncrossing = \"nose\"\n",
                 "crossing_length_mm must be more than");
  expect_refused(kWheel + "[[rail.parts]]\nstandard = \"60E1\"\nbackend = \"My Mesh\"\n", "does not look like");
  expect_refused(kWheel + "[rail.shape]\nstandard = \"60E1\"\ncrossing_slope = 2\n", "must be at most 1");
}

TEST(TomlParts, SeamsOfWheelsAreSmoothUnlessAskedFor) {
  const std::string text =
      "rail.shape.standard = \"60E1\"\nwheelset.vertical_force_N = 1e5\nwheel.shape.file = \"w.slcw\"\n";
  EXPECT_FALSE(std::get<GeometryFile>(parts_case(text).wheel.geometry).open_seam);
  EXPECT_TRUE(std::get<GeometryFile>(parts_case(text + "wheel.shape.open_seam = true\n").wheel.geometry).open_seam);
  expect_refused(
      "rail.shape.standard = \"60E1\"\nwheelset.vertical_force_N = 1e5\nwheel.shape.standard = "
      "\"S1002\"\nwheel.shape.open_seam = true\n",
      "belongs to a shape given by a file");
}

}  // namespace
}  // namespace treadmark::io
