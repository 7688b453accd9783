// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>
#include <random>

#include "samples.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/tests/support/mutation.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;

const std::string kLine = R"(
[layout]
start_m = 5
cant_about = "low_rail"

[[layout.elements]]
kind = "straight"
length_m = 30

[[layout.elements]]
kind = "transition"
length_m = 40
shape = "bloss"

[[layout.elements]]
kind = "curve"
length_m = 80
radius_m = -300
cant_mm = 120
gauge_mm = 1440

[[layout.elements]]
kind = "transition"
length_m = 50
)";

const std::string kSpectra = R"(
[irregularities]
seed = 42
wind_up_m = 10
longest_wavelength_m = 100
alignment_factor = 0.5

[[irregularities.spectra]]
function = "longitudinal_level"
form = "two_poles"
amplitude_m_rad = 4e-7
omega_c_rad_m = 0.8246
omega_r_rad_m = 0.0206

[[irregularities.spectra]]
function = "alignment"
form = "table"
wavenumber_rad_m = [0.05, 4]
density_m3_rad = [1e-4, 1e-9]
sides = 2
)";

const std::string kFile = "\n[irregularities]\nfile = \"measured.csv\"\noffset_m = 2\n";
const std::string kMeasured = "distance_m,alignment_mm,gauge_mm\n0,0,1\n3,1,2\n7,-1,3\n9,0,2\n";

class SimulationLine : public ::testing::Test {
 protected:
  SimulationLine() {
    folder_.write("vehicle.toml", samples::kVehicle);
    folder_.write("track.toml", samples::kTrack);
    folder_.write("measured.csv", kMeasured);
  }
  SimulationFile parse(const std::string& more, const std::vector<std::string>& overrides = {}) const {
    return parse_simulation_text(samples::kSimulation + more, folder_.path() / "s.toml", overrides);
  }
  std::string error(const std::string& more, const std::vector<std::string>& overrides = {}) const {
    return samples::error_of([&] { parse(more, overrides); });
  }
  std::string line_error(const std::string& part, const std::string& other) const {
    return error(samples::with(kLine, part, other));
  }
  std::string spectra_error(const std::string& part, const std::string& other) const {
    return error(samples::with(kSpectra, part, other));
  }
  /// The place of a text in the whole file, as messages write it.
  static std::string at(const std::string& more, const std::string& part) {
    const std::string text = samples::kSimulation + more;
    const std::size_t place = text.find(part, samples::kSimulation.size());
    const auto before = text.substr(0, place);
    return "s.toml:" + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ":" +
           std::to_string(place - before.rfind('\n'));
  }

  treadmark::testing::TemporaryFolder folder_;
};

TEST_F(SimulationLine, AlsoAlone) {
  folder_.write("line.toml", kLine);
  const TrackLayout alone = read_track_layout(folder_.path() / "line.toml"), with_vehicle = *parse(kLine).layout;
  ASSERT_EQ(alone.elements.size(), with_vehicle.elements.size());
  for (std::size_t i = 0; i < alone.elements.size(); ++i) {
    EXPECT_EQ(alone.elements[i].length, with_vehicle.elements[i].length);
    EXPECT_EQ(alone.elements[i].curvature.to, with_vehicle.elements[i].curvature.to);
    EXPECT_EQ(alone.elements[i].cant.to, with_vehicle.elements[i].cant.to);
  }
  folder_.write("none.toml", "title = \"no line\"\n");
  EXPECT_THAT(samples::error_of([&] { read_track_layout(folder_.path() / "none.toml"); }),
              ::testing::HasSubstr("[layout] is missing"));
  folder_.write("wrong.toml", "[layout]\n[[layout.elements]]\nkind = \"curve\"\nlength_m = 10\n");
  EXPECT_THAT(samples::error_of([&] { read_track_layout(folder_.path() / "wrong.toml"); }),
              ::testing::HasSubstr("radius_m"));
}

TEST_F(SimulationLine, ElementsJoin) {
  const SimulationFile file = parse(kLine);
  ASSERT_TRUE(file.layout);
  EXPECT_EQ(file.start, 5.0);
  EXPECT_EQ(file.layout->cant_axis, CantAxis::low_rail);
  EXPECT_EQ(file.layout->cant_base, 1.5);
  const auto& e = file.layout->elements;
  ASSERT_EQ(e.size(), 4u);
  EXPECT_EQ(file.layout->length(), 200.0);
  // A curve to the left: the right rail is the outer one, so that cant is negative.
  EXPECT_EQ(e[1].shape, TransitionShape::bloss);
  EXPECT_EQ(e[1].curvature.from, 0.0);
  EXPECT_DOUBLE_EQ(e[1].curvature.to, -1.0 / 300.0);
  EXPECT_DOUBLE_EQ(e[1].cant.to, -0.12);
  EXPECT_DOUBLE_EQ(e[1].gauge.from, 1.435);
  EXPECT_DOUBLE_EQ(e[1].gauge.to, 1.44);
  EXPECT_DOUBLE_EQ(e[2].cant.from, -0.12);
  EXPECT_EQ(e[3].shape, TransitionShape::linear);
  EXPECT_EQ(e[3].curvature.to, 0.0);
  EXPECT_EQ(e[3].cant.to, 0.0);
  EXPECT_DOUBLE_EQ(e[3].gauge.to, 1.435);
  EXPECT_FALSE(parse("").layout);
  EXPECT_FALSE(parse("").irregularities);
}

TEST_F(SimulationLine, KeysCanBeSet) {
  const SimulationFile file = parse(kLine + kSpectra, {"layout.elements.2.radius_m=500", "irregularities.seed=7",
                                                       "irregularities.spectra.0.amplitude_m_rad=1e-6"});
  EXPECT_DOUBLE_EQ(file.layout->elements[2].curvature.from, 1.0 / 500.0);
  EXPECT_DOUBLE_EQ(file.layout->elements[2].cant.from, 0.12);
  EXPECT_EQ(file.irregularities->spectral.seed, 7u);
  EXPECT_EQ(file.irregularities->spectral.spectra[0]->amplitude, 1e-6);
}

TEST_F(SimulationLine, SpectraAreRead) {
  const SimulationFile file = parse(kLine + kSpectra);
  ASSERT_TRUE(file.irregularities);
  const IrregularitySpec& spec = *file.irregularities;
  EXPECT_FALSE(spec.table);
  EXPECT_EQ(spec.spectral.seed, 42u);
  EXPECT_EQ(spec.spectral.shortest, 3.0);
  EXPECT_EQ(spec.spectral.longest, 100.0);
  EXPECT_EQ(spec.wind_up, 10.0);
  EXPECT_EQ(spec.begin, 5.0);  // the wheelset is at x = 0
  EXPECT_THAT(spec.factor, ::testing::ElementsAre(1.0, 1.0, 0.5, 1.0));
  ASSERT_TRUE(spec.spectral.spectra[0] && spec.spectral.spectra[2]);
  EXPECT_FALSE(spec.spectral.spectra[1] || spec.spectral.spectra[3]);
  EXPECT_EQ(spec.spectral.spectra[0]->omega_r, 0.0206);
  EXPECT_FALSE(spec.spectral.spectra[0]->two_sided);
  EXPECT_EQ(spec.spectral.spectra[2]->form, IrregularitySpectrum::Form::table);
  EXPECT_THAT(spec.spectral.spectra[2]->density, ::testing::ElementsAre(1e-4, 1e-9));
  EXPECT_TRUE(spec.spectral.spectra[2]->two_sided);
}

TEST_F(SimulationLine, MeasuredOnesAreRead) {
  const SimulationFile file = parse(kFile);
  ASSERT_TRUE(file.irregularities && file.irregularities->table && file.irregularity_file);
  EXPECT_EQ(file.irregularity_file->path, folder_.path() / "measured.csv");
  EXPECT_EQ(file.irregularity_file->sha256, sha256_hex(kMeasured));
  EXPECT_EQ(file.irregularities->offset, 2.0);
  EXPECT_EQ(file.irregularities->begin, 2.0);  // where the file begins, in front of the vehicle
  EXPECT_EQ(parse(kFile + "begin_m = 4\n").irregularities->begin, 4.0);
}

TEST_F(SimulationLine, LinesThatMakeNoSenseAreRefused) {
  EXPECT_THAT(line_error("kind = \"curve\"", "kind = \"curv\""), HasSubstr("layout.elements.kind = \"curv\""));
  EXPECT_THAT(line_error("radius_m", "radus_m"), HasSubstr("did you mean 'layout.elements.radius_m'?"));
  EXPECT_THAT(line_error("radius_m = -300\n", ""), HasSubstr("layout.elements.radius_m is missing"));
  EXPECT_THAT(line_error("-300", "5"),
              HasSubstr(at(kLine, "-300") + ": layout.elements.radius_m = 5: a radius of less"));
  EXPECT_THAT(line_error("-300", "0"), HasSubstr("a radius of less than 10 m"));
  EXPECT_THAT(line_error("-300", "nan"), HasSubstr("must be finite"));
  EXPECT_THAT(line_error("length_m = 80", "length_m = -80"), HasSubstr("must be greater than 0"));
  EXPECT_THAT(line_error("length_m = 30", "length_m = 30\ncant_mm = 20"), HasSubstr("the cant changes its sign"));
  EXPECT_THAT(line_error("[[layout.elements]]\nkind = \"transition\"\nlength_m = 40\nshape = \"bloss\"\n", ""),
              HasSubstr("the cant steps from 0 to -120 mm (put a transition between"));
  EXPECT_THAT(line_error("shape = \"bloss\"", "shape = \"bloss\"\ncant_mm = 20"),
              HasSubstr("layout.elements.cant_mm has no place in a transition"));
  EXPECT_THAT(line_error("length_m = 30", "length_m = 30\nradius_m = 20"), HasSubstr("has no place in a straight"));
  EXPECT_THAT(
      line_error("kind = \"straight\"", "kind = \"transition\""),
      HasSubstr(at(kLine, "[[layout.elements]]\nkind = \"transition\"") + ": two transitions follow each other"));
  EXPECT_THAT(line_error("cant_mm = 120", "cant_mm = 900"), HasSubstr("a cant of -900 mm"));
  EXPECT_THAT(line_error("start_m = 5", "start_m = 198"),
              HasSubstr("the line is 200 m long, the run ends at 201 m (shorten the run"));
  EXPECT_THAT(error("[layout]\n"), HasSubstr("the line has no elements"));
  EXPECT_THAT(error("[[layout]]\n"), HasSubstr("layout must be a table"));
  EXPECT_THAT(error(kLine, {"layout.elements.9.length_m=3"}), HasSubstr("number 9 (counted from 0) does not exist"));
}

TEST_F(SimulationLine, IrregularitiesThatMakeNoSenseAreRefused) {
  EXPECT_THAT(error("[irregularities]\n"), HasSubstr("neither measured irregularities nor spectra"));
  EXPECT_THAT(spectra_error("function = \"alignment\"", "function = \"longitudinal_level\""),
              HasSubstr("two spectra of the longitudinal_level"));
  EXPECT_THAT(spectra_error("function = \"alignment\"", "function = \"twist\""), HasSubstr("is not one of"));
  EXPECT_THAT(spectra_error("omega_c_rad_m = 0.8246\n", ""), HasSubstr("omega_c_rad_m is missing"));
  EXPECT_THAT(spectra_error("omega_r_rad_m = 0.0206", "omega_s_rad_m = 0.1"),
              HasSubstr("omega_s_rad_m has no place in a formula with two poles"));
  EXPECT_THAT(spectra_error("[0.05, 4]", "[0.05, 1]"), HasSubstr("are asked for"));
  EXPECT_THAT(spectra_error("[0.05, 4]", "[0.05]"), HasSubstr("1 wavenumbers and 2 densities"));
  EXPECT_THAT(spectra_error("longest_wavelength_m = 100", "longest_wavelength_m = 2"),
              HasSubstr("wavelengths of 3 to 2 m"));
  EXPECT_THAT(spectra_error("seed = 42", "seed = -1"), HasSubstr("irregularities.seed = -1"));
  EXPECT_THAT(spectra_error("sides = 2", "sides = 3"), HasSubstr("sides = 3"));
  EXPECT_THAT(spectra_error("seed = 42", "seed = 42\noffset_m = 1"), HasSubstr("irregularities.offset_m has no place"));
  EXPECT_THAT(error(kFile + "seed = 4\n"), HasSubstr("exclude each other"));
  EXPECT_THAT(error(samples::with(kFile, "measured.csv", "nothing.csv")),
              HasSubstr(at(kFile, "\"measured") + ": irregularities.file: there is no file"));
}

TEST_F(SimulationLine, AFileThatIsTooShortIsRefused) {
  EXPECT_THAT(error(kFile, {"irregularities.offset_m=-7"}),
              HasSubstr("the irregularities of measured.csv end at 2 m, the run at 3 m"));
  folder_.write("measured.csv", samples::with(kMeasured, "3,1,2", "3,1,x"));
  try {
    parse(kFile);
    FAIL() << "accepted";
  } catch (const Error& wrong) {
    EXPECT_EQ(wrong.kind(), ErrorKind::input_data);
    EXPECT_THAT(wrong.what(), HasSubstr("measured.csv:3:5: a number is expected, this is 'x'"));
  }
}

const std::string kDriving = R"(
[simulation.speed_profile]
time_s = [0.05, 0.1]
speed_m_s = [10, 12]

[[simulation.torques]]
wheelset = 1
time_s = [0, 1]
torque_N_m = [0, -500]
reaction = "ground"
)";

TEST_F(SimulationLine, SpeedsAndTorquesAreRead) {
  const SimulationFile file = parse(kDriving);
  EXPECT_EQ(file.settings.profile.time, (std::vector<double>{0.0, 0.05, 0.1}));
  EXPECT_EQ(file.settings.profile.speed, (std::vector<double>{file.settings.speed, 10.0, 12.0}));
  EXPECT_NEAR(travel_at(file.settings.profile, file.settings.duration).distance, file.settings.distance, 1e-12);
  ASSERT_EQ(file.torques.size(), 1u);
  EXPECT_EQ(file.torques[0].reaction, kGround);
  EXPECT_EQ(file.torques[0].torque.back(), -500.0);
  EXPECT_EQ(parse("").settings.profile.time.size(), 1u);
}

TEST_F(SimulationLine, SpeedsAndTorquesThatMakeNoSenseAreRefused) {
  const auto refused = [&](const std::string& good, const std::string& bad) {
    std::string text = kDriving;
    text.replace(text.find(good), good.size(), bad);
    try {
      parse(text);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused("[10, 12]", "[10]"), HasSubstr("simulation.speed_profile.time_s has 2 values"));
  EXPECT_THAT(refused("[10, 12]", "[10, 0]"), HasSubstr("reaches 0"));
  EXPECT_THAT(refused("[0.05, 0.1]", "[0.1, 0.05]"), HasSubstr("must increase"));
  EXPECT_THAT(refused("wheelset = 1", "wheelset = 7"), HasSubstr("the vehicle has 1 wheelset"));
  EXPECT_THAT(refused("\"ground\"", "\"mas\""), HasSubstr("did you mean 'mass'"));
  EXPECT_THAT(refused("torque_N_m", "torque_Nm"), HasSubstr("torque_N_m"));
}

const std::string kFromOutside = R"(
[[simulation.forces]]
body = "mass"
at_m = [0.5, 0, -2]
direction = "z"
time_s = [0, 1]
force_N = [0, 500]

[[simulation.forces]]
body = "axle"
direction = "yaw"
time_s = [0]
moment_N_m = [70]

[[simulation.rail_shifts]]
wheelset = 1
side = "left"
direction = "z"
time_s = [0, 1]
displacement_mm = [0, 5]

[[simulation.forces]]
side = "right"
direction = "y"
time_s = [0]
force_N = [40]
)";

TEST_F(SimulationLine, WhatActsFromOutsideIsRead) {
  const SimulationFile file = parse(kFromOutside);
  ASSERT_EQ(file.forces.size(), 3u);
  ASSERT_TRUE(file.forces[0].point);
  EXPECT_EQ(file.forces[2].body, "");
  EXPECT_EQ(file.forces[2].left, false);
  EXPECT_FALSE(file.forces[2].wheelset);
  EXPECT_EQ(*file.forces[0].point, Vec3(0.5, 0.0, -2.0));
  EXPECT_EQ(force_at(file.forces[0], 0.5), 250.0);
  EXPECT_FALSE(file.forces[1].point);
  EXPECT_EQ(file.forces[1].direction, Freedom::yaw);
  EXPECT_EQ(force_at(file.forces[1], 9.0), 70.0);
  ASSERT_EQ(file.rail_shifts.size(), 1u);
  EXPECT_EQ(file.rail_shifts[0].wheelset, 0);
  EXPECT_EQ(file.rail_shifts[0].left, true);
  EXPECT_NEAR(file.rail_shifts[0].displacement[1], 5e-3, 1e-18);
  const auto refused = [&](const std::string& good, const std::string& bad) {
    std::string text = kFromOutside;
    text.replace(text.find(good), good.size(), bad);
    try {
      parse(text);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused("\"mass\"", "\"mas\""), HasSubstr("did you mean 'mass'"));
  EXPECT_THAT(refused("force_N = [0, 500]", "moment_N_m = [0, 500]"), HasSubstr("force_N must be given"));
  EXPECT_THAT(refused("moment_N_m = [70]", ""), HasSubstr("moment_N_m must be given"));
  EXPECT_THAT(refused("force_N = [0, 500]", "force_N = [0]"), HasSubstr("has 2 values"));
  EXPECT_THAT(refused("wheelset = 1", "wheelset = 3"), HasSubstr("the vehicle has 1"));
  EXPECT_THAT(refused("\"left\"", "\"lft\""), HasSubstr("did you mean 'left'"));
  EXPECT_THAT(refused("side = \"right\"\n", ""), HasSubstr("acts on a body, or on rails"));
  EXPECT_THAT(refused("side = \"right\"", "side = \"right\"\nbody = \"mass\""),
              HasSubstr("acts on a body, or on rails"));
  EXPECT_THAT(refused("side = \"right\"", "side = \"right\"\nat_m = [0, 0, 0]"), HasSubstr("at their centres of mass"));
  EXPECT_THAT(refused("side = \"right\"", "side = \"right\"\nwheelset = 2"), HasSubstr("the vehicle has 1"));
  EXPECT_THAT(refused("time_s = [0, 1]\ndisplacement_mm = [0, 5]", "time_s = [0]\ndisplacement_mm = [0]"),
              HasSubstr("needs two times"));
  EXPECT_THAT(refused("[[simulation.rail_shifts]]",
                      "[[simulation.spring_motions]]\nspring = \"primary1\"\n"
                      "direction = \"z\"\ntime_s = [0, 1]\ndisplacement_mm = [0, 1]\n"
                      "[[simulation.rail_shifts]]"),
              HasSubstr("the spring on the ground 'primary1' is not known"));
}

TEST_F(SimulationLine, EndsOfSpringsMoveAlongTheirStiffness) {
  folder_.write("vehicle.toml",
                samples::with(samples::kVehicle, "[[bump_stops]]",
                              "[[springs]]\nname = \"actuator\"\nbetween = [\"ground\", \"mass\"]\n"
                              "at_m = [[0, 0, -1]]\nstiffness_N_per_m = [0, 0, 1e4]\n\n[[bump_stops]]"));
  const auto moved = [&](const std::string& direction) {
    return samples::error_of([&] {
      parse("\n[[simulation.spring_motions]]\nspring = \"actuator\"\ndirection = \"" + direction +
            "\"\ntime_s = [0, 1]\ndisplacement_mm = [0, 1]\n");
    });
  };
  EXPECT_EQ(moved("z"), "no error");
  EXPECT_THAT(moved("y"), HasSubstr("spring 'actuator' has neither stiffness nor damping along y"));
}

TEST_F(SimulationLine, TwistTestsMoveTheRailsBelowAllWheels) {
  const std::string kTwist = "\n[simulation.twist]\nvehicle_per_mille = 3\nwheelsets_per_bogie = 1\nperiod_s = 0.1\n";
  const SimulationFile file = parse(kTwist);
  ASSERT_TRUE(file.twist);
  EXPECT_DOUBLE_EQ(file.twist->vehicle, 3e-3);
  ASSERT_EQ(file.rail_shifts.size(), 2u);  // of one wheelset, which stands in the middle: nothing moves
  EXPECT_EQ(file.rail_shifts[0].displacement[1], 0.0);
  const auto refused = [&](const std::string& good, const std::string& bad) {
    std::string text = kTwist;
    text.replace(text.find(good), good.size(), bad);
    return samples::error_of([&] { parse(text); });
  };
  EXPECT_THAT(refused("wheelsets_per_bogie = 1\n", ""), HasSubstr("1 wheelsets are no bogies of 2"));
  EXPECT_THAT(refused("vehicle_per_mille = 3", "bogie_per_mille = 0"), HasSubstr("nothing is twisted"));
  EXPECT_THAT(refused("period_s = 0.1", "period_s = 1e4"), HasSubstr("the run ends after"));
  EXPECT_THAT(refused("period_s = 0.1\n", ""), HasSubstr("period"));
  EXPECT_THAT(refused("wheelsets_per_bogie = 1", "wheelsets_per_bogie = 0"), HasSubstr("wheelsets_per_bogie"));
}

TEST_F(SimulationLine, TheSchemaKnowsTheTables) {
  const auto schema = nlohmann::json::parse(simulation_file_schema());
  const auto& layout = schema.at("properties").at("layout").at("properties");
  EXPECT_EQ(layout.at("elements").at("items").at("required"), nlohmann::json({"kind", "length_m"}));
  EXPECT_EQ(layout.at("cant_base_mm").at("default"), 1500);
  EXPECT_TRUE(schema.at("properties").at("irregularities").at("properties").contains("cross_level_factor"));
  EXPECT_TRUE(nlohmann::json::parse(study_file_schema()).at("properties").contains("layout"));
}

TEST_F(SimulationLine, TheExampleOfTheDocumentationIsRead) {
  const std::string text = read_text(std::string(TREADMARK_SOURCE_DIR) + "/docs/layout.md"), start = "```toml\n";
  const std::size_t at = text.find(start) + start.size();
  const SimulationFile file = parse(text.substr(at, text.find("```", at) - at));
  ASSERT_TRUE(file.layout && file.irregularities);
  EXPECT_EQ(file.layout->elements.size(), 4u);
  EXPECT_EQ(file.irregularities->spectral.seed, 42u);
}

TEST_F(SimulationLine, AnyFileIsReadOrRefused) {
  std::mt19937 random(9);
  const std::string whole = samples::kSimulation + kLine + kSpectra;
  for (int i = 0; i < treadmark::testing::mutants(400); ++i) {
    const std::string text = i % 2 == 0 ? treadmark::testing::with_other_numbers(whole, random)
                                        : treadmark::testing::with_other_lines(whole, random);
    try {
      parse_simulation_text(text, folder_.path() / "s.toml");
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace treadmark::io
