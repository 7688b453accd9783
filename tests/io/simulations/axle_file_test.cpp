// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"

namespace treadmark::io {
namespace {

using samples::error_of;
using samples::kVehicle;
using samples::kWithAxle;
using samples::with;

TEST(AxleFile, IsReadInSIUnits) {
  const VehicleModel vehicle = parse_vehicle_text(kWithAxle, "v.toml");
  const FlexibleAxle& axle = vehicle.wheelsets.at(0).axle.value();
  EXPECT_EQ(axle.name, "shaft");
  EXPECT_DOUBLE_EQ(axle.wheel_distance, 1.5);
  EXPECT_EQ(axle.wheel_polar_inertia, 50.0);
  EXPECT_EQ(axle.where.to_string(), "v.toml:38:1");
  EXPECT_THAT(axle.places, ::testing::ElementsAre(-1.0, -0.75, 0.75, 1.0));
  ASSERT_EQ(axle.bending.size(), 1u);
  const double omega = 2.0 * kPi * 80.0;
  EXPECT_EQ(axle.bending[0].mass, 300.0);
  EXPECT_DOUBLE_EQ(axle.bending[0].stiffness, 300.0 * omega * omega);
  EXPECT_DOUBLE_EQ(axle.bending[0].damping, 2.0 * 0.01 * 300.0 * omega);
  EXPECT_THAT(axle.bending[0].shape, ::testing::ElementsAre(1.0, 0.2, 0.2, 1.0));
  EXPECT_THAT(axle.bending[0].slope, ::testing::ElementsAre(-3.0, -2.0, 2.0, 3.0));
  ASSERT_EQ(axle.torsion.size(), 1u);
  EXPECT_EQ(axle.torsion[0].inertia, 102.0);
  EXPECT_EQ(axle.torsion[0].damping, 0.0);
  EXPECT_EQ(axle.torsion[0].wheel_rotation, (std::array<double, 2>{-1.0, 1.0}));
  EXPECT_FALSE(parse_vehicle_text(kVehicle, "v.toml").wheelsets.at(0).axle);
}

TEST(AxleFile, FrequenciesFollowScaledMasses) {
  const FlexibleAxle plain = *parse_vehicle_text(kWithAxle, "v.toml").wheelsets.at(0).axle;
  const std::vector<CaseOverride> changes{parse_override("scale_mass=4"), parse_override("scale_stiffness=3"),
                                          parse_override("scale_damping=0.5"),
                                          parse_override("axles.shaft.torsion.0.damping_ratio=0.02")};
  const FlexibleAxle scaled = *parse_vehicle_text(kWithAxle, "v.toml", changes).wheelsets.at(0).axle;
  const auto frequency = [](double stiffness, double mass) { return std::sqrt(stiffness / mass); };
  const BendingMode &b = plain.bending[0], &c = scaled.bending[0];
  EXPECT_DOUBLE_EQ(frequency(c.stiffness, c.mass), 0.5 * frequency(b.stiffness, b.mass));
  EXPECT_DOUBLE_EQ(c.damping, 0.5 * b.damping);
  EXPECT_EQ(c.slope, b.slope);
  EXPECT_DOUBLE_EQ(scaled.torsion[0].inertia, 4.0 * plain.torsion[0].inertia);
  EXPECT_DOUBLE_EQ(scaled.torsion[0].stiffness, plain.torsion[0].stiffness);
  EXPECT_DOUBLE_EQ(scaled.torsion[0].damping, 0.5 * 2.0 * 0.02 * 102.0 * 2.0 * kPi * 60.0);
  EXPECT_DOUBLE_EQ(scaled.wheel_polar_inertia, 200.0);
}

struct WrongAxle {
  std::string part, other, expected;
};
class AxleError : public ::testing::TestWithParam<WrongAxle> {};
TEST_P(AxleError, TellsPlaceAndReason) {
  const WrongAxle& wrong = GetParam();
  EXPECT_THAT(error_of([&] { parse_vehicle_text(with(kWithAxle, wrong.part, wrong.other), "v.toml"); }),
              ::testing::HasSubstr(wrong.expected));
}

INSTANTIATE_TEST_SUITE_P(
    All, AxleError,
    ::testing::Values(
        WrongAxle{"axle = \"shaft\"", "axle = \"shift\"",
                  "v.toml:36:8: wheelsets.axle: the axle 'shift' is not known (did you mean 'shaft'?)"},
        WrongAxle{"axle = \"shaft\"", "axle = 3", "v.toml:36:8: wheelsets.axle must be text"},
        WrongAxle{"axle = \"shaft\"", "", "v.toml:38:1: no wheelset has the axle 'shaft'"},
        WrongAxle{"name = \"shaft\"", "name = \"1\"", "axles.name = '1' is no name of a part"},
        WrongAxle{"[[axles.bending]]",
                  "[[axles]]\nname = \"shaft\"\nwheel_distance_mm = 1500\n"
                  "wheel_polar_inertia_kg_m2 = 1\nplaces_mm = [-800, 800]\n[[axles.bending]]",
                  "axle 'shaft' neither bends nor twists"},
        WrongAxle{"wheel_distance_mm = 1500", "wheel_distance_mm = -1500",
                  "v.toml:40:21: axles.shaft.wheel_distance_mm = -1500 must be greater than 0"},
        WrongAxle{"wheel_distance_mm = 1500", "wheel_distance_mm = 2500",
                  "v.toml:38:1: axle 'shaft': the wheels stand at -1.25 and 1.25 m"},
        WrongAxle{"wheel_polar_inertia_kg_m2 = 50\n", "", "axles.shaft.wheel_polar_inertia_kg_m2 is missing"},
        WrongAxle{
            "wheel_polar_inertia_kg_m2 = 50", "wheel_polar_inertia_kg_m2 = 80",
            "v.toml:44:1: bending mode 1 of axle 'shaft': its modal mass is 300, but turning wheels alone make 320"},
        WrongAxle{
            "wheel_polar_inertia_kg_m2 = 50", "wheel_polar_inertia_kg_m2 = 52",
            "v.toml:51:1: torsion mode 1 of axle 'shaft': its modal mass is 102, but turning wheels alone make 104"},
        WrongAxle{"places_mm = [-1000, -750, 750, 1000]\n", "", "axles.shaft.places_mm is missing"},
        WrongAxle{"places_mm = [-1000, -750, 750, 1000]", "places_mm = [-1000, -750, 750, 750]",
                  "at least two places along the axle, increasing"},
        WrongAxle{"shape = [1, 0.2, 0.2, 1]", "shape = [1, 0.2, 0.2]",
                  "v.toml:48:9: axles.shaft.bending.shape has 3 values for 4 places"},
        WrongAxle{"slope_per_m = [-3, -2, 2, 3]", "slope_per_m = [-3, -2, nan, 3]", "must be finite"},
        WrongAxle{"slope_per_m = [-3, -2, 2, 3]\n", "", "axles.shaft.bending.slope_per_m is missing"},
        WrongAxle{"shape = [1, 0.2, 0.2, 1]\nslope_per_m = [-3, -2, 2, 3]",
                  "shape = [1, 1, 1, 1]\nslope_per_m = [0, 0, 0, 0]", "bending mode 1 of axle 'shaft' does not bend"},
        WrongAxle{"frequency_Hz = 80", "frequency_Hz = 0",
                  "v.toml:45:16: axles.shaft.bending.frequency_Hz = 0 must be greater than 0"},
        WrongAxle{"damping_ratio = 0.01", "damping_ratio = 1.5", "must be at most 1"},
        WrongAxle{"modal_mass_kg", "modal_mass", "did you mean 'axles.shaft.bending.modal_mass_kg'?"},
        WrongAxle{"wheel_rotation = [-1, 1]", "wheel_rotation = [-1]",
                  "axles.shaft.torsion.wheel_rotation has 1 values for 2 wheels"},
        WrongAxle{"wheel_rotation = [-1, 1]", "wheel_rotation = [0, 0]",
                  "torsion mode 1 of axle 'shaft' does not turn the wheels"}));

}  // namespace
}  // namespace treadmark::io
