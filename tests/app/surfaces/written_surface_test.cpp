// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "treadmark/app/surfaces/convert_profile.hpp"
#include "treadmark/app/surfaces/written_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"

namespace treadmark::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kFine = 1e-6;  // [m] finer than splines at some mm are

std::ptrdiff_t entries(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

/// The message of a conversion that is refused, which leaves the folder as it was.
template <class Work>
std::string refusal_of(const std::filesystem::path& folder, const Work& work) {
  const std::ptrdiff_t before = entries(folder);
  std::string message;
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    message = error.what();
  }
  EXPECT_EQ(entries(folder), before);
  return message;
}

TEST(WrittenSurface, IsRefusedAndLeavesNothingWhereItLiesFarFromItsSource) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 8e-3;
  settings.tolerance = kFine;
  settings.range_theta = {-0.2, 0.2};
  for (const char* name : {"wheel.ply", "wheel.slcw", "wheel.vdb", "wheel.vtp"}) {
    if (!has_part("openvdb") && std::string(name) == "wheel.vdb") continue;
    const auto file = input.folder() / name;
    EXPECT_THAT(refusal_of(input.folder(), [&] { convert_surface(input.folder() / "flat.toml", file, settings); }),
                AllOf(HasSubstr(name), HasSubstr("read again"), HasSubstr("more than 1 um"), HasSubstr("degrees, y = "),
                      HasSubstr("nothing was written")));
  }
}

TEST(WrittenSurface, LeavesWhatWasThereBefore) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 4e-3;
  settings.range_theta = {-0.2, 0.2};
  const auto file = input.folder() / "wheel.slcw";
  convert_surface(input.folder() / "flat.toml", file, settings);
  const std::string good = input.read("wheel.slcw");
  settings.tolerance = 1e-9;
  refusal_of(input.folder(), [&] { convert_surface(input.folder() / "flat.toml", file, settings); });
  EXPECT_EQ(input.read("wheel.slcw"), good);
}

TEST(WrittenSurface, ProfilesAreReadAgainToo) {
  const treadmark::testing::SampleInput input;
  ConvertSettings settings;
  for (const char* name : {"rail.csv", "rail.prr", "rail.ban"}) {
    const auto file = input.folder() / "new" / name;
    settings.resolution = 0.0, settings.tolerance = 0.0;
    convert_profile("60E1", file, settings, {});
    EXPECT_TRUE(std::filesystem::exists(file));
    settings.resolution = 6e-3, settings.tolerance = kFine;
    EXPECT_THAT(
        refusal_of(
            input.folder() / "new",
            [&] { convert_profile("60E1", input.folder() / "new" / ("x" + file.extension().string()), settings, {}); }),
        HasSubstr("the points lie up to"));
  }
}

TEST(WrittenSurface, StatesItsToleranceOnTheCommandLine) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  const auto run = [&](const char* tolerance) {
    return treadmark::testing::run_program({"convert", (input.folder() / "flat.toml").string(),
                                            (input.folder() / "out.slcw").string(), "--body", "wheel", "--resolution",
                                            "8", "--range-deg=-10,10", "--tolerance-um", tolerance});
  };
  const treadmark::testing::ProgramResult refused = run("0.5");
  EXPECT_EQ(refused.status, 1) << refused.out;
  EXPECT_THAT(refused.err, HasSubstr("--tolerance-um"));
  EXPECT_FALSE(std::filesystem::exists(input.folder() / "out.slcw"));
  EXPECT_EQ(run("1000").status, 0);
  EXPECT_TRUE(std::filesystem::exists(input.folder() / "out.slcw"));
}

TEST(WrittenSurface, SamplesMayBeOffByWhatASharpArcRisesBetweenThem) {
  EXPECT_DOUBLE_EQ(sampled_tolerance(0.0), kWrittenTolerance);
  EXPECT_DOUBLE_EQ(sampled_tolerance(0.5e-3), kWrittenTolerance);
  EXPECT_NEAR(sampled_tolerance(2e-3), 50e-6, 1e-9);
}

}  // namespace
}  // namespace treadmark::app
