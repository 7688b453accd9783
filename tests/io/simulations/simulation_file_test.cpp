// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "samples.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using samples::kSimulation;
using samples::with;

constexpr double kDegree = std::numbers::pi / 180.0;

class SimulationText : public ::testing::Test {
 protected:
  SimulationText() {
    folder_.write("vehicle.toml", samples::kVehicle);
    folder_.write("track.toml", samples::kTrack);
  }
  SimulationFile parse(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return parse_simulation_text(text, folder_.path() / "s.toml", overrides);
  }
  std::string error(const std::string& part, const std::string& other,
                    const std::vector<std::string>& overrides = {}) const {
    return samples::error_of([&] { parse(with(kSimulation, part, other), overrides); });
  }
  std::string override_error(const std::string& assignment) const {
    return error("[simulation]", "[simulation]", {assignment});
  }

  treadmark::testing::TemporaryFolder folder_;
};

TEST_F(SimulationText, FillsEveryValueInSIUnits) {
  const SimulationFile file = parse(kSimulation);
  EXPECT_EQ(file.title, "A flat");
  EXPECT_EQ(file.sha256, sha256_hex(kSimulation));
  EXPECT_EQ(file.vehicle_file.path, folder_.path() / "vehicle.toml");
  EXPECT_EQ(file.vehicle_file.sha256, sha256_hex(samples::kVehicle));
  ASSERT_TRUE(file.track && file.track_file);
  EXPECT_EQ(file.track_file->sha256, sha256_hex(samples::kTrack));
  EXPECT_EQ(file.vehicle.name, "small");
  EXPECT_EQ(file.track->name, "springs");
  const SimulationSettings& s = file.settings;
  EXPECT_EQ(s.speed, 20.0);
  EXPECT_EQ(s.distance, 3.0);
  EXPECT_DOUBLE_EQ(s.duration, 0.15);
  EXPECT_EQ(s.gravity, 9.81);
  EXPECT_DOUBLE_EQ(s.tolerance, 1e-7);
  EXPECT_FALSE(s.max_step);
  EXPECT_DOUBLE_EQ(s.min_step, 1e-9);
  EXPECT_EQ(s.max_step_elements, 1.0);  // transient rolling
  EXPECT_EQ(s.spectral_radius, 0.8);
  EXPECT_EQ(s.checkpoint, 10.0);
  EXPECT_EQ(s.output_every, 0.0);
  EXPECT_DOUBLE_EQ(s.longest_step(0.5e-3), 0.5e-3 / 20.0);
  EXPECT_TRUE(file.fields.pitch.empty() && file.fields.position.empty());
  EXPECT_FALSE(file.other_wheel);
  EXPECT_EQ(s.rail_start, 0.0);
  EXPECT_FALSE(file.left_rail || file.right_rail || file.table_rail);
}

TEST_F(SimulationText, SlipIsThatOfTheSurfacesWhereTheTheoryTakesIt) {
  using R = ReferenceSurface;
  const auto reference = [&](const std::vector<std::string>& overrides) {
    return parse(kSimulation, overrides).contact.reference_surface;
  };
  const std::string steady = "case.regime=steady", model = "solver.tangential_model=";
  EXPECT_EQ(reference({}), R::plane_surface_slip);
  EXPECT_EQ(reference({model + "fastsim"}), R::plane_surface_slip);
  EXPECT_EQ(reference({model + "fastrip", steady}), R::plane);
  EXPECT_EQ(reference({model + "fastsim", "case.reference_ways=true"}), R::plane);
  EXPECT_EQ(reference({"discretisation.reference_search_mesh=true"}), R::plane);
  EXPECT_EQ(reference({"contact.reference_surface=plane"}), R::plane);
  EXPECT_EQ(reference({"contact.reference_surface=curved"}), R::curved);
}

TEST_F(SimulationText, ContactIsThatOfACaseFile) {
  const WheelRailCase c = parse(kSimulation).contact;
  EXPECT_EQ(c.regime, Regime::transient);
  EXPECT_DOUBLE_EQ(c.track.cant, std::atan(1.0 / 40.0));
  EXPECT_DOUBLE_EQ(c.discretisation.dx, 0.5e-3);
  ASSERT_EQ(c.wheel.defects.flats.size(), 1u);
  EXPECT_DOUBLE_EQ(c.wheel.defects.flats[0].length, 0.06);
  EXPECT_EQ(std::get<StandardProfile>(c.rail.geometry).name, "60E1");
  // What the simulation gives: the radius of the vehicle, rolling at its speed, no load yet.
  EXPECT_DOUBLE_EQ(c.wheelset.nominal_radius, 0.46);
  EXPECT_DOUBLE_EQ(c.state.velocity.x, 20.0);
  EXPECT_DOUBLE_EQ(c.state.velocity.pitch, -20.0 / 0.46);
  EXPECT_EQ(c.vertical_force, 0.0);
}

TEST_F(SimulationText, EverySettingIsRead) {
  const std::string settings =
      "duration_s = 0.5\ngravity_m_s2 = 10\ntolerance_um = 0.02\nmax_step_us = 30\nmin_step_us = 0.1\n"
      "max_step_elements = 1.5\nspectral_radius = 0.5\ncheckpoint_s = 60\noutput_every_mm = 2\n"
      "fields = { pitch_deg = [-10, 20], position_m = [0.5, 1] }\n";
  const SimulationFile file = parse(with(kSimulation, "distance_m = 3\n", settings));
  const SimulationSettings& s = file.settings;
  EXPECT_EQ(s.duration, 0.5);
  EXPECT_DOUBLE_EQ(s.distance, 10.0);
  EXPECT_EQ(s.gravity, 10.0);
  EXPECT_DOUBLE_EQ(s.tolerance, 0.02e-6);
  EXPECT_DOUBLE_EQ(s.max_step.value(), 30e-6);
  EXPECT_DOUBLE_EQ(s.min_step, 0.1e-6);
  EXPECT_EQ(s.max_step_elements, 1.5);
  EXPECT_EQ(s.spectral_radius, 0.5);
  EXPECT_EQ(s.checkpoint, 60.0);
  EXPECT_DOUBLE_EQ(s.output_every, 2e-3);
  EXPECT_DOUBLE_EQ(s.longest_step(0.5e-3), 30e-6);
  EXPECT_THAT(file.fields.pitch,
              ::testing::ElementsAre(::testing::DoubleEq(-10 * kDegree), ::testing::DoubleEq(20 * kDegree)));
  EXPECT_THAT(file.fields.position, ::testing::ElementsAre(0.5, 1.0));
}

TEST_F(SimulationText, EveryWheelHasAnEntry) {
  const SimulationFile file = parse(kSimulation);
  ASSERT_EQ(file.wheels.size(), 2u);
  EXPECT_EQ(file.wheels[0].side, Side::left);
  EXPECT_EQ(file.wheels[0].model, ContactModelInput::full);
  EXPECT_TRUE(file.wheels[0].defects);
  EXPECT_DOUBLE_EQ(file.wheels[0].pitch.value(), 30 * kDegree);
  EXPECT_EQ(file.wheels[1].side, Side::right);
  EXPECT_EQ(file.wheels[1].wheelset, 0);
  EXPECT_EQ(file.wheels[1].model, ContactModelInput::table);
  EXPECT_FALSE(file.wheels[1].defects);
  EXPECT_DOUBLE_EQ(file.wheels[1].pitch.value(), 30 * kDegree) << "both wheels turn with the axle";
}

TEST_F(SimulationText, WheelsThatAreNotNamedHaveOneContactAmongThem) {
  const SimulationFile file =
      parse(with(kSimulation, "distance_m = 3\n",
                 "distance_m = 3\ncontact = \"auto\"\nauto_force_error = 0.02\nauto_wear_error = 0.3\n"));
  EXPECT_EQ(file.wheels[0].model, ContactModelInput::full);
  EXPECT_EQ(file.wheels[1].model, ContactModelInput::automatic);
  EXPECT_FALSE(file.wheels[1].defects);
  EXPECT_EQ(file.settings.force_error, 0.02);
  EXPECT_EQ(file.settings.wear_error, 0.3);
}

TEST_F(SimulationText, TrackMayBeRigid) {
  const SimulationFile file = parse(with(kSimulation, "track = \"track.toml\"\n", ""));
  EXPECT_FALSE(file.track);
  EXPECT_FALSE(file.track_file);
}

TEST_F(SimulationText, OverridesOfEveryKind) {
  const std::vector<std::string> overrides{"simulation.wheels.0.contact=table",
                                           "simulation.speed_m_s=10",
                                           "simulation.duration_s=2",
                                           "vehicle.bodies.mass.mass_kg=30000",
                                           "track_model.springs.pad.stiffness_N_per_m=[0, 1e6, 2e6]",
                                           "track_model.scale_mass=1.5",
                                           "wheel.flats.0.depth_mm=1.2",
                                           "rail.shape.standard=60E1",
                                           "title=other"};
  const SimulationFile file = parse(kSimulation, overrides);
  EXPECT_EQ(file.title, "other");
  EXPECT_EQ(file.wheels[0].model, ContactModelInput::table);
  EXPECT_EQ(file.settings.speed, 10.0);
  EXPECT_EQ(file.settings.duration, 2.0);
  EXPECT_EQ(file.settings.distance, 20.0);
  EXPECT_EQ(file.vehicle.bodies[0].mass, 30000.0);
  EXPECT_EQ(file.track->springs[0].stiffness[2], 2e6);
  EXPECT_DOUBLE_EQ(file.track->bodies[0].mass, 120.0);
  EXPECT_DOUBLE_EQ(file.contact.wheel.defects.flats[0].depth, 1.2e-3);
  EXPECT_DOUBLE_EQ(file.contact.state.velocity.x, 10.0);
}

TEST_F(SimulationText, OtherWheelIsReadLikeAWheel) {
  const std::string measured =
      with(kSimulation, "[wheel]\nshape.standard = \"S1002\"\nflats = [{ length_mm = 60, depth_mm = 0.9 }]",
           "[wheel]\nshape.file = \"flat.slcw\"");
  EXPECT_THAT(
      samples::error_of([&] { parse(measured); }),
      ::testing::HasSubstr("s.toml:3:1: [wheel] is measured all around, but the right wheel of wheelset 1 is round"));
  const SimulationFile file =
      parse(measured + "[simulation.other_wheel]\nshape.file = \"round.prw\"\nshape.mirror_y = true\n");
  ASSERT_TRUE(file.other_wheel);
  const auto& geometry = std::get<GeometryFile>(file.other_wheel->geometry);
  EXPECT_EQ(geometry.file, folder_.path() / "round.prw");
  EXPECT_EQ(geometry.options.mirror_y, 1);
  EXPECT_EQ(std::get<GeometryFile>(file.contact.wheel.geometry).file, folder_.path() / "flat.slcw");
  EXPECT_THAT(samples::error_of([&] { parse(measured + "[simulation.other_wheel]\nshape.standard = 3\n"); }),
              ::testing::HasSubstr("s.toml:30:18: wheel.shape.standard must be text"));
  EXPECT_THAT(
      samples::error_of([&] {
        parse(measured +
              "[simulation.other_wheel]\nshape.standard = \"S1002\"\nflats = [{ length_mm = 60, depth_mm = 0.9 }]\n");
      }),
      ::testing::HasSubstr("it has no defects"));
}

TEST_F(SimulationText, EachSideMayHaveItsOwnRail) {
  const auto standard = [](const SurfaceSource& source) { return std::get<StandardProfile>(source.geometry).name; };
  const SimulationFile common = parse(kSimulation);
  EXPECT_EQ(&common.rail(Side::left), &common.contact.rail);
  const std::string left = "[simulation.left_rail]\nshape.standard = \"54E1\"\n";
  const std::string squat =
      "[simulation.right_rail]\nshape.standard = \"60E2\"\nsquats = [{ length_mm = 30, width_mm = 20, depth_mm = 0.1 "
      "}]\n";
  const SimulationFile one = parse(kSimulation + left);
  EXPECT_EQ(standard(one.rail(Side::left)), "54E1");
  EXPECT_EQ(standard(one.rail(Side::right)), "60E1");
  const std::string without = with(kSimulation, "[rail]\nshape.standard = \"60E1\"\n", "");
  const SimulationFile both = parse(without + left + squat + "[simulation.table_rail]\nshape.standard = \"60E1\"\n",
                                    {"rail.resolution_mm=0.4", "simulation.left_rail.shape.standard=60E2"});
  EXPECT_EQ(standard(both.rail(Side::left)), "60E2");
  EXPECT_EQ(both.rail(Side::right).defects.squats.size(), 1u);
  EXPECT_TRUE(both.rail(Side::left).defects.empty());
  EXPECT_DOUBLE_EQ(both.rail(Side::left).resolution, 4e-4);
  EXPECT_DOUBLE_EQ(both.rail(Side::right).resolution, 4e-4);
  ASSERT_TRUE(both.table_rail);
  EXPECT_EQ(standard(*both.table_rail), "60E1");

  const auto error_with = [&](const std::string& text, const std::vector<std::string>& overrides = {}) {
    return samples::error_of([&] { parse(text, overrides); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error_with(kSimulation + left + squat), HasSubstr("s.toml:22:2: [rail] is the rail of no wheel"));
  EXPECT_THAT(error_with(without + left + squat, {"rail.shape.standard=60E1"}),
              HasSubstr("[rail] is the rail of no wheel"));
  EXPECT_THAT(error_with(without + left), HasSubstr("the right rail has no shape (give [rail] or"));
  EXPECT_THAT(error_with(without), HasSubstr("rail.shape"));
  EXPECT_THAT(error_with(kSimulation + "[simulation.left_rail]\nshape.standard = 3\n"),
              HasSubstr("rail.shape.standard must be text"));
  EXPECT_THAT(error_with(with(kSimulation + squat, "right_rail", "table_rail")), HasSubstr("it has no defects"));
}

TEST_F(SimulationText, RailsByTheirPlaceAreRightHandOnes) {
  EXPECT_EQ(parse(with(kSimulation, "cant =", "rail_y_mm = 753.6\ncant =")).contact.track.rail_y0, 0.7536);
  EXPECT_THAT(error("cant =", "rail_y_mm = -753.6\ncant ="),
              ::testing::HasSubstr("s.toml:26:13: track.rail_y_mm of a simulation must be positive"));
}

TEST_F(SimulationText, CheckRails) {
  const std::string check =
      "[[simulation.check_rails]]\nside = \"right\"\nfrom_m = -1\nto_m = 2\nface_y_mm = 676.5\nstiffness_N_per_m = "
      "5e7\n"
      "flare_m = 0.5\nflare_mm = 30\n";
  const SimulationFile file = parse(kSimulation + check);
  ASSERT_EQ(file.check_rails.size(), 1u);
  const CheckRailInput& rail = file.check_rails[0];
  EXPECT_EQ(rail.side, Side::right);
  EXPECT_EQ(rail.from, -1.0);
  EXPECT_EQ(rail.to, 2.0);
  EXPECT_DOUBLE_EQ(rail.face_y, 0.6765);
  EXPECT_DOUBLE_EQ(rail.depth, 0.01);
  EXPECT_EQ(rail.stiffness, 5e7);
  EXPECT_EQ(rail.friction, 0.3);
  EXPECT_EQ(rail.flare_length, 0.5);
  EXPECT_DOUBLE_EQ(rail.flare, 0.03);
  const auto refused = [&](const std::string& from, const std::string& to) {
    return samples::error_of([&] { parse(kSimulation + with(check, from, to)); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused("to_m = 2", "to_m = -1"), HasSubstr("a check rail ends before it begins"));
  EXPECT_THAT(refused("flare_m = 0.5", "flare_m = 1.6"), HasSubstr("the flares at both ends are longer"));
  EXPECT_THAT(refused("676.5", "690"), HasSubstr("mm within the flange of a wheelset in the middle of the track"));
  EXPECT_THAT(refused("676.5\nstiffness_N_per_m = 5e7\nflare_m = 0.5\nflare_mm = 30", "682\nstiffness_N_per_m = 5e7"),
              HasSubstr("the check rail begins within the flange"));
  EXPECT_THAT(refused("stiffness_N_per_m = 5e7\n", ""), HasSubstr("stiffness_N_per_m is missing"));
  EXPECT_THAT(refused("5e7", "-5e7"), HasSubstr("stiffness_N_per_m"));
  EXPECT_THAT(refused("face_y_mm = 676.5", "face_y_mm = 0"), HasSubstr("face_y_mm"));
}

TEST_F(SimulationText, StretchesOfFullContact) {
  using ::testing::HasSubstr;
  const auto with_stretch = [&](const std::string& keys) {
    return with(kSimulation, "pitch_deg = 30\n", "pitch_deg = 30\n" + keys);
  };
  const WheelContactInput wheel = parse(with_stretch("full_from_m = -1\nfull_to_m = -0.9\n")).wheels[0];
  EXPECT_EQ(wheel.full_from, -1.0);
  EXPECT_EQ(wheel.full_to, -0.9);
  EXPECT_FALSE(parse(with_stretch("full_to_m = 2\n")).wheels[0].full_from);
  EXPECT_FALSE(parse(kSimulation).wheels[0].changes_over());
  const auto refused = [&](const std::string& keys) { return samples::error_of([&] { parse(with_stretch(keys)); }); };
  EXPECT_THAT(refused("full_from_m = 1\nfull_to_m = 0.5\n"),
              HasSubstr("s.toml:14:15: full_to_m must lie at least 0.1 m behind full_from_m"));
  EXPECT_THAT(refused("full_from_m = 1\nfull_to_m = 1.05\n"), HasSubstr("at least 0.1 m"));
  EXPECT_THAT(refused("full_from_m = \"here\"\n"), HasSubstr("must be a number"));
  EXPECT_THAT(samples::error_of(
                  [&] { parse(with(with_stretch("full_to_m = 1\n"), "contact = \"full\"", "contact = \"table\"")); }),
              HasSubstr("belong to a wheel with contact = \"full\""));
}

TEST_F(SimulationText, ErrorsOfSettings) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error("speed_m_s = 20", "speed_m_s = 0"),
              HasSubstr("s.toml:6:13: simulation.speed_m_s = 0: a simulation needs a speed"));
  EXPECT_THAT(error("speed_m_s = 20\n", ""),
              HasSubstr("s.toml:3:1: simulation.speed_m_s is missing (a simulation needs a speed)"));
  EXPECT_THAT(error("speed_m_s = 20", "speed_m_s = 20\nspeed_km_h = 72"), HasSubstr("exclude each other"));
  EXPECT_THAT(error("speed_m_s = 20", "speed_km_h = 0"),
              HasSubstr("simulation.speed_km_h = 0: a simulation needs a speed"));
  EXPECT_DOUBLE_EQ(parse(with(samples::kSimulation, "speed_m_s = 20", "speed_km_h = 72")).settings.speed, 20.0);
  EXPECT_THAT(error("speed_m_s = 20", "speed_m_s = -1"), HasSubstr("must be at least 0"));
  EXPECT_THAT(error("speed_m_s = 20", "speed_m_s = 1e6"), HasSubstr("must be at most 1000"));
  EXPECT_THAT(error("speed_m_s = 20\ndistance_m = 3", "speed_m_s = 1e-6\ndistance_m = 1e4"),
              HasSubstr("s.toml:3:1: the simulation has no end"));
  EXPECT_THAT(error("speed_m_s", "speed"),
              HasSubstr("s.toml:6:1: unknown key 'simulation.speed' (did you mean 'simulation.speed_m_s'?)"));
  EXPECT_THAT(error("distance_m = 3\n", ""), HasSubstr("simulation.distance_m is missing"));
  EXPECT_THAT(error("distance_m = 3", "distance_m = 3\nduration_s = 1"),
              HasSubstr("distance_m and simulation.duration_s exclude each other"));
  EXPECT_THAT(error("distance_m = 3", "distance_m = 3\nspectral_radius = 1.1"), HasSubstr("must be at most 1"));
  EXPECT_THAT(error("distance_m = 3", "distance_m = 3\nspectral_radius = 0.4"), HasSubstr("must be at least 0.5"));
  EXPECT_THAT(error("distance_m = 3", "distance_m = 3\ntolerance_um = 0"), HasSubstr("must be greater than 0"));
  EXPECT_THAT(error("distance_m = 3", "distance_m = 3\nfields.pitch_deg = [3, 2]"),
              HasSubstr("simulation.fields.pitch_deg must increase"));
  EXPECT_THAT(error("distance_m = 3", "distance_m = 3\nfields.pich_deg = [3]"),
              HasSubstr("did you mean 'simulation.fields.pitch_deg'?"));
  EXPECT_THAT(
      error("distance_m = 3", "distance_m = 3\nmax_step_elements = 2.5"),
      HasSubstr(
          "s.toml:8:21: simulation.max_step_elements = 2.5: steps of transient rolling must not exceed dt = 2 dx / V"));
  EXPECT_THAT(error("distance_m = 3", "distance_m = 3\nmin_step_us = 60"),
              HasSubstr("simulation.min_step_us = 60 exceeds the longest step of 25 us"));
  EXPECT_THAT(samples::error_of([&] { parse("rail.shape.standard = \"60E1\"\n"); }),
              HasSubstr("s.toml:1:1: [simulation] is missing"));
  EXPECT_THAT(samples::error_of([&] { parse("simulation = 3\n"); }), HasSubstr("s.toml:1:14: [simulation] is missing"));
  EXPECT_THAT(error("title = \"A flat\"", "title = 3"), HasSubstr("s.toml:1:9: title must be text"));
}

TEST_F(SimulationText, SteadyRollingMayTakeLongSteps) {
  const SimulationFile file = parse(with(with(kSimulation, "\"transient\"", "\"steady\""), "distance_m = 3",
                                         "distance_m = 3\nmax_step_elements = 5"));
  EXPECT_EQ(file.settings.max_step_elements, 5.0);
}

TEST_F(SimulationText, ErrorsOfFilesAndWheels) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error("vehicle.toml", "vehicles.toml"), HasSubstr("s.toml:4:11: simulation.vehicle: there is no file " +
                                                                (folder_.path() / "vehicles.toml").string()));
  EXPECT_THAT(error("vehicle = \"vehicle.toml\"\n", ""), HasSubstr("simulation.vehicle is missing"));
  EXPECT_THAT(error("\"track.toml\"", "\"vehicle.toml\""), HasSubstr("vehicle.toml:1:2: unknown key 'vehicle'"));
  EXPECT_THAT(
      error("wheelset = 1", "wheelset = 2"),
      HasSubstr(
          "s.toml:10:12: simulation.wheels.wheelset = 2, but the vehicle has 1 wheelset (wheelsets count from 1"));
  EXPECT_THAT(error("wheelset = 1", "wheelset = 0"), HasSubstr("must be at least 1"));
  EXPECT_THAT(error("side = \"left\"", "side = \"middle\""), HasSubstr("is not one of \"left\", \"right\""));
  EXPECT_THAT(error("contact = \"full\"", "contact = \"fll\""), HasSubstr("is not one of \"full\", \"table\""));
  EXPECT_THAT(error("contact = \"full\"\n", ""), HasSubstr("s.toml:9:1: simulation.wheels.contact is missing"));
  const std::string again = "[[simulation.wheels]]\nwheelset = 1\ncontact = \"full\"\n";
  EXPECT_THAT(error("[case]", again + "side = \"left\"\n[case]"),
              HasSubstr("s.toml:15:1: the left wheel of wheelset 1 is given twice"));
  EXPECT_THAT(error("[case]", again + "side = \"right\"\npitch_deg = 31\n[case]"),
              HasSubstr("s.toml:19:13: wheelset 1 has two different pitch angles"));
}

TEST_F(SimulationText, WhatASimulationFindsIsRefusedByName) {
  using ::testing::HasSubstr;
  const auto refused = [&](const std::string& line) { return error("[track]", line + "\n[track]"); };
  for (const std::string key :
       {"vertical_force_N", "longitudinal_force_N", "s_mm", "y_mm", "z_mm", "roll_deg", "yaw_rad", "pitch_deg",
        "velocity_m_s", "vy_m_s", "vz_m_s", "vroll_rad_s", "vyaw_rad_s", "vpitch_rad_s"})
    EXPECT_THAT(
        refused("[wheelset]\n" + key + " = 1"),
        HasSubstr("s.toml:26:1: wheelset." + key + " has no place in a simulation file: a simulation finds it"));
  EXPECT_THAT(refused("[wheelset]\ndeviation_x_mm = 1"), HasSubstr("wheelsets of a simulation are rigid"));
  EXPECT_THAT(refused("[[cases]]\nwheelset.y_mm = 3"),
              HasSubstr("s.toml:25:3: cases has no place in a simulation file"));
  EXPECT_THAT(refused("[patch]"), HasSubstr("patch has no place"));
  EXPECT_THAT(refused("[roller]"), HasSubstr("vehicles run on a track"));
  EXPECT_THAT(error("[track]", "[track]\nsprings.stiffness_z_N_per_mm = 3"), HasSubstr("track.springs has no place"));
  EXPECT_THAT(error("[track]", "[track]\nirregularity_z_mm = 3"), HasSubstr("track.irregularity_z_mm has no place"));
  EXPECT_THAT(error("[track]", "[track]\ncurvature_per_m = 1e-3"), HasSubstr("a simulation runs on straight track"));
  EXPECT_THAT(error("[case]", "[case]\nside = \"left\""),
              HasSubstr("case.side has no place in a simulation file: a simulation has both sides"));
  EXPECT_THAT(error("[case]", "[case]\nhistory = \"start\""), HasSubstr("case.history has no place"));
  EXPECT_THAT(error("[case]", "[case]\nsteps = 3"), HasSubstr("case.steps has no place"));
  EXPECT_THAT(error("\"transient\"", "\"none\""),
              HasSubstr("s.toml:16:10: case.regime of a simulation must be \"steady\" or \"transient\""));
  EXPECT_THAT(override_error("wheelset.velocity_m_s=3"),
              HasSubstr("override 'wheelset.velocity_m_s=3': wheelset.velocity_m_s has no place"));
  EXPECT_THAT(override_error("case.regime=shift"),
              HasSubstr("override 'case.regime=shift': case.regime of a simulation must be"));
}

TEST_F(SimulationText, ContactErrorsKeepTheirPlace) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error("dx_mm = 0.5", "dx_mm = 0"),
              HasSubstr("s.toml:29:9: discretisation.dx_mm = 0 must be greater than 0"));
  EXPECT_THAT(error("cant = \"1:40\"", "cnt = \"1:40\""),
              HasSubstr("s.toml:26:1: unknown key 'track.cnt' (did you mean 'track.cant'?)"));
  EXPECT_THAT(error("[rail]\nshape.standard = \"60E1\"\n", ""), HasSubstr("rail.shape is missing"));
  EXPECT_THAT(error("title = \"A flat\"", "wheelset = 3"),
              HasSubstr("s.toml:1:12: wheelset must be a table, found an integer"));
}

TEST_F(SimulationText, NominalRadiusIsTheVehicles) {
  EXPECT_DOUBLE_EQ(parse(kSimulation + "[wheelset]\nnominal_radius_mm = 460\nflange_back_distance_mm = 1365\n")
                       .contact.wheelset.flange_back_distance,
                   1.365);
  EXPECT_THAT(samples::error_of([&] { parse(kSimulation + "[wheelset]\nnominal_radius_mm = 490\n"); }),
              ::testing::HasSubstr(
                  "s.toml:31:21: wheelset.nominal_radius_mm = 490 differs from 460 mm of 'axle' in the vehicle file"));
  EXPECT_DOUBLE_EQ(parse(kSimulation, {"vehicle.wheelsets.0.nominal_radius_mm=490"}).contact.wheelset.nominal_radius,
                   0.49);
}

TEST_F(SimulationText, ErrorsOfOverrides) {
  using ::testing::HasSubstr;
  EXPECT_THAT(override_error("simulation.wheels.1.contact=table"), HasSubstr("the list has 1 entries, number 1"));
  EXPECT_THAT(override_error("simulation.sped_m_s=3"),
              HasSubstr("override 'simulation.sped_m_s=3': unknown key 'simulation.sped_m_s' (did you mean"));
  EXPECT_THAT(override_error("vehicle.bodies.mas.mass_kg=3"),
              HasSubstr("the name 'mas' is not known (did you mean 'mass'?)"));
  EXPECT_THAT(override_error("track_model.scale_stiffness=-1"),
              HasSubstr("track.scale_stiffness = -1 must be greater than 0"));
  EXPECT_THAT(override_error("wheel.flats.0.dept_mm=1"), HasSubstr("did you mean 'depth_mm'?"));
  EXPECT_THAT(error("track = \"track.toml\"\n", "", {"track_model.scale_mass=2"}),
              HasSubstr("there is no track to change"));
}

TEST_F(SimulationText, ShippedVehiclesRunOnShippedTracks) {
  const std::string examples = std::string(TREADMARK_SOURCE_DIR) + "/examples/";
  for (const char* vehicle : {"manchester", "manchester-flexible", "single-wheelset", "wheel-on-mass"})
    for (const char* track : {"zhai-equivalent", "gm-tt0088"}) {
      const SimulationFile file =
          parse(kSimulation, {"simulation.vehicle=" + examples + "vehicles/" + vehicle + ".toml",
                              "simulation.track=" + examples + "tracks/" + track + ".toml"});
      EXPECT_EQ(file.wheels.size(), 2 * file.vehicle.wheelsets.size());
      EXPECT_EQ(file.vehicle_file.path.stem(), vehicle);
      EXPECT_TRUE(file.track);
    }
}

TEST_F(SimulationText, KindsOfFilesAreTold) {
  const auto simulation = folder_.write("s.toml", kSimulation);
  const auto study = folder_.write("study.toml", kSimulation + "[study]\n");
  const auto input = folder_.write("a.inp", "[simulation");
  EXPECT_TRUE(is_simulation_file(simulation));
  EXPECT_FALSE(is_study_file(simulation));
  EXPECT_FALSE(is_simulation_file(study));
  EXPECT_TRUE(is_study_file(study));
  EXPECT_FALSE(is_simulation_file(folder_.path() / "track.toml"));
  EXPECT_FALSE(is_study_file(input));
  EXPECT_THROW(is_simulation_file(folder_.path() / "none.toml"), Error);
  EXPECT_EQ(read_simulation_file(simulation).title, "A flat");
}

}  // namespace
}  // namespace treadmark::io
