// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/track/track_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/solvers/vehicle/track/track_receptance.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using treadmark::testing::ProgramResult;
using treadmark::testing::run_program;
using treadmark::testing::TemporaryFolder;

const std::string kTracks = std::string(TREADMARK_SOURCE_DIR) + "/examples/tracks/";

TrackRequest request_of(const std::string& file, int layers) {
  TrackRequest request;
  request.file = kTracks + file;
  request.count = 40;
  request.layers = layers;
  return request;
}

std::string error_of(const TrackRequest& request) {
  return treadmark::testing::refusal_of([&] { run_track(request); });
}

TEST(TrackRun, TheShippedFitIsWhatIsFittedNow) {
  TrackRequest request = request_of("zhai-flexible.toml", 3), shipped = request_of("zhai-fitted.toml", 0);
  request.count = shipped.count = 200;
  const TrackResult now = run_track(request), then = run_track(shipped);
  ASSERT_EQ(then.typical().receptance.size(), 200u);
  for (std::size_t i = 0; i < 200; ++i) {
    const std::complex<double> wanted = now.fitted.value().curve.receptance[i];
    EXPECT_LT(std::abs(then.typical().receptance[i] - wanted), 1e-3 * std::abs(wanted)) << now.frequency[i] << " Hz";
  }
}

/// The beam on a bed by Euler, which yields less: without shear, and held everywhere.
TEST(TrackRun, StiffnessAtRestIsNearThatOfABeamOnABed) {
  const TrackResult r = run_track(request_of("zhai-flexible.toml", 0));
  const double bed = 65e6 * 137.75e6 / (65e6 + 137.75e6) / 0.545;
  const double euler = 2.0 * std::sqrt(2.0) * std::pow(6.6238e6, 0.25) * std::pow(bed, 0.75);
  ASSERT_EQ(r.curves.size(), 3u);
  for (const TrackCurve& curve : r.curves) {
    EXPECT_LT(1.0 / curve.at_rest, euler) << curve.name;
    EXPECT_GT(1.0 / curve.at_rest, 0.9 * euler) << curve.name;
  }
  EXPECT_GT(r.curves[0].at_rest, r.curves[2].at_rest);
  EXPECT_GT(r.curves[2].at_rest, r.curves[1].at_rest);
  ASSERT_TRUE(r.bay);
  EXPECT_NEAR(r.bay->peak / r.bay->pinned_pinned, 1.0, 0.01);
  EXPECT_GT(r.bay->peak_ratio, 5.0);
  EXPECT_NEAR(*ranges::max_element(r.bay->deflection) / r.curves[0].at_rest, 1.0, 1e-12);
}

/// Another program's fit to a continuous bed was off by 0.09; sleepers one by one add their resonance.
TEST(TrackRun, FitsAreAsNearAsTwoAndThreeLayersCome) {
  const TrackResult two = run_track(request_of("zhai-flexible.toml", 2)),
                    three = run_track(request_of("zhai-flexible.toml", 3));
  EXPECT_LT(two.fitted->fit.error.rms, 0.12);
  EXPECT_LT(three.fitted->fit.error.rms, two.fitted->fit.error.rms);
}

TEST(TrackRun, TheFittedFileHasTheFittedReceptance) {
  for (const int layers : {1, 2, 3}) {
    const TrackResult r = run_track(request_of("zhai-flexible.toml", layers));
    const TrackModel track = io::parse_track_text(fitted_text(r), "fitted.toml");
    EXPECT_EQ(track.bodies.size(), 2u * static_cast<std::size_t>(layers));
    const auto vertical = vehicle::receptance(track, Freedom::z, r.frequency);
    for (std::size_t i = 0; i < vertical.size(); ++i)
      EXPECT_LT(std::abs(vertical[i] / r.fitted->curve.receptance[i] - 1.0), 1e-9);
    // Sideways pad and bed, one behind the other, and the rail rolls on its foot, 0.17 m below the force and 0.15 m
    // wide; a head rolls on the rail, too.
    const std::vector<vehicle::LumpedLayer>& found = r.fitted->fit.layers;
    const double foot = 0.15 * 0.15 / 12.0, pad = found[layers == 3 ? 1 : 0].stiffness;
    double expected = 1.0 / 30e6 + 1.0 / 35e6 + 0.17 * 0.17 / (pad * foot);
    if (layers == 3) expected += (1.0 + 0.09 * 0.09 / foot) / found[0].stiffness;
    const double rest[] = {0.0};
    EXPECT_NEAR(vehicle::receptance(track, Freedom::y, rest).front().real() / expected, 1.0, 1e-9);
  }
}

/// Sideways a rail gives way by its torsion, too; beside the middle of its head the contact rolls up and down with it.
TEST(TrackRun, RailsBendSidewaysAndRoll) {
  TrackRequest request = request_of("zhai-sideways.toml", 0);
  const TrackResult middle = run_track(request);
  request.aside = 0.02;
  const TrackResult beside = run_track(request);
  ASSERT_EQ(middle.lateral.size(), 3u);
  ASSERT_EQ(beside.lateral.size(), 4u);
  EXPECT_GT(middle.lateral[0].at_rest, middle.lateral[2].at_rest);
  EXPECT_GT(middle.lateral[2].at_rest, middle.lateral[1].at_rest);
  // Softer than by bending alone, a third of it by torsion.
  EXPECT_GT(middle.lateral[2].at_rest, 1.2 * (1.0 / 30e6 + 1.0 / 35e6));
  EXPECT_GT(beside.curves[0].at_rest, middle.curves[0].at_rest);
  EXPECT_EQ(beside.lateral[0].at_rest, middle.lateral[0].at_rest);
  EXPECT_GT(beside.lateral[3].at_rest, 0.0);
  ASSERT_TRUE(middle.bay && middle.bay->lateral_pinned_pinned);
  EXPECT_LT(*middle.bay->lateral_pinned_pinned, middle.bay->pinned_pinned);
  request = request_of("zhai-equivalent.toml", 0);
  request.aside = 0.02;
  EXPECT_THAT(error_of(request), HasSubstr("only rails that bend and roll"));
}

TEST(TrackRun, FindsALumpedTrackAgain) {
  const TrackResult r = run_track(request_of("gm-tt0088.toml", 1));
  EXPECT_FALSE(r.flexible);
  EXPECT_FALSE(r.bay);
  EXPECT_NEAR(1.0 / r.typical().at_rest, 62e6, 1.0);
  ASSERT_EQ(r.lateral.size(), 1u);
  EXPECT_NEAR(1.0 / r.lateral[0].at_rest, 16.154e6, 1.0);
  const vehicle::LumpedLayer& layer = r.fitted->fit.layers.at(0);
  EXPECT_NEAR(layer.mass / 245.0, 1.0, 1e-5);
  EXPECT_NEAR(layer.stiffness / 62e6, 1.0, 1e-5);
  EXPECT_NEAR(layer.damping / 55.4e3, 1.0, 1e-5);
  EXPECT_LT(r.fitted->fit.error.rms, 1e-6);
}

TEST(TrackRun, RefusesFrequenciesThatAreNoRange) {
  TrackRequest request = request_of("gm-tt0088.toml", 0);
  request.from = 2000.0;
  EXPECT_THAT(error_of(request), HasSubstr("40 frequencies from 2000 to 1500 Hz make no range"));
}

TEST(TrackCommand, WritesItsFolderTableAndNumbers) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string(), csv = (folder.path() / "r.csv").string();
  const ProgramResult r = run_program({"track", kTracks + "zhai-flexible.toml", "--fit", "2", "--count", "30",
                                       "--receptance", csv, "-o", out, "--set", "seats.pad_stiffness_N_per_m=100e6"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("Rails on sleepers, Zhai 2004: flexible"), HasSubstr("pinned-pinned frequency"),
                           HasSubstr("fit of 2 layers"), HasSubstr("receptance [nm/N]")));
  EXPECT_EQ(io::read_text(csv), io::read_text(out + "/receptance.csv"));
  EXPECT_THAT(io::read_text(csv), ::testing::StartsWith("frequency_Hz,between_m_per_N,between_phase_deg,over_m_per_N"));
  EXPECT_THAT(io::read_text(out + "/track.svg"), HasSubstr("</svg>"));
  EXPECT_EQ(std::get<TrackModel>(io::read_any_track_file(out + "/fitted.toml")).bodies.size(), 4u);
  const auto json = nlohmann::json::parse(io::read_text(out + "/track.json"));
  EXPECT_EQ(json.at("kind"), "flexible");
  EXPECT_EQ(json.at("seats"), 120);
  EXPECT_EQ(json.at("frequency_Hz").size(), 30u);
  EXPECT_EQ(json.at("curves").at("mean").at("m_per_N").size(), 30u);
  EXPECT_EQ(json.at("fit").at("layers").size(), 2u);
  const ProgramResult softer = run_program({"track", kTracks + "zhai-flexible.toml", "--count", "30", "--json", "-"});
  ASSERT_EQ(softer.status, 0) << softer.err;
  const auto stiffness = [](const nlohmann::json& one) {
    return one.at("curves").at("mean").at("stiffness_at_rest_N_per_m").get<double>();
  };
  EXPECT_LT(stiffness(nlohmann::json::parse(softer.out)), stiffness(json));
}

TEST(TrackCommand, RefusesWhatItCannotDo) {
  const auto refused = [](std::vector<std::string> more) {
    std::vector<std::string> arguments{"track", kTracks + "zhai-flexible.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  };
  EXPECT_EQ(refused({"--fit", "4"}).status, 2);
  EXPECT_EQ(refused({"--from", "100", "--to", "50"}).status, 2);
  EXPECT_THAT(refused({"--set", "seats.pad_stifness_N_per_m=1e6"}).err, HasSubstr("did you mean"));
  EXPECT_THAT(refused({"--json", kTracks + "zhai-flexible.toml"}).err, HasSubstr("would overwrite"));
  EXPECT_NE(run_program({"track", std::string(TREADMARK_SOURCE_DIR) + "/examples/figure7.toml"}).status, 0);
}

}  // namespace
}  // namespace treadmark::app
