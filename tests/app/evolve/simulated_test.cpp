// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <utility>

#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/files/replaced.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_evolution.hpp"
#include "treadmark/tests/app/evolve/wheel_law.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/io/simulations/samples.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A braked wheel with a chord flat passes over it below a sprung mass.
const std::string kPassage = R"([simulation]
vehicle = "vehicle.toml"
track = "track.toml"
speed_m_s = 5
distance_m = 0.16

[[simulation.torques]]
wheelset = 1
time_s = [0]
torque_N_m = [-4000]
reaction = "ground"

[simulation.fields]
pitch_deg = [-7, -6, -5, -4, -3.5, -3, -2.5, -2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7]

[[simulation.wheels]]
wheelset = 1
side = "right"
contact = "full"
pitch_deg = 9

[case]
regime = "steady"

[wheel]
shape.standard = "S1002"
flats = [{ shape = "fresh", length_mm = 60 }]

[rail]
shape.standard = "60E1"

[track]
cant = "1:40"

[discretisation]
dx_mm = 2
ds_mm = 2
)";

const std::string kStudy = R"([evolve]
base = "passage.toml"
distance_km = 20000
updates = 4
[evolve.wheel]
along = "local"
du_mm = 2
dy_mm = 2
smoothing_mm = 3
)" + kLaw;

/// Relative tolerance of tractions: elements that stick have slip of that size, whose work counts on the surface alone.
constexpr double kSolver = 1e-5;
/// What elements of 2 mm at the edges of a flat move the largest force by from one generation to the next.
constexpr double kElements = 0.02;

class SimulatedEvolution : public ::testing::Test {
 protected:
  SimulatedEvolution() {
    folder_.write("vehicle.toml", io::samples::kVehicle);
    folder_.write("track.toml", io::samples::kTrack);
  }
  std::string study(const std::string& passage = kPassage, const std::string& study = kStudy) {
    folder_.write("passage.toml", passage);
    return folder_.write("study.toml", study);
  }
  std::string error(const std::string& passage, const std::string& evolve) {
    return error_of([&] {
      const io::EvolutionFile file = io::read_evolution_file(study(passage, evolve));
      app::check_evolution(file);
    });
  }
  std::string path(const std::string& name) const { return folder_.path() / name; }
  TemporaryFolder folder_;
};

double number(const io::Generation& g, const std::string& name) {
  for (const io::EvolutionQuantity& q : io::quantities_of(g))
    if (q.name == name) return q.value;
  ADD_FAILURE() << name;
  return std::nan("");
}

TEST_F(SimulatedEvolution, FirstGenerationIsTheSimulation) {
  const std::string file = study(kPassage, io::replaced(kStudy, "updates = 4", "updates = 1"));
  run_program({"evolve", file, "-o", path("out"), "--quiet"});  // the status is that of doubts at the sharp edges
  run_program({"simulate", path("passage.toml"), "-o", path("simulated"), "--quiet"});
  const std::string first = content_of(path("out") + "/simulation_0000.h5");
  ASSERT_FALSE(first.empty());
  EXPECT_TRUE(first == content_of(path("simulated") + "/simulation.h5"));

  if (has_part("report")) {
    const ProgramResult report = run_program({"report", path("out"), "-o", path("page.html")});
    EXPECT_EQ(report.status, 0) << report.err;
    EXPECT_THAT(content_of(path("page.html")), HasSubstr("largest vertical force of a simulation"));
  }

  const io::EvolutionResult result = io::read_evolution_folder(path("out"));
  ASSERT_EQ(result.status, "complete");
  ASSERT_EQ(result.generations.size(), 2u);
  for (const io::Generation& g : result.generations) {
    // what the generation says of its simulation is what that says
    const io::SimulationResult one = io::read_simulation(path("out") + "/" + io::simulation_file(g.number, 0, 1));
    const auto largest = ranges::find(one.summary, "q_max_N", &io::NamedValue::name);
    ASSERT_NE(largest, one.summary.end());
    EXPECT_EQ(largest->value, number(g, "q_max_N"));
    EXPECT_LT(std::fabs(io::volume_balance(g.bodies.front())), 1e-9);
    EXPECT_LT(std::fabs(io::work_balance(g.bodies.front())), kSolver);
  }
}

struct FlatShape {
  double length = 0.0;  ///< over which the radius misses more than 0.1 mm [m]
  double turn = 0.0;    ///< of the circumference within 20 mm at the sharper edge [rad]
};

/// On one row of the cells.
FlatShape shape_of(const io::EvolvedBody& wheel, int row) {
  constexpr double kNominal = 0.46, kHalf = 0.03, kReach = 20e-3;
  const SurfaceCells& cells = wheel.cells;
  const double radius = cells.radius[static_cast<std::size_t>(row)],
               chord = radius - (kNominal - std::sqrt(kNominal * kNominal - kHalf * kHalf));
  const int reach = static_cast<int>(std::lround(kReach / (cells.du * radius)));
  const auto r = [&](int i) {
    const double theta = i * cells.du;
    return std::min(radius, chord / std::cos(theta)) -
           damage::depth_of(cells, wheel.record.volume.at((i + cells.nu) % cells.nu, row), row);
  };
  FlatShape shape;
  for (int i = -60; i <= 60; ++i) {
    shape.turn = std::max(shape.turn, (2.0 * r(i) - r(i - reach) - r(i + reach)) / (reach * cells.du * radius));
    if (r(i) < radius - 0.1e-3) shape.length += cells.du * radius;
  }
  return shape;
}

/// A chord flat rounds off and the wheel strikes less and less.
TEST_F(SimulatedEvolution, FlatRoundsOffAndForcesFall) {
  const io::EvolutionFile file = io::read_evolution_file(study());
  const io::EvolutionResult result = app::run_evolution(file, {path("out"), false, {}});
  ASSERT_EQ(result.status, "complete") << result.message;
  const auto generation = [&](std::size_t k) {
    return io::read_generation(fs::path(path("out")) / io::generation_file(static_cast<int>(k)));
  };
  const io::EvolvedBody last = generation(4).bodies.front();
  int row = 0;
  double most = 0.0;
  for (const auto& [j, values] : last.record.volume.rows()) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    if (sum > most) most = sum, row = j;
  }
  FlatShape before = shape_of(generation(0).bodies.front(), row);
  for (std::size_t k = 1; k < result.generations.size(); ++k) {
    const FlatShape now = shape_of(generation(k).bodies.front(), row);
    EXPECT_LT(number(result.generations[k], "q_max_N"),
              (1.0 + kElements) * number(result.generations[k - 1], "q_max_N"));
    EXPECT_GE(now.length, before.length);
    EXPECT_LT(now.turn, before.turn);
    before = now;
  }
  EXPECT_LT(number(result.generations.back(), "q_max_N"), 0.85 * number(result.generations.front(), "q_max_N"));
}

/// Flow alone does so within some hundred turns of the wheel, and takes nothing away.
TEST_F(SimulatedEvolution, FlatFlowsAndForcesFall) {
  std::string flowing = io::replaced(io::replaced(kStudy, "distance_km = 20000", "distance_km = 0.4"), "1e-4", "0");
  flowing +=
      "[evolve.wheel.flow]\ntheory = \"ratchetting\"\nsource = \"assumed\"\nshear_yield_MPa = 400\n"
      "strain_per_cycle = 0.00237\ndepths_mm = [2, 3, 4, 5, 6, 8, 10, 12, 15, 20]\n";
  const io::EvolutionResult result =
      app::run_evolution(io::read_evolution_file(study(kPassage, flowing)), {path("out"), false, {}});
  ASSERT_EQ(result.status, "complete") << result.message;
  for (std::size_t k = 1; k < result.generations.size(); ++k)
    EXPECT_GT(number(result.generations[k], "wheel_strain"), number(result.generations[k - 1], "wheel_strain"));
  EXPECT_LT(number(result.generations.back(), "q_max_N"), 0.985 * number(result.generations.front(), "q_max_N"));
  const io::EvolvedBody& wheel = result.generations.back().bodies.front();
  EXPECT_GT(wheel.max_depth, 5e-6);
  double moved = 0.0;
  for (const auto& [j, row] : wheel.record.volume.rows())
    for (const double volume : row) moved += std::fabs(volume);
  EXPECT_LT(std::fabs(wheel.record.volume.sum()), 1e-12 * moved);
}

TEST_F(SimulatedEvolution, GoesOnToTheSameBytes) {
  const std::string file = study(kPassage, io::replaced(kStudy, "updates = 4", "updates = 2"));
  run_program({"evolve", file, "-o", path("one"), "--quiet"});
  ASSERT_EQ(io::read_evolution_folder(path("one")).status, "complete");
  const io::EvolutionFile read = io::read_evolution_file(file);
  std::atomic<bool> stop = false;
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t, std::size_t, const std::string& what) { stop = stop || what == "generation 1"; };
  const io::EvolutionResult stopped = app::run_evolution(read, {path("two"), false, {}}, progress);
  EXPECT_EQ(stopped.status, "interrupted");
  run_program({"evolve", file, "-o", path("two"), "--resume", "--quiet", "--threads", "1"});
  for (const auto& entry : fs::directory_iterator(path("one"))) {
    if (entry.path().filename() == "lock") continue;
    EXPECT_TRUE(content_of(entry.path()) == content_of(fs::path(path("two")) / entry.path().filename()))
        << entry.path().filename();
  }
}

/// Both wheels pass over a rail with a dip: it wears where they are, by the work that the simulation states, and the
/// force of the next generation is that of a simulation over its surface file.
TEST_F(SimulatedEvolution, RailsWearBelowWheelsThatPass) {
  // Steps that resolve the peak of the force.
  std::string passage = io::replaced(kPassage, "distance_m = 0.16", "distance_m = 0.16\nmax_step_elements = 0.2");
  passage = io::replaced(passage, "pitch_deg = 9",
                         "[[simulation.wheels]]\nwheelset = 1\nside = \"left\"\n"
                         "contact = \"full\"\n");
  passage = io::replaced(passage, "flats = [{ shape = \"fresh\", length_mm = 60 }]\n", "");
  passage = io::replaced(passage, "[track]",
                         "squats = [{ length_mm = 40, width_mm = 30, depth_mm = 0.3, x_center_mm = 80 }]\n[track]");
  const auto from = passage.find("pitch_deg = [-7"), to = passage.find(']', from);
  passage.replace(from, to - from + 1,
                  "position_m = [0.01, 0.03, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.13, 0.15]");
  const std::string evolve = io::replaced(
      io::replaced(io::replaced(kStudy, "distance_km = 20000", "passages = 3e5"), "evolve.wheel", "evolve.rail"),
      "updates = 4", "updates = 1");
  const io::EvolutionResult result = app::run_evolution(
      io::read_evolution_file(study(passage, io::replaced(evolve, "evolve.wheel.law", "evolve.rail.law"))),
      {path("out"), false, {}});
  ASSERT_EQ(result.status, "complete") << result.message;
  const io::EvolvedBody& rail = result.generations.back().bodies.front();
  EXPECT_EQ(rail.body, Body::rail);
  EXPECT_LT(std::fabs(io::volume_balance(rail)), 1e-9);
  EXPECT_LT(std::fabs(io::work_balance(rail)), kSolver);
  EXPECT_GT(rail.max_depth, 1e-6);
  // each wheel makes half of the passages; between the first and the last place all of them go over every cell
  for (const auto& [j, row] : rail.record.passages.rows())
    for (int i = 0; i < rail.cells.nu; ++i) {
      if (rail.cells.u(i) < 0.01 || rail.cells.u(i) > 0.15) continue;
      EXPECT_LE(row[static_cast<std::size_t>(i)], 3e5 * (1.0 + 1e-9));
    }
  std::string worn = passage;
  const auto shape = worn.find("shape.standard = \"60E1\""), end = worn.find("[track]", shape);
  worn.replace(shape, end - shape, "shape.file = \"" + path("out") + "/" + rail.surface_file + "\"\n");
  folder_.write("worn.toml", worn);
  run_program({"simulate", path("worn.toml"), "-o", path("simulated"), "--quiet"});
  const io::SimulationResult again = io::read_simulation(path("simulated") + "/simulation.h5");
  for (const io::NamedValue& value : again.summary)
    if (value.name == "q_max_N") {
      EXPECT_NEAR(value.value, number(result.generations.back(), "q_max_N"), 1e-3 * value.value);
    }
}

/// A wheel falls into a squat and strikes its far edge: forces, Tγ and damage are largest there, and a squat that wears
/// there strikes harder.
TEST_F(SimulatedEvolution, SquatSuffersAtItsFarEdge) {
  const io::EvolutionFile file =
      io::read_evolution_file(fs::path(TREADMARK_SOURCE_DIR) / "examples/growing-squat.toml",
                              std::vector<std::string>{"evolve.updates=1", "evolve.passages=5e4"});
  const io::EvolutionResult result = app::run_evolution(file, {path("out"), false, {}});
  ASSERT_EQ(result.status, "complete") << result.message;
  const io::EvolvedBody& rail = result.generations.back().bodies.front();
  constexpr double kFarEdge = 0.35;  // [m]; the squat ends there
  double most = 0.0, at = 0.0;
  for (const auto& [j, row] : rail.record.damage.rows())
    for (int i = 0; i < rail.cells.nu; ++i)
      if (const double damage = row[static_cast<std::size_t>(i)]; damage > most) most = damage, at = rail.cells.u(i);
  EXPECT_NEAR(at, kFarEdge, 6e-3);
  EXPECT_GT(most, 0.05);
  const io::SimulationResult first = io::read_simulation(path("out") + "/" + io::simulation_file(0, 0, 1));
  for (const io::NamedValue& value : first.summary)
    if (value.name == "q_max_x_m") {
      EXPECT_NEAR(value.value, kFarEdge, 12e-3);
    }
  EXPECT_GT(number(result.generations.back(), "q_max_N"), number(result.generations.front(), "q_max_N"));
  EXPECT_LT(std::fabs(io::volume_balance(rail)), 1e-9);
}

TEST_F(SimulatedEvolution, SaysWhatIsWrongAndWhere) {
  const auto passage = [&](const char* from, const char* to) {
    return error(io::replaced(kPassage, from, to), kStudy);
  };
  EXPECT_EQ(error(kPassage, kStudy), "");
  EXPECT_THAT(passage("contact = \"full\"", "contact = \"table\""), HasSubstr("must be one that evolves"));
  EXPECT_THAT(passage("contact = \"full\"", "contact = \"full\"\ndefects = false"),
              HasSubstr("must be one that evolves"));
  EXPECT_THAT(passage("distance_m = 0.16", "distance_m = 3"), HasSubstr("more than one turn"));
  EXPECT_THAT(passage("pitch_deg = [-7", "position_m = [0.1]\n# [-7"), HasSubstr("keeps no contacts"));
  EXPECT_THAT(passage("flats = [{ shape = \"fresh\", length_mm = 60 }]\n", ""),
              HasSubstr("is that of the other wheels too"));
  const std::string rail = io::replaced(kStudy, "evolve.wheel", "evolve.rail");
  EXPECT_THAT(error(kPassage, io::replaced(rail, "distance_km", "passages")),
              HasSubstr("also used by tables of contact"));
  // Two wheelsets of two radii, one behind the other.
  std::string two = io::samples::kVehicle;
  for (const auto& [from, to] :
       {std::pair{"position_m = [0, 0, -1]", "positions_m = [[0.9, 0, -1], [-0.9, 0, -1]]"},
        {"position_m = [0, 0, -0.46]", "positions_m = [[0.9, 0, -0.46], [-0.9, 0, -0.44]]"},
        {"between = [\"axle\", \"mass\"]\nat_m = [[0, -1, -0.46], [0, 1, -0.46]]",
         "places = [{ between = [\"axle1\", \"mass1\"], at_m = [[0.9, -1, -0.46], [0.9, 1, -0.46]] },\n"
         "{ between = [\"axle2\", \"mass2\"], at_m = [[-0.9, -1, -0.44], [-0.9, 1, -0.44]] }]"},
        {"between = [\"axle\", \"mass\"]\nat_m = [[0, 0, -0.6]]",
         "places = [{ between = [\"axle1\", \"mass1\"], at_m = [[0.9, 0, -0.6]] },\n"
         "{ between = [\"axle2\", \"mass2\"], at_m = [[-0.9, 0, -0.6]] }]"},
        {"body = \"axle\"\nnominal_radius_mm = 460",
         "body = \"axle1\"\nnominal_radius_mm = 460\n[[wheelsets]]\nbody = \"axle2\"\nnominal_radius_mm = 440"}})
    two = io::replaced(two, from, to);
  folder_.write("vehicle.toml", two);
  EXPECT_THAT(passage("[case]", "[[simulation.wheels]]\nwheelset = 2\nside = \"right\"\ncontact = \"full\"\n[case]"),
              HasSubstr("wheels of 460 mm and of 440 mm evolve"));
}

}  // namespace
}  // namespace treadmark::testing
