// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/simulation/contact_tables.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

// Rails of their own on both sides, and rails and friction that vary along the track.

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

constexpr double kMilli = 1e-3;

/// A wheelset that does not move sideways.
const char* kGuided = R"([vehicle]
name = "guided"

[[bodies]]
name = "load"
mass_kg = 9000
position_m = [0, 0, -1]
free = ["z"]

[[bodies]]
name = "axle"
mass_kg = 1800
inertia_kg_m2 = [1100, 110, 1100]
position_m = [0, 0, -0.46]
free = ["z", "roll", "pitch"]

[[wheelsets]]
body = "axle"
nominal_radius_mm = 460

[[springs]]
name = "primary"
between = ["axle", "load"]
at_m = [[0, -1, -0.46], [0, 1, -0.46]]
stiffness_N_per_m = [30e6, 4e6, 1.2e6]
damping_N_s_per_m = [0, 0, 40e3]
)";

const char* kCommon = R"([wheel]
shape.standard = "S1002"

[wheelset]
flange_back_distance_mm = 1360
flange_back_position_mm = -70

[friction]
coefficient = 0.3

[discretisation]
dx_mm = 1.5
ds_mm = 1.5

[case]
regime = "steady"
)";

/// As in examples/crossing.toml.
std::string crossing(const std::string& rail) {
  return fmt::format(R"([[{0}.parts]]
standard = "60E1"
crossing = "nose"
crossing_x_mm = 0
crossing_length_mm = 400
[[{0}.parts]]
standard = "60E1"
y_mm = 36
z_mm = -0.6
crossing = "wing"
crossing_x_mm = -250
crossing_length_mm = 500

)",
                     rail);
}

class RailsOfSimulations : public ::testing::Test {
 protected:
  RailsOfSimulations() { input.write("vehicle.toml", kGuided); }
  void write(const std::string& simulation, const std::string& track = "[track]\ngauge_mm = 1435\n\n") const {
    input.write("s.toml", "[simulation]\nvehicle = \"vehicle.toml\"\n" + simulation + track + kCommon);
  }
  io::SimulationResult simulate(const std::vector<std::string>& options = {}) const {
    std::filesystem::remove_all(input.path("out"));
    std::vector<std::string> words{"simulate", input.path("s.toml"), "-o", input.path("out")};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramResult r = run_program(words);
    EXPECT_EQ(r.status, 0) << r.err;
    return io::read_simulation(input.path("out/simulation.h5"));
  }
  /// What check and simulate both say.
  std::string refusal() const {
    const ProgramResult check = run_program({"check", input.path("s.toml")});
    EXPECT_EQ(check.status, 2) << check.out;
    EXPECT_EQ(run_program({"simulate", input.path("s.toml")}).status, 2);
    return check.err;
  }
  static std::vector<double> column(const io::SimulationResult& history, const std::string& name) {
    return column_values(history, column_index(history, name));
  }
  SampleSimulation input;
};

const char* kBothFull = R"(speed_m_s = 10
distance_m = 0.02
[[simulation.wheels]]
wheelset = 1
side = "left"
contact = "full"
[[simulation.wheels]]
wheelset = 1
side = "right"
contact = "full"
[rail]
shape.standard = "60E1"
)";

TEST_F(RailsOfSimulations, ByTheirPlaceAreMirrorImages) {
  write(kBothFull, "[track]\nrail_y_mm = 753.6\nrail_z_mm = 0\n\n");
  const io::SimulationResult history = simulate();
  // Both in full, one from a table, both from tables.
  const std::vector<std::vector<std::string>> tables{
      {"--set", "simulation.wheels.0.contact=table"},
      {"--set", "simulation.wheels.0.contact=table", "--set", "simulation.wheels.1.contact=table"}};
  constexpr double kWeight = 9.81 * 10800.0;
  const double at_left = column(history, "y_cp_m").back(), at_right = column(history, "ws1_right.y_cp_m").back();
  EXPECT_NEAR(at_left, -at_right, 1e-9);
  EXPECT_NEAR(at_right, 0.7536 - 0.0136, 2e-3);
  EXPECT_NEAR(column(history, "Q_N").back(), column(history, "ws1_right.Q_N").back(), 1e-6 * kWeight);
  EXPECT_NEAR(column(history, "Y_N").back(), -column(history, "ws1_right.Y_N").back(), 1e-6 * kWeight);
  for (const auto& options : tables) {
    const io::SimulationResult other = simulate(options);
    const std::string left = options.size() == 2 ? "ws1_left.Q_N" : "Q_N",
                      right = options.size() == 2 ? "Q_N" : "ws1_right.Q_N";
    EXPECT_NEAR(column(other, left).back(), 0.5 * kWeight, 0.01 * kWeight);
    EXPECT_NEAR(column(other, right).back(), 0.5 * kWeight, 0.01 * kWeight);
  }
}

/// Under the same load and guidance `run` finds the wheelset at the same height with the same patches.
TEST_F(RailsOfSimulations, APassageOfACrossingIsThatOfCases) {
  write(R"(speed_m_s = 0.5
distance_m = 0.03
rail_start_m = -0.045
left_rail.shape.standard = "60E1"
[[simulation.wheels]]
wheelset = 1
side = "right"
contact = "full"
)" + crossing("simulation.right_rail"),
        "[track]\nrail_y_mm = 753.6\nrail_z_mm = 0\n\n");
  const io::SimulationResult history = simulate();
  const auto at = [&](const std::string& name, std::size_t row) { return column(history, name).at(row); };
  const std::size_t rows = history.rows();
  const std::vector<double> z = column(history, "wheelset_z_m"), patches = column(history, "patches");
  const double way = *ranges::max_element(z) - *ranges::min_element(z);
  EXPECT_GT(way, 1e-4);
  EXPECT_EQ(*ranges::max_element(patches), 2.0) << "wing and nose carry together";
  const std::vector<double> y = column(history, "y_cp_m");
  EXPECT_LT(*ranges::min_element(y), 0.75);
  EXPECT_GT(*ranges::max_element(y), 0.78);

  // At rest, and where the nose takes over.
  std::vector<std::size_t> chosen{0, rows / 4, rows / 2, rows - 1};
  for (std::size_t row = 0; row < rows; ++row)
    if (patches[row] == 2.0) {
      chosen.push_back(row);
      break;
    }
  std::string text = "contact.reference_surface = \"plane_surface_slip\"\n" + crossing("rail") + kCommon +
                     "side = \"right\"\n\n[track]\nrail_y_mm = 753.6\nrail_z_mm = 0\n";
  for (const std::size_t row : chosen)
    text += fmt::format(
        "\n[[cases]]\nwheelset.vertical_force_N = {:.12g}\nwheelset.s_mm = {:.12g}\nwheelset.y_mm = 0\n"
        "wheelset.roll_rad = {:.12g}\nwheelset.nominal_radius_mm = 460\nwheelset.velocity_m_s = {:.12g}\n"
        "wheelset.vpitch_rad_s = {:.12g}\nwheelset.vroll_rad_s = {:.12g}\n",
        at("Q_N", row), (at("wheelset_x_m", row) - 0.045) / kMilli, at("wheelset_roll_rad", row),
        at("wheelset_vx_m_s", row), at("wheelset_vpitch_rad_s", row), at("wheelset_vroll_rad_s", row));
  input.write("case.toml", text);
  const io::RunResult run = app::run_cases(io::read_any_case(input.path("case.toml")));
  ASSERT_EQ(run.cases.size(), chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    SCOPED_TRACE(chosen[i]);
    const io::CaseResult& c = run.cases[i];
    const std::size_t row = chosen[i];
    EXPECT_NEAR(c.z, at("wheelset_z_m", row), 0.01 * way);
    ASSERT_EQ(static_cast<double>(c.patches.size()), patches[row]);
    const auto most = ranges::max_element(c.patches, {}, &io::PatchResult::fn);
    EXPECT_NEAR(most->pmax, at("pmax_Pa", row), 0.01 * most->pmax);
    EXPECT_NEAR(most->y_tr, at("y_cp_m", row), 1e-5);
  }
}

const char* kSquat = R"(
squats = [{ length_mm = 30, width_mm = 60, depth_mm = 0.1, x_center_mm = 30, y_center_mm = -13 }]
)";

TEST_F(RailsOfSimulations, WheelsetsPassADefectOneAfterTheOther) {
  // Axles far too close to each other for a real vehicle, so that the way is short.
  std::string two = kGuided;
  const auto edit = [&](const std::string& from, const std::string& to) {
    two.replace(two.find(from), from.size(), to);
  };
  edit("position_m = [0, 0, -0.46]", "positions_m = [[0.02, 0, -0.46], [-0.02, 0, -0.46]]");
  edit("body = \"axle\"\nnominal_radius_mm = 460",
       "body = \"axle1\"\nnominal_radius_mm = 460\n[[wheelsets]]\nbody = \"axle2\"\nnominal_radius_mm = 460");
  edit("between = [\"axle\", \"load\"]\nat_m = [[0, -1, -0.46], [0, 1, -0.46]]",
       "places = [{ between = [\"axle1\", \"load\"], at_m = [[0.02, -1, -0.46], [0.02, 1, -0.46]] },\n"
       "{ between = [\"axle2\", \"load\"], at_m = [[-0.02, -1, -0.46], [-0.02, 1, -0.46]] }]");
  input.write("vehicle.toml", two);
  write(std::string("speed_m_s = 2\ndistance_m = 0.1\n") + R"([[simulation.wheels]]
wheelset = 1
side = "right"
contact = "full"
[[simulation.wheels]]
wheelset = 2
side = "right"
contact = "full"
[rail]
shape.standard = "60E1")" +
        kSquat);
  const io::SimulationResult history = simulate();
  const std::vector<double> x = column(history, "x_m");
  const auto deepest = [&](const std::string& name) {
    const std::vector<double> z = column(history, name);
    return x.at(static_cast<std::size_t>(ranges::max_element(z) - z.begin()));
  };
  EXPECT_NEAR(deepest("wheelset_z_m"), 0.03, 4e-3);
  EXPECT_NEAR(deepest("ws2_right.wheelset_z_m"), 0.03 + 0.04, 4e-3);
}

TEST_F(RailsOfSimulations, ACheckRailHoldsTheFlange) {
  std::string free = kGuided;
  const std::string guided = "free = [\"z\", \"roll\", \"pitch\"]";
  free.replace(free.find(guided), guided.size(), "free = [\"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\"]");
  input.write("vehicle.toml", free);
  // 2 mm within the flange of a wheelset in the middle.
  write(R"(speed_m_s = 10
distance_m = 2.5
[[simulation.check_rails]]
side = "right"
from_m = 0.1
to_m = 2.1
face_y_mm = 682
stiffness_N_per_m = 5e7
damping_N_s_per_m = 1e5
flare_m = 0.5
flare_mm = 5
[rail]
shape.standard = "60E1"
)");
  const io::SimulationResult history = simulate();
  const std::vector<double> x = column(history, "x_m"), y = column(history, "axle.y_m"),
                            right = column(history, "ws1_right.check_N"), left = column(history, "check_N");
  double most = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(left[i], 0.0);
    const bool away = x[i] < 0.1 || x[i] > 2.1, held = x[i] > 0.6 && x[i] < 1.6;
    EXPECT_EQ(away ? right[i] : 0.0, 0.0) << x[i];
    most = std::max(most, right[i]);
    // Pushed along but for what the springs of check rail and track give.
    EXPECT_GT(held ? y[i] : 1.0, 1e-3) << x[i];
  }
  EXPECT_GT(most, 5e3);
  EXPECT_NEAR(y.front(), 0.0, 1e-6);
  for (const char* name : {"energy_integration_error", "energy_contact_error"}) {
    const auto error = ranges::find(history.summary, name, &io::NamedValue::name);
    ASSERT_NE(error, history.summary.end());
    EXPECT_LT(std::abs(error->value), 0.01) << name;
  }
}

TEST(EnergyDoubt, TellsWhatIsMissing) {
  vehicle::EnergyBalance start, now;
  start.elastic = 3.0;
  now.turnover = 100.0;
  now.drive = 10.0;
  now.friction = 9.0;
  now.elastic = 3.0;  // 1 J of 100 J
  EXPECT_EQ(app::energy_doubt(now, start), "");
  now.friction = 18.0;
  EXPECT_THAT(app::energy_doubt(now, start), HasSubstr("0.08 of the turnover"));
  now.friction = 10.0;
  now.dampers = 5.0;
  EXPECT_THAT(app::energy_doubt(now, start), HasSubstr("0.05 of the turnover"));
}

std::string changing_over(const std::string& stretch) {
  return "speed_m_s = 10\ndistance_m = 0.4\n[[simulation.wheels]]\nwheelset = 1\nside = \"right\"\ncontact = "
         "\"full\"\n" +
         stretch + "[rail]\nshape.standard = \"60E1\"";
}
const char* kSquatAhead =
    "\nsquats = [{ length_mm = 30, width_mm = 60, depth_mm = 0.1, x_center_mm = 200, y_center_mm = -13 }]\n";

TEST_F(RailsOfSimulations, FullContactWhereTheRailVaries) {
  write(changing_over("") + kSquatAhead);
  const io::SimulationResult full = simulate();
  write(changing_over("full_from_m = 0.1\nfull_to_m = 0.3\n") + kSquatAhead);
  const io::SimulationResult both = simulate();
  const auto largest = [&](const io::SimulationResult& r) {
    const std::vector<double> q = column(r, "Q_N");
    return *ranges::max_element(q);
  };
  EXPECT_GT(largest(full), 1.1 * column(full, "Q_N").front());
  EXPECT_NEAR(largest(both), largest(full), 0.01 * largest(full));
  const std::vector<double> x = column(both, "x_m"), q = column(both, "Q_N");
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i] < 0.18 ? q[i] : q[0], q[0], 0.005 * q[0]) << x[i];
}

TEST_F(RailsOfSimulations, TablesOnRailsThatVaryAreRefused) {
  write(changing_over("full_from_m = 0.2\nfull_to_m = 0.35\n") + kSquatAhead);
  EXPECT_THAT(refusal(), ::testing::ContainsRegex("s\\.toml:[0-9]+:[0-9]+: ws1_right takes its forces from a table at "
                                                  "x = 0\\.[12].* which differs there by 0\\.[01]"));
  write(changing_over("full_to_m = 0.19\n") + kSquatAhead);
  EXPECT_THAT(refusal(), HasSubstr("which differs there by"));
  // The wing before a crossing is not the rail behind it, and no rail of one section is there at all.
  const std::string own = "left_rail.shape.standard = \"60E1\"\n", table = "table_rail.shape.standard = \"60E1\"\n",
                    begin = "speed_m_s = 10\ndistance_m = 0.1\n";
  write(begin + own + crossing("simulation.right_rail"));
  EXPECT_THAT(refusal(), HasSubstr("wheels with table contact need a rail of one section"));
  write(begin + own + table + crossing("simulation.right_rail"), "[track]\nrail_y_mm = 753.6\n\n");
  EXPECT_THAT(refusal(), HasSubstr("takes its forces from a table at x = "));
  write(begin + own + table + crossing("simulation.right_rail"));
  EXPECT_THAT(refusal(), HasSubstr("the rail below ws1_right and that of its table lie 0.628 mm apart"));
  write(begin + own + crossing("simulation.right_rail") + crossing("simulation.table_rail"));
  EXPECT_THAT(refusal(), HasSubstr("simulation.table_rail must not vary"));
}

/// A key of case files that says something for places along the track, in a simulation of 0.14 m.
struct AlongTrack {
  const char *key, *contact;
  std::string tables;       ///< that say it
  const char *change, *of;  ///< another value, and the channel of the right wheel that shows it
  double least;             ///< that this channel changes by
  double place;             ///< up to which nothing changes, a little before it [m]
};
std::ostream& operator<<(std::ostream& out, const AlongTrack& row) { return out << row.key << ' ' << row.contact; }

std::string on_60e1(const std::string& defects) { return "[rail]\nshape.standard = \"60E1\"\n" + defects + '\n'; }

/// 8 kN m on the axle, 8.7 kN at each wheel, under 53 kN.
const std::string kDriven =
                      "[[simulation.torques]]\nwheelset = 1\ntime_s = [0, 0.004]\ntorque_N_m = [0, 8000]\n"
                      "reaction = \"ground\"\n" +
                      on_60e1(""),
                  kFrictionAlong =
                      "[[friction.along_track]]\ns_mm = 0\ncoefficient = 0.3\n"
                      "[[friction.along_track]]\ns_mm = 60\ncoefficient = 0.3\n"
                      "[[friction.along_track]]\ns_mm = 75\ncoefficient = 0.3\n";
const char* const kSlippery = "friction.along_track.2.coefficient=0.05";

const AlongTrack kAlongTrack[] = {
    {"friction.along_track", "full", kDriven + kFrictionAlong, kSlippery, "Tx_N", 1e3, 0.054},
    {"friction.along_track", "table", kDriven + kFrictionAlong, kSlippery, "Tx_N", 1e3, 0.054},
    {"friction.along_track", "auto", kDriven + kFrictionAlong, kSlippery, "Tx_N", 1e3, 0.054},
    {"rail.squats", "full", on_60e1("squats = [{ length_mm = 30, width_mm = 60, depth_mm = 0.1, x_center_mm = 90 }]"),
     "rail.squats.0.depth_mm=0.2", "Q_N", 500.0, 0.06},
    {"rail.spalls", "full",
     on_60e1("spalls = [{ length_mm = 30, width_mm = 60, depth_mm = 0.1, edge_mm = 8, x_center_mm = 90 }]"),
     "rail.spalls.0.depth_mm=0.2", "Q_N", 500.0, 0.06},
    {"rail.gauge_corner_collapses", "full",
     on_60e1("gauge_corner_collapses = [{ length_mm = 30, depth_mm = 0.1, width_mm = 40, x_center_mm = 90, "
             "y_start_mm = -30, towards = \"+y\" }]"),
     "rail.gauge_corner_collapses.0.depth_mm=0.2", "Q_N", 500.0, 0.06},
    {"rail.corrugations", "full",
     on_60e1("corrugations = [{ x_start_mm = 70, x_end_mm = 400, ramp_mm = 10, waves = [{ wavelength_mm = 40, "
             "amplitude_um = 20 }] }]"),
     "rail.corrugations.0.waves.0.amplitude_um=40", "Q_N", 500.0, 0.055},
    {"rail.flattened_heads", "full",
     on_60e1("flattened_heads = [{ x_start_mm = 70, x_end_mm = 400, ramp_mm = 40, depth_mm = 0.5 }]"),
     "rail.flattened_heads.0.depth_mm=0.8", "Q_N", 500.0, 0.055},
    // A plane that sinks: the wheel touches 0.36 mm below the top, which it reaches at 97 mm, or at 82 mm.
    {"rail.milling_paths", "full",
     on_60e1(
         "milling_paths = [{ start_y_mm = -40, section = [{ length_mm = 80 }], stations = [{ x_mm = -100, z_mm = -2 "
         "}, { x_mm = 200, z_mm = 1.6 }] }]"),
     "rail.milling_paths.0.stations.1.z_mm=1.9", "Q_N", 500.0, 0.06},
    {"rail.shape.crossing_x_mm", "full",
     "[rail.shape]\nstandard = \"60E1\"\ncrossing = \"wing\"\ncrossing_x_mm = 85\ncrossing_rounding_mm = 30\n"
     "crossing_slope = 0.01\n",
     "rail.shape.crossing_slope=0.04", "y_cp_m", 2e-4, 0.055},
    {"rail.parts", "full",
     "[[rail.parts]]\nstandard = \"60E1\"\ncrossing = \"wing\"\ncrossing_x_mm = 85\ncrossing_rounding_mm = 30\n"
     "crossing_slope = 0.01\n[[rail.parts]]\nstandard = \"60E1\"\nz_mm = 20\n",
     "rail.parts.0.crossing_slope=0.04", "y_cp_m", 2e-4, 0.055}};

/// Straight between the instants.
double value_at(const io::SimulationResult& history, const std::string& channel, double x) {
  const std::vector<double> places = column_values(history, column_index(history, "x_m")),
                            values = column_values(history, column_index(history, channel));
  const auto behind = std::clamp<std::ptrdiff_t>(std::upper_bound(places.begin(), places.end(), x) - places.begin(), 1,
                                                 std::ssize(places) - 1);
  const auto i = static_cast<std::size_t>(behind);
  return std::lerp(values[i - 1], values[i], (x - places[i - 1]) / (places[i] - places[i - 1]));
}

class Passages : public RailsOfSimulations {
 protected:
  /// tables: beside what all have.
  void write_passage(const std::string& contact, const std::string& tables) const {
    input.write("s.toml", "[simulation]\nvehicle = \"vehicle.toml\"\nspeed_m_s = 5\ndistance_m = 0.14\ncontact = \"" +
                              contact + "\"\nleft_rail.shape.standard = \"60E1\"\n" + kCommon +
                              "[track]\ngauge_mm = 1435\n\n" + tables);
  }
  io::SimulationResult passage(const std::vector<std::string>& overrides = {}) const {
    const io::SimulationFile file = io::read_simulation_file(input.path("s.toml"), overrides);
    static app::ContactTables tables;
    app::SurfaceStore store;
    app::SimulationOptions options;
    options.tables = &tables;
    io::SimulationResult r = app::run_simulation(file, store, options, {});
    EXPECT_EQ(r.status, "complete") << r.message;
    return r;
  }
};

class AlongTheTrack : public Passages, public ::testing::WithParamInterface<AlongTrack> {};

TEST_P(AlongTheTrack, AChangeShowsFromItsPlaceOn) {
  const AlongTrack& row = GetParam();
  write_passage(row.contact, row.tables);
  const io::SimulationResult given = passage(), changed = passage({row.change});
  const std::string channel = std::string("ws1_right.") + row.of;
  double before = 0.0, behind = 0.0;
  for (double x = 0.0; x < 0.14; x += kMilli) {
    double& most = x < row.place ? before : behind;
    most = std::max(most, std::abs(value_at(changed, channel, x) - value_at(given, channel, x)));
  }
  EXPECT_GT(behind, row.least);
  EXPECT_LT(before, 0.01 * behind);
}

INSTANTIATE_TEST_SUITE_P(Keys, AlongTheTrack, ::testing::ValuesIn(kAlongTrack));

/// Whether a key says where along the track something is.
bool says_place(const io::KeyInfo& key) {
  const std::string_view name = std::string_view(key.path).substr(key.path.rfind('.') + 1);
  return name == "s_mm" || name == "x_mm" || name == "x_center_mm" || name == "x_start_mm" || name == "crossing_x_mm" ||
         ranges::any_of(key.elements, says_place);
}

TEST(PlacesAlongTheTrack, AreAllTriedInSimulations) {
  const std::set<std::string> elsewhere{"rail.shape.solids"};  // where whole bodies lie
  int found = 0;
  for (const io::CaseKey& key : io::case_keys()) {
    const std::string& path = key.info.path;
    if (!(path.starts_with("rail.") || path.starts_with("friction.")) || !says_place(key.info)) continue;
    ++found;
    const bool tried = ranges::any_of(kAlongTrack, [&](const AlongTrack& row) { return path == row.key; });
    EXPECT_TRUE(tried || elsewhere.contains(path)) << path;
  }
  EXPECT_GT(found, 5);
}

/// The torque goes into the rails while friction carries it; where it does not, the wheels spin and take mu Q.
TEST_F(Passages, FrictionBoundsTheForcesOfEveryWheelWhereItStands) {
  constexpr double kAxleForce = 8000.0 / 0.46;  // [N]
  for (const char* contact : {"full", "table"}) {
    SCOPED_TRACE(contact);
    write_passage(contact, kDriven + kFrictionAlong);
    for (const double start : {0.0, 0.02}) {  // of the axle along the rails
      const io::SimulationResult r = passage({kSlippery, fmt::format("simulation.rail_start_m={}", start)});
      for (const char* wheel : {"", "ws1_right."}) {
        const auto at = [&](const char* channel, double place) {
          return value_at(r, std::string(wheel) + channel, place - start);
        };
        EXPECT_NEAR(std::abs(at("Tx_N", 0.056)), 0.5 * kAxleForce, 0.02 * kAxleForce);
        EXPECT_NEAR(std::abs(at("Tx_N", 0.115)), 0.05 * at("Q_N", 0.115), 0.003 * at("Q_N", 0.115));
      }
    }
  }
}

TEST_F(RailsOfSimulations, WheelsThatAreNotRoundDoNotChangeOver) {
  input.edit("simulation.toml", "pitch_deg = 4\n", "pitch_deg = 4\nfull_to_m = 1\n");
  const ProgramResult r = run_program({"check", input.path("simulation.toml")});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("ws1_left is not round: its contact cannot change over to a table"));
}

}  // namespace
}  // namespace treadmark::testing
