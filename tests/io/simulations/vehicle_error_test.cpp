// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"

namespace treadmark::io {
namespace {

using samples::error_of;
using samples::kTrack;
using samples::kVehicle;
using samples::with;

/// A change of the sample file and what is then said of it.
struct Wrong {
  std::string part, other, expected;
};
class VehicleError : public ::testing::TestWithParam<Wrong> {};
TEST_P(VehicleError, TellsPlaceAndReason) {
  const Wrong& wrong = GetParam();
  EXPECT_THAT(error_of([&] { parse_vehicle_text(with(kVehicle, wrong.part, wrong.other), "v.toml"); }),
              ::testing::HasSubstr(wrong.expected));
}

INSTANTIATE_TEST_SUITE_P(
    Tables, VehicleError,
    ::testing::Values(
        Wrong{"[vehicle]", "[vehicles]", "v.toml:1:2: unknown key 'vehicles' (did you mean 'vehicle'?)"},
        Wrong{"[vehicle]\nname = \"small\"", "", "v.toml:1:1: [vehicle] is missing"},
        Wrong{"name = \"small\"", "", "v.toml:1:1: vehicle.name is missing"},
        Wrong{"name = \"small\"", "name = 3", "v.toml:2:8: vehicle.name must be text, found an integer"},
        Wrong{"name = \"small\"", "name = \"a\"\nscale_mass = 0", "vehicle.scale_mass = 0 must be greater than 0"},
        Wrong{"[[bodies]]", "[[bodys]]", "unknown key 'bodys' (did you mean 'bodies'?)"},
        Wrong{"[[wheelsets]]\nbody = \"axle\"\nnominal_radius_mm = 460\n", "", "there are no [[wheelsets]]"},
        Wrong{"[[wheelsets]]", "[wheelsets]", "wheelsets must be a list of tables, [[wheelsets]], found a table"},
        Wrong{"[vehicle]", "[vehicle", "v.toml:1:9: not valid TOML"}));

INSTANTIATE_TEST_SUITE_P(
    Bodies, VehicleError,
    ::testing::Values(
        Wrong{"mass_kg = 9000", "mass_kg = 0", "v.toml:6:11: bodies.mass.mass_kg = 0 must be greater than 0"},
        Wrong{"mass_kg = 9000", "mass_kg = -3", "must be greater than 0"},
        Wrong{"mass_kg = 9000\n", "", "v.toml:4:1: bodies.mass.mass_kg is missing"},
        Wrong{"mass_kg = 9000", "mas_kg = 9000",
              "v.toml:6:1: unknown key 'bodies.mas_kg' (did you mean 'bodies.mass_kg'?)"},
        Wrong{"name = \"mass\"\n", "", "bodies.name is missing"},
        Wrong{"name = \"mass\"", "name = \"ma ss\"", "'ma ss' is no name of a part"},
        Wrong{"name = \"mass\"", "name = \"axle\"", "v.toml:10:1: there are two bodies named 'axle'"},
        Wrong{"name = \"mass\"", "name = \"ground\"", "v.toml:4:1: there are two bodies named 'ground'"},
        Wrong{"position_m = [0, 0, -1]", "position_m = [0, 0]",
              "v.toml:7:14: bodies.mass.position_m has 2 numbers, it needs 3"},
        Wrong{"position_m = [0, 0, -1]\n", "", "bodies.mass.position_m is missing"},
        Wrong{"position_m = [0, 0, -1]", "position_m = [0, 0, -1]\npositions_m = [[0, 0, -1]]",
              "position_m and bodies.mass.positions_m exclude each other"},
        Wrong{"position_m = [0, 0, -1]", "positions_m = [0, 0, -1]", "must be a list of points"},
        Wrong{"position_m = [0, 0, -1]", "position_m = [0, 0, inf]", "must be finite"},
        Wrong{"free = [\"z\"]", "free = [\"z\", \"pich\"]",
              "v.toml:8:14: the direction in bodies.mass.free 'pich' is not known (did you mean 'pitch'?)"},
        Wrong{"free = [\"z\"]", "free = [\"z\", \"z\"]", "names 'z' twice"},
        Wrong{"free = [\"z\"]", "free = []", "bodies.mass.free is empty"},
        Wrong{"free = [\"z\"]", "free = \"z\"", "must be a list of texts, found text"},
        Wrong{"free = [\"z\"]\n", "", "bodies.mass.free is missing"},
        Wrong{"free = [\"z\"]", "free = [\"z\", \"roll\"]",
              "v.toml:4:1: bodies.mass: the moment of inertia about x is missing, but the body can roll"},
        Wrong{"inertia_kg_m2 = [1100, 110, 1100]", "inertia_kg_m2 = [1100, 0, 1100]",
              "v.toml:13:17: bodies.axle: the moment of inertia about y must be positive, as the body can pitch"},
        Wrong{"inertia_kg_m2 = [1100, 110, 1100]", "inertia_kg_m2 = [1100, -1, 1100]", "must be at least 0"}));

INSTANTIATE_TEST_SUITE_P(
    Springs, VehicleError,
    ::testing::Values(
        Wrong{"between = [\"axle\", \"mass\"]", "between = [\"axel\", \"mass\"]",
              "v.toml:19:12: springs.primary.between: the body 'axel' is not known (did you mean 'axle'?)"},
        Wrong{"between = [\"axle\", \"mass\"]", "between = [\"axle\", \"qqqqq\"]", "there are: mass, axle, ground"},
        Wrong{"between = [\"axle\", \"mass\"]", "between = [\"axle\"]",
              "springs.primary.between has 1 names, it needs 2"},
        Wrong{"between = [\"axle\", \"mass\"]", "between = [\"axle\", \"axle\"]", "connects 'axle' with itself"},
        Wrong{"between = [\"axle\", \"mass\"]\n", "", "springs.primary.between is missing"},
        Wrong{"at_m = [[0, -1, -0.46], [0, 1, -0.46]]\n", "", "springs.primary.at_m is missing"},
        Wrong{"at_m = [[0, -1, -0.46], [0, 1, -0.46]]", "at_m = [0, -1, -0.46]",
              "v.toml:20:8: springs.primary.at_m must be a list of points"},
        Wrong{"at_m = [[0, -1, -0.46], [0, 1, -0.46]]", "at_m = [[0, -1, -0.46]]\nplaces = []",
              "v.toml:21:10: springs.primary.between and springs.primary.places exclude each other"},
        Wrong{"between = [\"axle\", \"mass\"]\nat_m = [[0, -1, -0.46], [0, 1, -0.46]]", "places = []",
              "springs.primary.places is empty"},
        Wrong{"stiffness_N_per_m = [30e6, 4e6, 1.2e6]", "stiffness_N_per_m = [30e6, 4e6, -1]",
              "springs.primary.stiffness_N_per_m = -1 must be at least 0"},
        Wrong{"stiffness_N_per_m", "stifness_N_per_m", "did you mean 'springs.stiffness_N_per_m'?"},
        Wrong{"damper_stiffness_N_per_m = [0, 0, 1e6]", "damper_stiffness_N_per_m = [1e6, 0, 1e6]",
              "v.toml:23:28: springs.primary: a spring in series with the damper in x needs that damper"},
        Wrong{"stiffness_N_per_m = [30e6, 4e6, 1.2e6]\ndamping_N_s_per_m = [0, 0, 4e3]\ndamper_stiffness_N_per_m = [0, "
              "0, 1e6]",
              "", "springs.primary has neither stiffness nor damping"},
        Wrong{"[[bump_stops]]\nname = \"stop\"",
              "[[springs]]\nname = \"primary2\"\nbetween = [\"axle\", \"mass\"]\nat_m = [[0, 0, 0]]\nstiffness_N_per_m "
              "= [1, 1, 1]\n[[bump_stops]]\nname = \"stop\"",
              "there are two springs named 'primary2'"}));

INSTANTIATE_TEST_SUITE_P(
    BumpStops, VehicleError,
    ::testing::Values(Wrong{"displacement_mm = [25, 30]", "displacement_mm = [30, 30]",
                            "v.toml:30:19: bump_stops.stop.displacement_mm must increase"},
                      Wrong{"displacement_mm = [25, 30]", "displacement_mm = [-1, 30]",
                            "v.toml:30:19: bump_stops.stop.displacement_mm begins below 0"},
                      Wrong{"displacement_mm = [25, 30]", "odd = false\ndisplacement_mm = [-5, 30]",
                            "must have force 0 at displacement 0"},
                      Wrong{"displacement_mm = [25, 30]", "displacement_mm = [25]", "needs at least 2 values"},
                      Wrong{"force_N = [0, 600]", "force_N = [0, 600, 700]",
                            "bump_stops.stop.force_N has 3 values for 2 displacements"},
                      Wrong{"force_N = [0, 600]", "force_N = [10, 600]", "force_N must start from 0"},
                      Wrong{"direction = \"y\"", "direction = \"yaw\"", "is not one of \"x\", \"y\", \"z\""}));

const std::string kPlace = "between = [\"axle\", \"mass\"]\nat_m = [[0, -1, -0.46], [0, 1, -0.46]]\n";
Wrong added(const std::string& part, std::string expected) {
  return {"[[bump_stops]]", part + "[[bump_stops]]", std::move(expected)};
}
Wrong damper(const std::string& keys, std::string expected) {
  return added("[[damper_curves]]\nname = \"d\"\n" + kPlace + "direction = \"z\"\n" + keys + '\n', std::move(expected));
}
Wrong friction(const std::string& keys, std::string expected) {
  return added("[[frictions]]\nname = \"f\"\n" + kPlace + "stiffness_N_per_m = 1e6\n" + keys + '\n',
               std::move(expected));
}

Wrong air_spring(const std::string& keys, std::string expected) {
  return added("[[air_springs]]\nname = \"a\"\n" + kPlace + "area_m2 = 0.2\nbellows_m3 = 0.02\n" + keys + '\n',
               std::move(expected));
}

INSTANTIATE_TEST_SUITE_P(
    Elements, VehicleError,
    ::testing::Values(
        air_spring("", "air_springs.a.load_N is missing"), air_spring("load_N = 0", "air_springs.a.load_N"),
        air_spring("load_N = 4e4\nreservoir_m3 = 0.01\nloss_coefficient = 1.5", "air_springs.a.orifice_mm is missing"),
        air_spring("load_N = 4e4\nreservoir_m3 = 0.01\norifice_mm = 20", "air_springs.a.loss_coefficient is missing"),
        air_spring("load_N = 4e4\nexponent = 0.9", "air_springs.a.exponent"),
        air_spring("load_N = 4e4\norifice_mm = 20", "air_springs.a.orifice_mm does nothing without reservoir_m3"),
        air_spring("load_N = 4e4\nloss_coefficient = 2", "loss_coefficient does nothing without reservoir_m3"),
        friction("coefficient = 0.3\nnormal_force_N = 1\nload_share = 0.5\ndirections = [\"z\"]",
                 "frictions.f.load_share does nothing without load_of"),
        damper("velocity_m_s = [0.1, 0.2]\nforce_N = [0, 1]", "damper_curves.d.velocity_m_s must start from 0"),
        damper("velocity_m_s = [0, 0.2]\nforce_N = [1, 2]", "damper_curves.d.force_N must start from 0"),
        damper("velocity_m_s = [0, 0.2, 0.3]\nforce_N = [0, 2, 1]", "damper_curves.d.force_N must not decrease"),
        damper("velocity_m_s = [0, 0.2, 0.3]\nforce_N = [0, 2, 2]\nseries_stiffness_N_per_m = 1e6",
               "must increase where there is a spring in series"),
        friction("coefficient = 0.3\ndirections = [\"z\"]", "frictions.f: nothing presses it"),
        friction("coefficient = 0.3\nnormal_force_N = 1\ndirections = [\"x\", \"y\", \"z\"]",
                 "neither one or two of x, y, z nor one rotation"),
        friction("coefficient = 0.3\nnormal_force_N = 1\ndirections = [\"yaw\"]", "frictions.f.arm_mm is missing"),
        friction("coefficient = 0.3\nnormal_force_N = 1\ndirections = [\"z\"]\narm_mm = 3", "belongs to rotations"),
        friction("coefficient = 0.3\ncoefficient_back = 0.2\nnormal_force_N = 1\ndirections = [\"y\", \"z\"]",
                 "belongs to friction in one direction"),
        friction("coefficient = 0.3\nload_of = [\"primry\"]\ndirections = [\"z\"]", "'primry' is not known"),
        friction("coefficient = 0.3\nload_of = [\"primary1\", \"primary2\", \"stop\"]\ndirections = [\"z\"]",
                 "frictions.f.load_of names 3 loads for 2 places")));

INSTANTIATE_TEST_SUITE_P(
    Wheelsets, VehicleError,
    ::testing::Values(Wrong{"body = \"axle\"", "body = \"axles\"",
                            "v.toml:34:8: wheelsets.body: the body 'axles' is not known (did you mean 'axle'?)"},
                      Wrong{"nominal_radius_mm = 460", "nominal_radius_mm = 0.46",
                            "must be at least 10 (the number is in mm: 460 is meant?)"},
                      Wrong{"nominal_radius_mm = 460",
                            "nominal_radius_mm = 460\n[[wheelsets]]\nbody = \"axle\"\nnominal_radius_mm = 460",
                            "'axle' is a wheelset twice"},
                      Wrong{"\"y\", \"z\", \"roll\"", "\"y\", \"roll\"",
                            "v.toml:34:8: the wheelset 'axle' cannot move in z"}));

const std::string kBogie =
    "[[bodies]]\nname = \"bogie\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nposition_m = [0, 0, -1]\n";

INSTANTIATE_TEST_SUITE_P(
    Held, VehicleError,
    ::testing::Values(
        Wrong{"[[springs]]", kBogie + "free = [\"z\"]\n[[springs]]",
              "v.toml:17:1: nothing holds 'bogie': no spring touches it"},
        // A chain of springs that ends in the air, and one that ends in a body that only dampers connect.
        Wrong{"[[bump_stops]]",
              kBogie + "free = [\"z\"]\n" +
                  "[[springs]]\nname = \"air\"\nbetween = [\"bogie\", \"ground\"]\nat_m = [[0, 0, "
                  "0]]\nstiffness_N_per_m = [1, 1, 1]\n[[bump_stops]]",
              "nothing holds 'bogie': no chain of springs connects it with the wheelsets"},
        Wrong{"stiffness_N_per_m = [30e6, 4e6, 1.2e6]\n", "",
              "v.toml:4:1: nothing holds 'mass': no chain of springs connects it with the wheelsets"},
        Wrong{"stiffness_N_per_m = [30e6, 4e6, 1.2e6]", "stiffness_N_per_m = [30e6, 4e6, 0]",
              "v.toml:4:1: nothing holds 'mass' in z"},
        // Springs in the middle of the axle cannot keep it from yawing.
        Wrong{"at_m = [[0, -1, -0.46], [0, 1, -0.46]]", "at_m = [[0, 0, -0.46]]",
              "v.toml:10:1: nothing holds 'axle' in yaw"},
        // Every direction has a spring, but pitch of the bogie and x together are a mechanism: its one point turns
        // about itself.
        Wrong{"[[bump_stops]]",
              kBogie + "free = [\"x\", \"z\", \"pitch\"]\n[[springs]]\nname = \"pin\"\nbetween = [\"axle\", "
                       "\"bogie\"]\nat_m = [[0.3, 0, -0.5]]\nstiffness_N_per_m = [1e6, 1e6, 1e6]\n[[bump_stops]]",
              "nothing holds 'bogie' against a movement together with others"}));

class TrackError : public ::testing::TestWithParam<Wrong> {};
TEST_P(TrackError, TellsPlaceAndReason) {
  const Wrong& wrong = GetParam();
  EXPECT_THAT(error_of([&] { parse_track_text(with(kTrack, wrong.part, wrong.other), "t.toml"); }),
              ::testing::HasSubstr(wrong.expected));
}

INSTANTIATE_TEST_SUITE_P(
    Tracks, TrackError,
    ::testing::Values(
        Wrong{"rails = [\"left\", \"right\"]\n", "", "t.toml:1:1: track.rails is missing"},
        Wrong{"rails = [\"left\", \"right\"]", "rails = [\"left\"]", "t.toml:3:9: track.rails must name two bodies"},
        Wrong{"rails = [\"left\", \"right\"]", "rails = [\"left\", \"left\"]", "track.rails must name two bodies"},
        Wrong{"rails = [\"left\", \"right\"]", "rails = [\"left\", \"rigth\"]",
              "the body 'rigth' is not known (did you mean 'right'?)"},
        Wrong{"stiffness_N_per_m = [0, 30e6, 160e6]", "stiffness_N_per_m = [0, 30e6, 0]",
              "t.toml:5:1: nothing holds 'left' in z"},
        Wrong{"stiffness_N_per_m = [0, 30e6, 160e6]", "stiffness_N_per_m = [0, 0, 0]",
              "no chain of springs connects it with the ground"},
        Wrong{", { between = [\"ground\", \"right\"], at_m = [[0, 0.75, 0.17]] }", "",
              "nothing holds 'right': no spring touches it"},
        Wrong{"[[bodies]]", "[[bump_stops]]\nname = \"a\"\n[[bodies]]", "t.toml:5:3: unknown key 'bump_stops'"}));

TEST(VehicleOverride, TellsWhatIsWrong) {
  const auto error = [](const std::string& assignment) {
    const std::vector<CaseOverride> changes{parse_override(assignment)};
    return error_of([&] { parse_vehicle_text(kVehicle, "v.toml", changes); });
  };
  EXPECT_THAT(error("bodies.axel.mass_kg=3"),
              ::testing::HasSubstr("bodies.axel.mass_kg: the name 'axel' is not known (did you mean 'axle'?)"));
  EXPECT_THAT(error("bodies.axle.mass=3"),
              ::testing::HasSubstr("unknown key 'bodies.mass' (did you mean 'bodies.mass_kg'?)"));
  EXPECT_THAT(error("bodies.axle.mass_kg=-3"),
              ::testing::HasSubstr("override 'bodies.axle.mass_kg=-3': bodies.axle.mass_kg = -3 must be greater"));
  EXPECT_THAT(error("wheelsets.1.body=a"),
              ::testing::HasSubstr("the list has 1 entries, number 1 (counted from 0) does not exist"));
  EXPECT_THAT(error("scale_mas=2"),
              ::testing::HasSubstr("unknown key 'vehicle.scale_mas' (did you mean 'vehicle.scale_mass'?)"));
  EXPECT_THAT(error("bodies.axle.name.first=2"), ::testing::HasSubstr("nothing named 'first' is in text"));
  EXPECT_THAT(error("bodies..mass_kg=2"), ::testing::HasSubstr("is no path of a key"));
}

TEST(VehicleFile, MissingFileIsTold) {
  EXPECT_THAT(error_of([] { read_vehicle_file("/nowhere/v.toml"); }),
              ::testing::HasSubstr("there is no folder /nowhere"));
}

}  // namespace
}  // namespace treadmark::io
