// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using treadmark::testing::ProgramResult;
using treadmark::testing::run_program;
using treadmark::testing::TemporaryFolder;

/// Of one wheelset on tables.
ProgramResult response_of(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"response", TREADMARK_SOURCE_DIR "/examples/flat-at-speed.toml",
                                     "--set",    "simulation.vehicle=vehicles/single-wheelset.toml",
                                     "--set",    "simulation.wheels=[]"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments);
}

TEST(ResponseCommand, WritesEveryCurveOfWhatWasAskedFor) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const ProgramResult r = response_of({"--from", "1", "--to", "4", "--count", "3", "--inputs",
                                       "longitudinal_level,ws1_left.vertical_*", "--channels", "ws1_*.Q_N", "-o", out});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("ws1_left.vertical_force"), HasSubstr("N/m"), HasSubstr("N/N")));
  const auto json = nlohmann::json::parse(io::read_text(out + "/response.json"));
  ASSERT_EQ(json.at("frequency_Hz").size(), 3u);
  EXPECT_NEAR(json.at("frequency_Hz")[1].get<double>(), 2.0, 1e-9);  // equal ratios
  EXPECT_TRUE(json.at("stable").is_boolean());
  const auto& curves = json.at("responses");
  ASSERT_EQ(curves.size(), 4u);
  EXPECT_EQ(curves[0].at("input"), "longitudinal_level");
  EXPECT_EQ(curves[1].at("channel"), "ws1_right.Q_N");
  EXPECT_EQ(curves[2].at("unit"), "N/N");
  constexpr double kSymmetric = 1e-3;  // differences of tables of mirrored wheels
  for (std::size_t i = 0; i < 3; ++i) {
    const double left = curves[0].at("real")[i].get<double>(), right = curves[1].at("real")[i].get<double>();
    EXPECT_NEAR(left / right, 1.0, kSymmetric);
  }
  const std::string csv = io::read_text(out + "/response.csv");
  EXPECT_THAT(csv, StartsWith("input,channel,frequency_Hz,real,imaginary,magnitude,phase_deg,unit\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 3);
  EXPECT_THAT(io::read_text(out + "/response.svg"),
              AllOf(HasSubstr("longitudinal_level: forces"), HasSubstr("ws1_right.Q_N"), HasSubstr("</svg>")));
}

TEST(ResponseCommand, WritesSpectraOnTheTrackAndModes) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const ProgramResult r =
      response_of({"--from", "1", "--to", "200", "--count", "5", "--channels", "ws1_*.Q_N", "--iso-3095", "-o", out});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("on this track"));
  const auto json = nlohmann::json::parse(io::read_text(out + "/response.json"));
  const auto& spectra = json.at("spectra");
  ASSERT_EQ(spectra.size(), 2u);
  EXPECT_EQ(spectra[0].at("channel"), "ws1_left.Q_N");
  EXPECT_EQ(spectra[0].at("density").size(), 5u);
  EXPECT_GT(spectra[0].at("rms").get<double>(), 0.0);
  EXPECT_GT(json.at("modes").size(), 0u);
  EXPECT_GT(json.at("modes")[0].at("frequency_Hz").get<double>(), 0.0);
  const std::string csv = io::read_text(out + "/spectra.csv");
  EXPECT_THAT(csv, StartsWith("channel,frequency_Hz,density,unit\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 5);
  EXPECT_THAT(io::read_text(out + "/response.svg"), HasSubstr("power spectral density on this track: forces"));
  EXPECT_THAT(io::read_text(out + "/modes.svg"), AllOf(HasSubstr("from above"), HasSubstr("</svg>")));
}

TEST(ResponseCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(response_of({"--from", "5", "--to", "2"}).status, 2);
  const ProgramResult input = response_of({"--inputs", "longitudinal_levl"});
  EXPECT_EQ(input.status, 2);
  EXPECT_THAT(input.err, AllOf(HasSubstr("no input is called 'longitudinal_levl'"),
                               HasSubstr("did you mean 'longitudinal_level'?")));
  EXPECT_THAT(response_of({"--channels", "ws1_left.q_N"}).err, HasSubstr("did you mean 'ws1_left.Q_N'?"));
  // Of what a history has only a part responds.
  EXPECT_EQ(response_of({"--count", "2", "--set", R"(simulation.channels=["energy.*", "ws1_*.Q_N"])"}).status, 0);
}

}  // namespace
}  // namespace treadmark::app
