// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "treadmark/tests/io/simulations/samples.hpp"

namespace treadmark::testing {
namespace {

const char* kStudy = R"([study]
title = "Two flats at two speeds"
base = "simulation.toml"

[[study.vary]]
key = "simulation.speed_m_s"
label = "speed [m/s]"
values = [20, 40]

[[study.vary]]
key = "wheel.flats.0.depth_mm"
values = [0.5, 0.9]

[[study.figures]]
file = "force-by-distance.svg"
kind = "history"
x = "x_m"
y = ["Q_N"]

[[study.figures]]
file = "force-by-speed.svg"
kind = "summary"
x = "simulation.speed_m_s"
y = ["q_max_N"]
series = "wheel.flats.0.depth_mm"
)";

// Dearer than a table in the long run, but there is no long run here.
const char* kRoundWheel = R"([[simulation.wheels]]
wheelset = 1
side = "right"
contact = "full"
defects = false
)";

}  // namespace

SampleSimulation::SampleSimulation() {
  write("vehicle.toml", io::samples::kVehicle);
  write("track.toml", io::samples::kTrack);
  write("simulation.toml", io::samples::kSimulation);
  edit("simulation.toml", "distance_m = 3", "distance_m = 0.06\ncheckpoint_s = 0.02");
  edit("simulation.toml", "pitch_deg = 30\n", "pitch_deg = 4\n\n" + std::string(kRoundWheel));
  edit("simulation.toml", "dx_mm = 0.5", "dx_mm = 2\nds_mm = 2");
  write("study.toml", kStudy);
}

void SampleSimulation::share_rails() {
  // Twice the same, one behind the other.
  edit("vehicle.toml", "position_m = [0, 0, -1]", "positions_m = [[0.9, 0, -1], [-0.9, 0, -1]]");
  edit("vehicle.toml", "position_m = [0, 0, -0.46]", "positions_m = [[0.9, 0, -0.46], [-0.9, 0, -0.46]]");
  edit("vehicle.toml", "between = [\"axle\", \"mass\"]\nat_m = [[0, -1, -0.46], [0, 1, -0.46]]",
       "places = [{ between = [\"axle1\", \"mass1\"], at_m = [[0.9, -1, -0.46], [0.9, 1, -0.46]] },\n"
       "{ between = [\"axle2\", \"mass2\"], at_m = [[-0.9, -1, -0.46], [-0.9, 1, -0.46]] }]");
  edit("vehicle.toml", "between = [\"axle\", \"mass\"]\nat_m = [[0, 0, -0.6]]",
       "places = [{ between = [\"axle1\", \"mass1\"], at_m = [[0.9, 0, -0.6]] },\n"
       "{ between = [\"axle2\", \"mass2\"], at_m = [[-0.9, 0, -0.6]] }]");
  edit("vehicle.toml", "body = \"axle\"\nnominal_radius_mm = 460",
       "body = \"axle1\"\nnominal_radius_mm = 460\n[[wheelsets]]\nbody = \"axle2\"\nnominal_radius_mm = 460");
  // The leading wheelset begins at 33.33 m from the first seat.
  std::ifstream track(std::filesystem::path(TREADMARK_SOURCE_DIR) / "examples/tracks/zhai-sideways.toml");
  const std::string seats{std::istreambuf_iterator<char>(track), {}};
  write("rails.toml", seats +
                          "\n[[joints]]\nplace_m = 33.38\nhinge_stiffness_N_m_per_rad = 1e6\ndip_mm = 0.3\n"
                          "dip_length_mm = 300\n");
  edit("simulation.toml", "\"track.toml\"", "\"rails.toml\"\nshared_rails = true");
  std::string hind;
  for (const char* side : {"left", "right"})
    hind += "[[simulation.wheels]]\nwheelset = 2\nside = \"" + std::string(side) +
            "\"\ncontact = \"full\"\ndefects = false\n\n";
  edit("simulation.toml", "[case]", hind + "[case]");
}

}  // namespace treadmark::testing
