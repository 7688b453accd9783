// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;

io::CaseResult solved(const std::filesystem::path& file) {
  return run_cases(io::read_any_case(file.string(), {})).cases.at(0);
}

TEST(CadWheel, GivesTheContactOfTheStandardProfile) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("standard.toml", treadmark::testing::standard_case("0.5"));
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 0.1e-3;
  const Converted c = convert_surface(input.folder() / "standard.toml", input.folder() / "wheel.step", settings);
  EXPECT_EQ(c.kind, "CAD");
  EXPECT_GT(c.fit.points, 1000u);
  EXPECT_LT(c.fit.height_max, 0.5e-6);  // the joints of S1002 are steps
  EXPECT_LT(c.fit.height_rms, 0.1e-6);
  input.write("cad.toml", treadmark::testing::standard_case("0.5", "shape.file = \"wheel.step\"\n"));
  const io::CaseResult given = solved(input.folder() / "standard.toml"), cad = solved(input.folder() / "cad.toml");
  ASSERT_EQ(cad.status, Status::ok);
  ASSERT_EQ(cad.patches.size(), given.patches.size());
  EXPECT_NEAR(cad.patches[0].pmax / given.patches[0].pmax, 1.0, 1e-3);
  EXPECT_NEAR(cad.patches[0].y_tr, given.patches[0].y_tr, 1e-5);
}

TEST(CadRail, ASquatGoesThereAndBack) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("squat.toml", treadmark::testing::standard_case("1.0", "shape.standard = \"S1002\"\n",
                                                              "[[rail.squats]]\nlength_mm = 30\nwidth_mm = 40\n"
                                                              "depth_mm = 0.2\ny_center_mm = -5\n"));
  ConvertSettings settings;
  settings.body = Body::rail;
  settings.resolution = 1e-3;
  settings.range_x = {-0.03, 0.03};
  const Converted c = convert_surface(input.folder() / "squat.toml", input.folder() / "rail.step", settings);
  EXPECT_LT(c.fit.height_max, 15e-6);  // on the steep sides, where the surface through points sways
  EXPECT_LT(c.fit.height_rms, 1e-6);
  EXPECT_THAT(c.written.note, HasSubstr("slices"));
}

TEST(CadFiles, HaveUnitsOfTheirOwn) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("cad.toml",
              treadmark::testing::standard_case("1.0", "shape.file = \"wheel.step\"\nshape.scale_to_mm = 2\n"));
  input.write("wheel.step", "");
  EXPECT_THAT(treadmark::testing::error_of([&] { solved(input.folder() / "cad.toml"); }),
              HasSubstr("units of their own"));
}

}  // namespace
}  // namespace treadmark::app
