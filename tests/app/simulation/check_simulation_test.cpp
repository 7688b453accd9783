// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

TEST(CheckSimulation, SimulationsAndStudiesAreReadWithoutSolving) {
  const SampleSimulation input;
  const ProgramResult r =
      run_program({"check", input.path("simulation.toml"), input.path("study.toml"), input.path("case.inp")});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("simulation.toml: a simulation, no errors"));
  EXPECT_THAT(r.out, HasSubstr("study.toml: 4 runs, no errors"));
  EXPECT_THAT(r.out, HasSubstr("case.inp: 2 cases, no errors"));
  for (const auto& entry : std::filesystem::directory_iterator(input.folder()))
    EXPECT_NE(entry.path().extension(), ".h5");
}

TEST(CheckSimulation, OverridesAreChecked) {
  const SampleSimulation input;
  EXPECT_EQ(run_program({"check", input.path("simulation.toml"), "--set", "simulation.speed_m_s=30"}).status, 0);
  EXPECT_EQ(run_program({"check", input.path("simulation.toml"), "--set", "simulation.speed_m_s=fast"}).status, 2);
  EXPECT_EQ(run_program({"check", input.path("study.toml"), "--set", "vehicle.bodies.mass.mass_kg=-1"}).status, 2);
}

const std::string kLine =
    "[[layout.elements]]\nkind = \"transition\"\nlength_m = 60\n[[layout.elements]]\nkind = \"curve\"\nlength_m = 500\n"
    "radius_m = -600\ncant_mm = 100\n[irregularities]\n[[irregularities.spectra]]\nfunction = \"alignment\"\n"
    "form = \"two_poles\"\namplitude_m_rad = 2e-7\nomega_c_rad_m = 0.8246\nomega_r_rad_m = 0.0206\n\n[case]";

TEST(CheckSimulation, ALineIsUnderstood) {
  const SampleSimulation input;
  input.edit("simulation.toml", "[case]", kLine);
  const std::vector<std::string> set{"--set", "simulation.speed_m_s=30"};
  const ProgramResult check = run_program({"check", input.path("simulation.toml"), set[0], set[1]});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("layout: 560 m in 2 elements"));
  // 1500 * 30^2 / (9.81 * 600) - 100 mm.
  EXPECT_THAT(check.out,
              HasSubstr("layout: 60 to 560 m: radius 600 m to the left, cant 100 mm, gauge 1435 mm; at 30 m/s cant "
                        "deficiency 129.4 mm, lateral acceleration 0.843 m/s2"));
  EXPECT_THAT(check.out, HasSubstr("irregularities: alignment with a standard deviation of "));
  EXPECT_THAT(check.out, HasSubstr("a simulation, no errors"));
  EXPECT_THAT(check.err, HasSubstr("the vehicle starts where the line changes"));
  const ProgramResult study = run_program({"check", input.path("study.toml")});
  EXPECT_EQ(study.status, 0) << study.err;
  input.edit("simulation.toml", "length_m = 500", "length_m = 500\ngauge_mm = 1500");
  const ProgramResult wide = run_program({"check", input.path("simulation.toml")});
  EXPECT_EQ(wide.status, 2);
  EXPECT_THAT(wide.err, HasSubstr("mm from the 1435 mm of the rails"));
  EXPECT_THAT(wide.err, HasSubstr("simulation.toml:"));
}

TEST(CheckSimulation, TablesNeedRoundWheels) {
  const SampleSimulation input;
  input.use_slices();
  input.edit("simulation.toml", "shape.standard = \"S1002\"\nflats = [{ length_mm = 60, depth_mm = 0.9 }]",
             "shape.file = \"wheel.slcw\"");
  input.edit("simulation.toml", "[case]", "[simulation.other_wheel]\nshape.standard = \"S1002\"\n\n[case]");
  const std::vector<std::string> check{"check", input.path("simulation.toml"), "--set",
                                       "simulation.wheels.1.contact=table"};
  const ProgramResult good = run_program(check);
  EXPECT_EQ(good.status, 0) << good.err;
  input.edit("simulation.toml", "shape.standard = \"60E1\"",
             "shape.standard = \"60E1\"\nsquats = [{ length_mm = 30, width_mm = 20, depth_mm = 0.2 }]");
  EXPECT_EQ(run_program(check).status, 0) << "tables are of rails without defects";
  input.edit("simulation.toml", "[simulation.other_wheel]\nshape.standard = \"S1002\"",
             "[simulation.other_wheel]\nshape.file = \"wheel.slcw\"");
  const ProgramResult uneven = run_program(check);
  EXPECT_EQ(uneven.status, 2) << uneven.out;
  EXPECT_THAT(uneven.err, HasSubstr("must be round"));
}

TEST(CheckSimulation, BrokenShapeOfAStudyIsTold) {
  const SampleSimulation input;
  input.edit("simulation.toml", "shape.standard = \"60E1\"", "shape.file = \"rail.prr\"");
  EXPECT_EQ(run_program({"check", input.path("study.toml")}).status, 0);
  input.edit("rail.prr", "point.begin", "point.begin\n nonsense");
  const ProgramResult r = run_program({"check", input.path("study.toml")});
  EXPECT_EQ(r.status, 3);
  EXPECT_THAT(r.err, HasSubstr("rail.prr:"));
}

}  // namespace
}  // namespace treadmark::testing
