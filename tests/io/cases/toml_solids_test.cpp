// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/tests/io/cases/parsed_cases.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using ::testing::HasSubstr;

const std::string kWheelOfSolids = "wheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1e5\n";
const std::string kSolids = kWheelOfSolids + R"([rail.shape]
voxel_mm = 0.4
[[rail.shape.solids]]
file = 'sub\rail.stl'
[[rail.shape.solids]]
file = "cutter.vdb"
use = "cut"
scale_to_mm = 1000
grid = "tool"
x_mm = 3
z_mm = -24.2
[[rail.shape.solids]]
file = "/data/block.ply"
use = "common"
)";

void expect_everything(const SurfaceSource& rail) {
  const auto& given = std::get<SolidsInput>(rail.geometry);
  EXPECT_DOUBLE_EQ(given.voxel, 0.4e-3);
  ASSERT_EQ(given.solids.size(), 3u);
  const SolidInput &body = given.solids[0], &cutter = given.solids[1], &last = given.solids[2];
  EXPECT_EQ(body.file, "folder/sub/rail.stl");
  EXPECT_EQ(body.use, Solid::Use::join);
  EXPECT_EQ(body.scale, 1.0);
  EXPECT_EQ(cutter.file, "folder/cutter.vdb");
  EXPECT_EQ(cutter.use, Solid::Use::cut);
  EXPECT_EQ(cutter.scale, 1000.0);
  EXPECT_EQ(cutter.grid, "tool");
  EXPECT_LE((cutter.offset - Vec3(3e-3, 0.0, -24.2e-3)).norm(), 1e-15);
  // written it is relative to the folder of the case
  EXPECT_EQ(std::filesystem::absolute(last.file).lexically_normal(), "/data/block.ply");
  EXPECT_EQ(last.use, Solid::Use::common);
}

TEST(TomlSolids, EveryKeyFindsItsPlaceAndIsWrittenAgain) {
  const CaseFile read = parse_study(kSolids);
  expect_everything(rail_case(read, 0).rail);
  std::string written = kWheelOfSolids;
  for (const CaseKey& key : case_keys())
    if (key.info.path == "rail.shape.solids" || key.info.path == "rail.shape.voxel_mm")
      written += key.info.path + " = " + key.written(read.cases.front(), "folder") + "\n";
  expect_everything(rail_case(parse_study(written), 0).rail);
}

TEST(TomlSolids, OverridesReachIntoThem) {
  const CaseFile read = parse_study(
      kSolids, {"rail.shape.solids.1.z_mm=-20", "rail.shape.solids.0.file=/data/rail.stl", "rail.shape.voxel_mm=0.3"});
  const auto& given = std::get<SolidsInput>(rail_case(read, 0).rail.geometry);
  EXPECT_DOUBLE_EQ(given.solids[1].offset.z(), -20e-3);
  EXPECT_EQ(given.solids[0].file, "/data/rail.stl");
  EXPECT_DOUBLE_EQ(given.voxel, 0.3e-3);
  EXPECT_THAT(study_refusal(kSolids, {"rail.shape.solids.0.file=other.stl"}), HasSubstr("full path"));
}

TEST(TomlSolids, RefusesContradictions) {
  EXPECT_THAT(study_refusal(kSolids + "[[rail.shape.arcs]]\nlength_mm = 3\n"), HasSubstr("exclude each other"));
  EXPECT_THAT(study_refusal(kRail + "rail.shape.voxel_mm = 1\n"), HasSubstr("belongs to a shape given by solids"));
  EXPECT_THAT(study_refusal(kWheelOfSolids + "rail.shape.solids = [{ file = \"a.stl\", use = \"cut\" }]\n"),
              HasSubstr("the first body must be joined"));
  EXPECT_THAT(study_refusal(kWheelOfSolids + "rail.shape.solids = [{ use = \"join\" }]\n"), HasSubstr("file"));
  EXPECT_THAT(study_refusal(kWheelOfSolids + "rail.shape.solids = []\n"), HasSubstr("rail.shape.solids"));
}

}  // namespace
}  // namespace treadmark::io
