// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "samples.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kFlexible = R"([track]
kind = "flexible"
name = "bending"
source = "made up"

[rail]
bending_stiffness_N_m2 = 6.4e6
shear_stiffness_N = 250e6
mass_kg_per_m = 60
rotary_inertia_kg_m = 0.24
damping_us = 2.5
distance_m = 1.5

[seats]
count = 20
spacings_m = [0.6, 0.5]
pad_stiffness_N_per_m = 80e6
pad_damping_N_s_per_m = 50e3
sleeper_mass_kg = 300
bed_stiffness_N_per_m = 100e6
bed_damping_N_s_per_m = 60e3
absorbing_bays = 4

[[varied]]
first_seat = 3
last_seat = 4
bed_factor = 0
[[varied]]
first_seat = 4
pad_factor = 2
sleeper_factor = 0.5

[lateral]
pad_stiffness_N_per_m = 30e6
bed_stiffness_N_per_m = 35e6
bed_damping_N_s_per_m = 175e3
foot_width_mm = 150
roll_radius_mm = 70
rail_mass_kg = 80
sleeper_mass_kg = 300
)";

FlexibleTrack flexible(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::vector<CaseOverride> changes;
  for (const std::string& one : overrides) changes.push_back(parse_override(one));
  return std::get<FlexibleTrack>(parse_any_track_text(text, "f.toml", changes));
}

std::string refused(const std::string& part, const std::string& other) {
  return samples::error_of([&] { flexible(samples::with(kFlexible, part, other)); });
}

TEST(FlexibleTrackFile, ReadsRailAndSeatsInSIUnits) {
  const FlexibleTrack track = flexible(kFlexible);
  EXPECT_EQ(track.name, "bending");
  EXPECT_EQ(track.source, "made up");
  EXPECT_EQ(track.rail.bending_stiffness, 6.4e6);
  EXPECT_EQ(track.rail.shear_stiffness, 250e6);
  EXPECT_EQ(track.rail.mass, 60.0);
  EXPECT_EQ(track.rail.rotary_inertia, 0.24);
  EXPECT_DOUBLE_EQ(track.rail.damping_time, 2.5e-6);
  EXPECT_EQ(track.gauge, 1.5);
  ASSERT_EQ(track.seats.size(), 20u);
  EXPECT_DOUBLE_EQ(track.seats[1].x - track.seats[0].x, 0.6);
  EXPECT_DOUBLE_EQ(track.seats[2].x - track.seats[1].x, 0.5);
  EXPECT_DOUBLE_EQ(track.seats[3].x - track.seats[2].x, 0.6);
  EXPECT_EQ(track.seats[0].pad_stiffness, 80e6);
  EXPECT_EQ(track.seats[0].pad_damping, 50e3);
  EXPECT_EQ(track.seats[0].sleeper_mass, 150.0);  // half of it
  EXPECT_EQ(track.seats[0].bed_stiffness, 100e6);
  EXPECT_EQ(track.seats[2].bed_stiffness, 0.0);
  EXPECT_EQ(track.seats[3].bed_damping, 0.0);
  EXPECT_EQ(track.seats[2].pad_stiffness, 80e6);
  EXPECT_EQ(track.seats[3].pad_stiffness, 160e6);
  EXPECT_EQ(track.seats[3].pad_damping, 100e3);
  EXPECT_EQ(track.seats[3].sleeper_mass, 75.0);
  EXPECT_EQ(track.bay_elements, 16);
  EXPECT_EQ(track.absorbing_bays, 4);
  EXPECT_EQ(track.absorption, 2000.0);
  ASSERT_TRUE(track.lateral);
  EXPECT_EQ(track.lateral->pad_stiffness, 30e6);
  EXPECT_EQ(track.lateral->pad_damping, 0.0);
  EXPECT_DOUBLE_EQ(track.lateral->foot_width, 0.15);
  EXPECT_DOUBLE_EQ(track.lateral->roll_inertia, 0.07 * 0.07);
}

TEST(FlexibleTrackFile, KeysAreChangedByTheirPaths) {
  const FlexibleTrack plain = flexible(kFlexible),
                      changed = flexible(kFlexible, {"rail.mass_kg_per_m=54", "seats.pad_damping_N_s_per_m=1e3",
                                                     "varied.1.pad_factor=3", "scale_stiffness=0.5", "scale_mass=2",
                                                     "scale_damping=10", "name=other"});
  EXPECT_EQ(changed.name, "other");
  EXPECT_EQ(changed.rail.mass, 108.0);
  EXPECT_EQ(changed.rail.bending_stiffness, plain.rail.bending_stiffness);
  EXPECT_EQ(changed.seats[0].pad_damping, 1e4);
  EXPECT_EQ(changed.seats[0].sleeper_mass, 300.0);
  EXPECT_EQ(changed.seats[3].pad_stiffness, 0.5 * 3 * 80e6);
  EXPECT_EQ(changed.lateral->bed_stiffness, 0.5 * 35e6);
  EXPECT_EQ(changed.lateral->bed_damping, 10 * 175e3);
}

const std::string kRailSideways =
    "lateral_bending_stiffness_N_m2 = 1.1e6\nlateral_shear_stiffness_N = 240e6\ntorsional_stiffness_N_m2 = 1.7e5\n"
    "polar_inertia_kg_m = 0.3\nheight_mm = 172\ncentroid_height_mm = 80\nshear_centre_height_mm = 40\n";
const std::string kSeatsSideways =
    "lateral_pad_stiffness_N_per_m = 20e6\nroll_stiffness_N_m_per_rad = 1e5\nroll_damping_N_m_s_per_rad = 100\n"
    "lateral_bed_stiffness_N_per_m = 15e6\nlateral_bed_damping_N_s_per_m = 60e3\n";

std::string bending_sideways(const std::string& rail = kRailSideways, const std::string& seats = kSeatsSideways) {
  return samples::with(samples::with(kFlexible, "distance_m = 1.5\n", "distance_m = 1.5\n" + rail), "count = 20\n",
                       "count = 20\n" + seats);
}

TEST(FlexibleTrackFile, ReadsRailsThatBendSideways) {
  EXPECT_FALSE(flexible(kFlexible).sideways);
  const FlexibleTrack track = flexible(bending_sideways(), {"scale_stiffness=2", "scale_mass=3", "scale_damping=4"});
  ASSERT_TRUE(track.sideways);
  EXPECT_EQ(track.sideways->bending_stiffness, 1.1e6);
  EXPECT_EQ(track.sideways->shear_stiffness, 240e6);
  EXPECT_EQ(track.sideways->rotary_inertia, 0.0);
  EXPECT_EQ(track.sideways->torsional_stiffness, 1.7e5);
  EXPECT_DOUBLE_EQ(track.sideways->polar_inertia, 0.9);
  EXPECT_DOUBLE_EQ(track.sideways->height, 0.172);
  EXPECT_DOUBLE_EQ(track.sideways->centroid, 0.08);
  EXPECT_DOUBLE_EQ(track.sideways->shear_centre, 0.04);
  EXPECT_EQ(track.seats[0].lateral_pad_stiffness, 2 * 20e6);
  EXPECT_EQ(track.seats[0].lateral_pad_damping, 0.0);
  EXPECT_EQ(track.seats[0].roll_stiffness, 2 * 1e5);
  EXPECT_EQ(track.seats[0].roll_damping, 4 * 100.0);
  EXPECT_EQ(track.seats[0].lateral_bed_damping, 4 * 60e3);
  // The third and fourth hang, and the pad of the fourth is twice as stiff.
  EXPECT_EQ(track.seats[2].lateral_bed_stiffness, 0.0);
  EXPECT_EQ(track.seats[3].roll_stiffness, 2 * 2 * 1e5);
  EXPECT_EQ(track.seats[3].lateral_pad_stiffness, 2 * 2 * 20e6);
}

TEST(FlexibleTrackFile, RefusesHalfOfWhatBendsSideways) {
  const auto error = [](const std::string& rail, const std::string& seats) {
    return samples::error_of([&] { flexible(bending_sideways(rail, seats)); });
  };
  EXPECT_THAT(error(samples::with(kRailSideways, "torsional_stiffness_N_m2 = 1.7e5\n", ""), kSeatsSideways),
              HasSubstr("rail.torsional_stiffness_N_m2 is missing"));
  EXPECT_THAT(error(kRailSideways, ""), HasSubstr("seats.lateral_pad_stiffness_N_per_m is missing"));
  EXPECT_THAT(error("", kSeatsSideways), AllOf(HasSubstr("seats.lateral_pad_stiffness_N_per_m"),
                                               HasSubstr("rail.lateral_bending_stiffness_N_m2")));
  EXPECT_THAT(error("height_mm = 172\n", ""), HasSubstr("rail.lateral_bending_stiffness_N_m2 is missing"));
  EXPECT_THAT(error(samples::with(kRailSideways, "= 80", "= 180"), kSeatsSideways),
              HasSubstr("rail.centroid_height_mm is larger than rail.height_mm"));
}

TEST(FlexibleTrackFile, RefusesWhatMakesNoSense) {
  EXPECT_THAT(refused("spacings_m = [0.6, 0.5]", "spacings_m = [0.6, -0.5]"),
              AllOf(HasSubstr("f.toml:16"), HasSubstr("seats.spacings_m")));
  EXPECT_THAT(refused("spacings_m = [0.6, 0.5]", "spacings_m = []"), HasSubstr("seats.spacings_m is empty"));
  EXPECT_THAT(refused("spacings_m = [0.6, 0.5]", "spacings_m = [0.6]\nspacing_m = 0.6"), HasSubstr("exclude"));
  EXPECT_THAT(refused("spacings_m = [0.6, 0.5]", ""), HasSubstr("seats.spacing_m is missing"));
  EXPECT_THAT(refused("count = 20", "count = 2"), HasSubstr("seats.count"));
  EXPECT_THAT(refused("count = 20", "count = 1000000"), HasSubstr("seats.count"));
  EXPECT_THAT(refused("absorbing_bays = 4", "absorbing_bays = 6"), HasSubstr("more than a quarter of 20 seats"));
  EXPECT_THAT(refused("last_seat = 4", "last_seat = 21"), HasSubstr("there are no seats 3 to 21 among 20"));
  EXPECT_THAT(refused("last_seat = 4", "last_seat = 2"), HasSubstr("there are no seats 3 to 2"));
  EXPECT_THAT(refused("first_seat = 3\nlast_seat = 4", "first_seat = 1\nlast_seat = 20"),
              HasSubstr("all sleepers hang"));
  EXPECT_THAT(refused("mass_kg_per_m = 60\n", ""), HasSubstr("rail.mass_kg_per_m is missing"));
  EXPECT_THAT(refused("mass_kg_per_m = 60\n", "mass_kg_per_m = 0\n"), HasSubstr("rail.mass_kg_per_m"));
  EXPECT_THAT(refused("shear_stiffness_N", "sheer_stiffness_N"), HasSubstr("did you mean 'rail.shear_stiffness_N'"));
  EXPECT_THAT(refused("foot_width_mm = 150\n", ""), HasSubstr("lateral.foot_width_mm is missing"));
  EXPECT_THAT(refused("kind = \"flexible\"", "kind = \"bending\""), HasSubstr("track.kind"));
}

TEST(FlexibleTrackFile, ReadsJoints) {
  const std::string joints = kFlexible +
                             "[[joints]]\nplace_m = 5.3\nhinge_stiffness_N_m_per_rad = 2e6\ndip_mm = 3\n[[joints]]\n"
                             "place_m = 0\nhinge_stiffness_N_m_per_rad = 0\ndip_length_mm = 800\n";
  const FlexibleTrack track = flexible(joints, {"joints.0.place_m=5.4"});
  ASSERT_EQ(track.joints.size(), 2u);
  EXPECT_EQ(track.joints[0].x, 5.4);
  EXPECT_EQ(track.joints[0].hinge_stiffness, 2e6);
  EXPECT_DOUBLE_EQ(track.joints[0].dip_depth, 3e-3);
  EXPECT_EQ(track.joints[0].dip_length, 1.0);
  EXPECT_DOUBLE_EQ(track.joints[1].dip_length, 0.8);
  const auto refused_with = [&](const std::string& part, const std::string& other) {
    return samples::error_of([&] { flexible(samples::with(joints, part, other)); });
  };
  EXPECT_THAT(refused_with("place_m = 5.3", "place_m = 25"),
              AllOf(HasSubstr("joints.place_m = 25"), HasSubstr("10.5 m from the first"), HasSubstr("seats.count")));
  EXPECT_THAT(refused_with("place_m = 5.3", "place_m = 0.5"),
              AllOf(HasSubstr("another joint lies 0.5 m"), HasSubstr("f.toml")));
  EXPECT_THAT(refused_with("= 2e6", "= -1"), HasSubstr("hinge_stiffness_N_m_per_rad"));
  EXPECT_THAT(refused_with("dip_mm = 3", "dip_mm = -3"), HasSubstr("dip_mm"));
  EXPECT_THAT(refused_with("hinge_stiffness_N_m_per_rad = 2e6\n", ""), HasSubstr("hinge_stiffness_N_m_per_rad"));
}

TEST(FlexibleTrackFile, KindsAreNotMixed) {
  EXPECT_THAT(refused("kind = \"flexible\"\n", ""), HasSubstr("rail belongs to tracks whose kind is \"flexible\""));
  EXPECT_THAT(refused("source = \"made up\"", "rails = [\"a\", \"b\"]"),
              HasSubstr("track.rails belongs to tracks whose kind is \"lumped\""));
  EXPECT_THAT(refused("[seats]", "[sets]"), HasSubstr("unknown key 'sets'"));
  EXPECT_THAT(samples::error_of([] { flexible("[track]\nkind = \"flexible\"\nname = \"n\"\n"); }),
              HasSubstr("[rail] is missing"));
  EXPECT_THAT(samples::error_of([] { parse_track_text("[track]\nname = \"n\"\n", "t.toml"); }),
              HasSubstr("there are no [[bodies]]"));
}

TEST(FlexibleTrackFile, SimulationsTakeIt) {
  const treadmark::testing::TemporaryFolder folder;
  folder.write("vehicle.toml", samples::kVehicle);
  folder.write("track.toml", kFlexible);
  const std::vector<std::string> changes{"track_model.rail.mass_kg_per_m=54", "simulation.from_midspan_mm=100"};
  const SimulationFile file = parse_simulation_text(samples::kSimulation, folder.path() / "s.toml", changes);
  EXPECT_FALSE(file.track);
  ASSERT_TRUE(file.flexible_track);
  EXPECT_EQ(file.flexible_track->rail.mass, 54.0);
  EXPECT_DOUBLE_EQ(file.settings.from_midspan, 0.1);
  EXPECT_THAT(samples::error_of([] { parse_track_text(kFlexible, "t.toml"); }),
              AllOf(HasSubstr("a lumped track is needed"), HasSubstr("treadmark track")));
}

TEST(ShippedTrack, ZhaiSidewaysIsZhaiFlexibleThatBendsSidewaysToo) {
  const std::string folder = std::string(TREADMARK_SOURCE_DIR) + "/examples/tracks/";
  const FlexibleTrack track = std::get<FlexibleTrack>(read_any_track_file(folder + "zhai-sideways.toml")),
                      plain = std::get<FlexibleTrack>(read_any_track_file(folder + "zhai-flexible.toml"));
  EXPECT_FALSE(plain.sideways);
  EXPECT_EQ(track.rail.bending_stiffness, plain.rail.bending_stiffness);
  EXPECT_EQ(track.seats[7].pad_damping, plain.seats[7].pad_damping);
  // Sideways a beam on a bed gives way at rest as the springs of [lateral] do.
  ASSERT_TRUE(track.sideways);
  const double bed = track.seats[0].lateral_pad_stiffness / 0.545,
               point = 2.0 * std::sqrt(2.0) * std::pow(track.sideways->bending_stiffness, 0.25) * std::pow(bed, 0.75);
  EXPECT_NEAR(point / track.lateral->pad_stiffness, 1.0, 1e-3);
  EXPECT_NEAR(track.seats[0].lateral_bed_stiffness / track.seats[0].lateral_pad_stiffness,
              track.lateral->bed_stiffness / track.lateral->pad_stiffness, 1e-3);
}

TEST(ShippedTrack, ZhaiFlexibleHasTheDataOfTheLumpedOne) {
  const std::string folder = std::string(TREADMARK_SOURCE_DIR) + "/examples/tracks/";
  const FlexibleTrack track = std::get<FlexibleTrack>(read_any_track_file(folder + "zhai-flexible.toml"));
  EXPECT_NEAR(track.rail.bending_stiffness / (2.059e11 * 3.217e-5), 1.0, 1e-4);
  const double area = track.rail.mass / 7850.0;
  EXPECT_NEAR(track.rail.shear_stiffness / (0.4 * 2.059e11 / 2.6 * area), 1.0, 1e-3);
  EXPECT_NEAR(track.rail.rotary_inertia / (7850.0 * 3.217e-5), 1.0, 1e-3);
  EXPECT_EQ(track.seats[7].pad_stiffness, 65e6);
  EXPECT_EQ(track.seats[7].sleeper_mass, 125.5);
  const TrackModel lumped = std::get<TrackModel>(read_any_track_file(folder + "zhai-equivalent.toml"));
  EXPECT_NEAR(lumped.bodies[0].inertia.x() / (lumped.bodies[0].mass * track.lateral->roll_inertia), 1.0, 1e-3);
}

}  // namespace
}  // namespace treadmark::io
