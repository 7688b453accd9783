// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kPoints = R"(channels = ["ws1_*.Q_N", "ws1.sumY_N"]
axle_box_y_mm = 950

[[simulation.points]]
name = "floor"
body = "mass"
at_m = [1, 0.5, -1.2]

[[simulation.points]]
name = "frame-1"
body = "axle"
at_m = [0, 0, -0.46]
kind = "bogie_frame"

)";

const std::string kAssessment = R"(
[assessment]
vehicle = "freight"
from_m = 0.5
spectra = ["axle_box.*"]

[[assessment.sections]]
name = "first"
from_m = 0.5
to_m = 2.5

[[assessment.sections]]
name = "second"
from_m = 2
to_m = 3
kind = "curve"
)";

class HistoryRequests : public ::testing::Test {
 protected:
  HistoryRequests() {
    folder_.write("vehicle.toml", samples::kVehicle);
    folder_.write("track.toml", samples::kTrack);
  }
  std::string text() const {
    return samples::with(samples::kSimulation, "[[simulation.wheels]]", kPoints + "[[simulation.wheels]]") +
           kAssessment;
  }
  SimulationFile parse(const std::string& text, std::vector<std::string> overrides = {}) const {
    return parse_simulation_text(text, folder_.path() / "simulation.toml", overrides);
  }
  std::string error(const std::string& part, const std::string& other) const {
    return samples::error_of([&] { parse(samples::with(text(), part, other)); });
  }
  testing::TemporaryFolder folder_;
};

TEST_F(HistoryRequests, AreRead) {
  const SimulationFile file = parse(text());
  EXPECT_THAT(file.history.channels, ElementsAre("ws1_*.Q_N", "ws1.sumY_N"));
  EXPECT_EQ(file.history.channels_where.line, 9);
  EXPECT_DOUBLE_EQ(file.history.axle_box_y, 0.95);
  ASSERT_EQ(file.history.points.size(), 2u);
  EXPECT_EQ(file.history.points[0].kind, PointKind::car_body);
  EXPECT_LT((file.history.points[0].arm - Vec3(1.0, 0.5, -0.2)).norm(), 1e-15);
  EXPECT_EQ(file.history.points[1].kind, PointKind::bogie_frame);
  EXPECT_EQ(file.history.points[1].arm.norm(), 0.0);
  ASSERT_TRUE(file.assessment);
  EXPECT_EQ(file.assessment->vehicle, VehicleKind::freight);
  EXPECT_THAT(file.assessment->spectra, ElementsAre("axle_box.*"));
  ASSERT_EQ(file.assessment->sections.size(), 2u);
  EXPECT_EQ(file.assessment->sections[0].kind, SectionKind::straight);
  EXPECT_EQ(file.assessment->sections[1].kind, SectionKind::curve);
  EXPECT_EQ(file.assessment->sections[1].to, 3.0);
  EXPECT_EQ(parse(text(), {"assessment.sections.0.to_m=2"}).assessment->sections[0].to, 2.0);
  const SimulationFile plain = parse(samples::kSimulation);
  EXPECT_FALSE(plain.assessment);
  EXPECT_TRUE(plain.history.channels.empty());
  EXPECT_DOUBLE_EQ(plain.history.axle_box_y, 1.0);
}

TEST_F(HistoryRequests, BeginBehindTheWindUp) {
  const std::string rough =
      "\n[irregularities]\nbegin_m = 0.5\nwind_up_m = 1\n[[irregularities.spectra]]\nfunction = \"alignment\"\n"
      "form = \"two_poles\"\namplitude_m_rad = 4e-7\nomega_c_rad_m = 0.8\n";
  EXPECT_DOUBLE_EQ(parse(samples::kSimulation + rough + "[assessment]\n").assessment->from, 1.5);
  EXPECT_DOUBLE_EQ(parse(samples::kSimulation + rough + "[assessment]\nfrom_m = 0.25\n").assessment->from, 0.25);
  EXPECT_DOUBLE_EQ(parse(samples::kSimulation + "[assessment]\n").assessment->from, 0.0);
  EXPECT_THAT(
      samples::error_of([&] {
        parse(samples::kSimulation + samples::with(rough, "wind_up_m = 1\n", "wind_up_m = 10\n") + "[assessment]\n");
      }),
      HasSubstr("have grown to their size at 10.5 m only"));
}

TEST_F(HistoryRequests, BadOnesAreRefusedWhereTheyStand) {
  EXPECT_THAT(error("body = \"mass\"", "body = \"mas\""),
              AllOf(HasSubstr("simulation.toml:14:8"), HasSubstr("'mass'")));
  EXPECT_THAT(error("\"floor\"", "\"the floor\""), HasSubstr("'the floor' cannot be the name of a point"));
  EXPECT_THAT(error("\"frame-1\"", "\"floor\""), HasSubstr("two points have the name floor"));
  EXPECT_THAT(error("at_m = [1, 0.5, -1.2]\n", ""), HasSubstr("at_m"));
  EXPECT_THAT(error("\"bogie_frame\"", "\"bogie\""), HasSubstr("bogie_frame"));
  EXPECT_THAT(error("axle_box_y_mm = 950", "axle_box_y_mm = -950"), HasSubstr("axle_box_y_mm"));
  EXPECT_THAT(error("\"freight\"", "\"tram\""), HasSubstr("freight"));
  EXPECT_THAT(error("to_m = 3\n", "to_m = 3.1\n"), HasSubstr("assessment.sections.to_m = 3.1: the run ends at 3 m"));
  EXPECT_THAT(error("to_m = 2.5", "to_m = 0.5"), HasSubstr("a section from 0.5 to 0.5 m is none"));
  EXPECT_THAT(error("\"second\"", "\"first\""), HasSubstr("no name of its own"));
  EXPECT_THAT(error("from_m = 0.5\nspectra", "from_m = 4\nspectra"), HasSubstr("assessment.from_m = 4"));
  EXPECT_THAT(error("spectra = ", "spectrum = "), HasSubstr("spectra"));
}

TEST_F(HistoryRequests, LimitsAreOfAFile) {
  const auto with_file = [&](const std::string& name) {
    return samples::with(text(), "vehicle = \"freight\"\n", "vehicle = \"freight\"\nlimits = \"" + name + "\"\n");
  };
  EXPECT_FALSE(parse(text()).assessment->limits);
  folder_.write("limits.toml", "edition = \"made up\"\n[[limits]]\nquantity = \"Q\"\nvalue = 1\n");
  const SimulationFile file = parse(with_file("limits.toml"));
  ASSERT_TRUE(file.assessment->limits);
  EXPECT_EQ(file.assessment->limits->edition, "made up");
  EXPECT_EQ(file.assessment->limits->limits.size(), 1u);
  EXPECT_THAT(samples::error_of([&] { parse(with_file("limit.toml")); }),
              AllOf(HasSubstr("assessment.limits: there is no file"), HasSubstr("limits.toml")));
}

}  // namespace
}  // namespace treadmark::io
