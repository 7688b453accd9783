// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/evolve/passed_patches.hpp"
#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/files/replaced.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/simulations/evolve_keys.hpp"
#include "treadmark/io/simulations/read_evolution.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/model/contact/hertz_ellipse.hpp"
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"
#include "treadmark/tests/app/evolve/wheel_law.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/io/results/vtk_values.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A cylinder of 460 mm on a crown of 300 mm that spins too slowly by a tenth: one ellipse that slips everywhere.
const std::string kHertz = R"([wheel]
shape.start_y_mm = -60
shape.arcs = [{ length_mm = 120, curvature_per_m = 0 }]
[rail]
shape.standard = "60E1"
[track]
cant_rad = 0.0
[wheelset]
y_mm = 0
vertical_force_N = 60e3
velocity_m_s = 2
vpitch_rad_s = -3.9130434782608696
[material]
shear_modulus_GPa = 82.0
poisson_ratio = 0.28
[friction]
coefficient = 0.05
[discretisation]
dx_mm = 0.4
ds_mm = 0.4
)";

class Evolution : public ::testing::Test {
 protected:
  io::EvolutionFile file(const std::string& base, const std::string& evolve, const std::string& more = {}) {
    folder_.write("base.toml", base);
    return io::read_evolution_file(folder_.write("study.toml", "[evolve]\nbase = \"base.toml\"\n" + evolve + more));
  }
  std::string error(const std::string& base, const std::string& evolve, const std::string& more = {}) {
    std::string message;
    const std::string thrown = error_of([&] {
      const io::EvolutionFile read = file(base, evolve, more);
      message = run(read).message;
    });
    return thrown + message;
  }
  io::EvolutionResult run(const io::EvolutionFile& file, const std::string& out = "out") {
    fs::remove_all(folder_.path() / out);
    return app::run_evolution(file, {folder_.path() / out, false, {}});
  }

  TemporaryFolder folder_;
};

const std::string kFatigue = R"(
[evolve.wheel.fatigue]
measures = ["fi_surf", "shakedown", "whole_life", "subsurface", "dang_van"]
source = "guessed"
shear_yield_MPa = 300
depths_mm = [1.0, 2.0, 4.0]
dang_van_slope = 0.3
dang_van_limit_MPa = 250
t_gamma_N = [15, 65, 175]
damage_per_passage = [0, 1e-5, 0]
)";

const std::string kFlow = R"(
[evolve.wheel.flow]
theory = "ratchetting"
source = "invented"
shear_yield_MPa = 120
strain_per_cycle = 0.00237
depths_mm = [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 10.0, 14.0]
)";

/// Depth of the rows of a body.
std::vector<double> depths(const io::EvolvedBody& body) {
  std::vector<double> out;
  for (int j = 0; j < body.cells.ny; ++j) out.push_back(damage::depth_of(body.cells, body.record.volume.at(0, j), j));
  return out;
}

/// Archard's depth in full slip below Hertz's pressure: k / H times slip speed and time, times the integral of the
/// pressure along the row, over the circumference.
TEST_F(Evolution, FullSlipBelowAnEllipseWearsByTheClosedForm) {
  const double seconds = 1e3 / 2.0, slip_speed = 0.2;
  const auto result =
      run(file(kHertz, "distance_km = 1\nupdates = 1\n[evolve.wheel]\nsmoothing_mm = 0\ndy_mm = 0.4\n", kLaw));
  ASSERT_EQ(result.status, "complete") << result.message;
  ASSERT_EQ(result.generations.size(), 2u);
  const io::EvolvedBody& wheel = result.generations.back().bodies.front();
  const double radius = 0.46;
  const HertzEllipse ellipse =
      hertz_by_force(0.5 / radius, 0.5 / 0.3, result.generations.front().cases.front().fn, 82e9 / 0.72);
  EXPECT_NEAR(result.generations.front().cases.front().pmax, ellipse.largest_pressure(),
              0.01 * ellipse.largest_pressure());
  const double along = 0.5 * std::numbers::pi * ellipse.largest_pressure() * ellipse.semi_axis_x;
  const double expected = 1e-4 / 3e9 * slip_speed * along * seconds / (2.0 * std::numbers::pi * radius);
  const std::vector<double> found = depths(wheel);
  const auto deepest = ranges::max_element(found) - found.begin();
  EXPECT_NEAR(found[static_cast<std::size_t>(deepest)], expected, 0.01 * expected);
  double middle = 0.0, all = 0.0;  // of the contact: the centre of what is removed
  for (int j = 0; j < wheel.cells.ny; ++j) {
    middle += found[static_cast<std::size_t>(j)] * wheel.cells.y(j);
    all += found[static_cast<std::size_t>(j)];
  }
  middle /= all;
  for (int j = 0; j < wheel.cells.ny; ++j) {
    const double y = (wheel.cells.y(j) - middle) / ellipse.semi_axis_y;
    if (std::fabs(y) > 0.8) continue;
    EXPECT_NEAR(found[static_cast<std::size_t>(j)], expected * (1.0 - y * y), 0.02 * expected) << y;
  }
  EXPECT_LT(std::fabs(io::volume_balance(wheel)), 1e-9);
  EXPECT_LT(std::fabs(io::work_balance(wheel)), 1e-6);
  // Archard's volume is k / H times the work over the coefficient of friction, where everything slips
  EXPECT_NEAR(wheel.record.volume.sum(), 1e-4 / 3e9 / 0.05 * wheel.record.work.sum(), 1e-6 * wheel.record.volume.sum());
}

/// Full slip below an ellipse: what the whole patch does follows from Hertz, what points have seen from its pressure.
TEST_F(Evolution, FatigueOfAnEllipseIsThatOfHertz) {
  const auto result = run(file(kHertz, "distance_km = 1\nupdates = 1\n[evolve.wheel]\ndy_mm = 0.4\n", kLaw + kFatigue));
  ASSERT_EQ(result.status, "complete") << result.message;
  const io::Generation& first = result.generations.front();
  const double k = 300e6, friction = 0.05, force = first.cases.front().fn;
  const HertzEllipse ellipse = hertz_by_force(0.5 / 0.46, 0.5 / 0.3, force, 82e9 / 0.72);
  const double p0 = ellipse.largest_pressure();
  const ContactFatigue& contact = first.bodies.front().fatigue.contacts.front();
  EXPECT_NEAR(contact.friction, friction, 1e-3 * friction);
  EXPECT_NEAR(contact[FatigueMeasure::fi_surf], friction - k / p0,
              0.03 * k / p0);  // the area of contact is counted in elements
  EXPECT_NEAR(contact.pressure_ratio, p0 / k, 0.01 * p0 / k);
  EXPECT_NEAR(contact[FatigueMeasure::shakedown], contact.pressure_ratio / 3.772, 1e-3);
  const double t_gamma = first.cases.front().t_gamma;
  EXPECT_NEAR(t_gamma, friction * force * 0.2 / 1.9, 0.002 * t_gamma);  // slip speed over the mean of both surfaces
  EXPECT_NEAR(contact[FatigueMeasure::whole_life], 1e-5 * (175.0 - t_gamma) / 110.0,
              1e-9 * std::fabs(contact[FatigueMeasure::whole_life]));

  const io::EvolvedBody& wheel = result.generations.back().bodies.front();
  const SurfaceRecord& record = wheel.record;
  double deepest = 0.0;
  int middle = 0;
  for (const auto& [j, row] : record.pressure.rows())
    if (row.front() > deepest) deepest = row.front(), middle = j;
  EXPECT_NEAR(record.damage.at(0, middle), contact[FatigueMeasure::whole_life] * record.passages.at(0, middle),
              1e-9 * std::fabs(record.damage.at(0, middle)));
  EXPECT_NEAR(record.t_gamma.at(0, middle), t_gamma, 1e-9 * t_gamma);
  EXPECT_EQ(record.fi_surf.rows().size(), 0u);  // below 0
  ASSERT_EQ(record.stresses.size(), 3u);
  // 2 mm is 0.4 half-axes deep: shear there is 0.21 to 0.25 of the largest pressure (circle, line), von Mises 0.55 to
  // 0.62
  EXPECT_GT(record.stresses[1].shakedown.at(0, middle), 0.20 * p0);
  EXPECT_LT(record.stresses[1].shakedown.at(0, middle), 0.26 * p0);
  EXPECT_GT(record.stresses[1].von_mises.at(0, middle), 0.53 * p0);
  EXPECT_LT(record.stresses[1].von_mises.at(0, middle), 0.65 * p0);
  // Dang Van: shear less a part of the pressure
  EXPECT_LT(record.stresses[1].dang_van.at(0, middle), record.stresses[1].shear.at(0, middle));
  EXPECT_GT(record.stresses[1].dang_van.at(0, middle), 0.0);
  const io::Generation again = io::read_generation(folder_.path() / "out" / io::generation_file(1));
  EXPECT_EQ(again.bodies.front().record.stresses[2].shear.rows(), record.stresses[2].shear.rows());
  EXPECT_EQ(again.bodies.front().fatigue.contacts.front()[FatigueMeasure::fi_surf],
            wheel.fatigue.contacts.front()[FatigueMeasure::fi_surf]);
}

/// What the surface has reached is what the solver says of the contact; friction heats a wheel that slips all over by
/// the closed form of Ertz and Knothe 2002 within its elements.
TEST_F(Evolution, TemperaturesTellOfMartensite) {
  const std::string heat = "[heat]\ncompute = true\n";
  const std::string measure =
      "[evolve.wheel.fatigue]\nmeasures = [\"martensite\"]\nsource = \"guessed\"\naustenite_C = 40\n";
  const std::string evolve = "distance_km = 1\nupdates = 1\n[evolve.wheel]\ndy_mm = 0.4\n";
  const auto result = run(file(kHertz + heat, evolve, kLaw + measure));
  ASSERT_EQ(result.status, "complete") << result.message;
  const auto number = [](const io::Generation& g, const std::string& name) {
    for (const io::EvolutionQuantity& q : io::quantities_of(g))
      if (q.name == name) return q.value;
    return std::nan("");
  };
  const auto contacts = app::run_cases(io::parse_case_text(kHertz + heat, folder_.path() / "again.toml"));
  const io::PatchResult& patch = contacts.cases.front().patches.front();
  EXPECT_NEAR(number(result.generations.front(), "wheel_temperature_C"), *patch.max_temperature_2, 1e-9);
  const SurfaceRecord& record = result.generations.back().bodies.front().record;
  double largest = 0.0;
  for (const auto& [j, row] : record.temperature.rows()) largest = std::max(largest, row.front());
  EXPECT_NEAR(largest, *patch.max_temperature_2, 1e-9);
  EXPECT_NEAR(number(result.generations.back(), "wheel_over_austenite_ever_K"), largest - 40.0, 1e-9);
  // two half-spaces of equal effusivity b share the heat q of an ellipse: along its middle row
  // theta(s) = 1/(2 b sqrt(pi)) integral of q(t) / sqrt(s - t), of p0 sqrt(1 - x^2) largest where that integral is
  const HertzEllipse ellipse =
      hertz_by_force(0.5 / 0.46, 0.5 / 0.3, contacts.cases.front().patches.front().fn, 82e9 / 0.72);
  const double effusivity = std::sqrt(50.0 * 7850.0 * 450.0), a = ellipse.semi_axis_x, speed = 1.9;
  const double flux = 0.05 * ellipse.largest_pressure() * 0.2;
  double shape = 0.0;
  for (double s = 0.01; s < 2.0; s += 0.01) {
    double sum = 0.0;
    constexpr int kParts = 400;  // t = s - u^2 takes the root away
    for (int i = 0; i < kParts; ++i) {
      const double u = (i + 0.5) * std::sqrt(s) / kParts, x = s - u * u - 1.0;
      sum += 2.0 * std::sqrt(std::max(0.0, 1.0 - x * x)) * std::sqrt(s) / kParts;
    }
    shape = std::max(shape, sum);
  }
  const double expected = flux * std::sqrt(a / speed) * shape / (2.0 * effusivity * std::sqrt(std::numbers::pi));
  EXPECT_NEAR(largest, expected, 0.03 * expected);

  EXPECT_THAT(error(kHertz, evolve, kLaw + measure), HasSubstr("martensite needs the temperatures of contacts"));
  EXPECT_THAT(error(kHertz + heat, evolve, kLaw + io::replaced(measure, "austenite_C = 40\n", "")),
              HasSubstr("evolve.wheel.fatigue.austenite_C is missing"));
  EXPECT_THAT(error(io::replaced(kHertz, "velocity_m_s = 2\n", "") + heat, evolve, kLaw + measure),
              HasSubstr("must move and turn"));
}

/// A wheel that slides to the right drags the rail's material to the right and its own to the left. How far is summed
/// up anew, with stresses at points: the first moment of the volume is the flux of a passage times passages and way.
TEST_F(Evolution, MaterialFlowsAlongTheTraction) {
  const auto of_rail = [](std::string text) { return text.replace(text.find("wheel"), 5, "rail"); };
  const std::string still = io::replaced(kLaw, "1e-4", "0");
  std::string base = io::replaced(kHertz, "coefficient = 0.05", "coefficient = 0.3");
  base = io::replaced(base, "vpitch_rad_s = -3.9130434782608696", "vpitch_rad_s = -4.3478260869565215\nvy_m_s = 0.2");
  const double passages = 20.0, turn = 2.0 * std::numbers::pi * 0.46;
  const auto result =
      run(file(base,
               "distance_km = " + std::to_string(1e-3 * passages * turn) +
                   "\npassages = 20\nupdates = 1\n[evolve.wheel]\ndy_mm = 0.4\n[evolve.rail]\ndy_mm = 0.4\n",
               still + of_rail(still) + kFlow + of_rail(kFlow)));
  ASSERT_EQ(result.status, "complete") << result.message;
  const auto contacts = app::run_cases(io::parse_case_text(base, folder_.path() / "again.toml"));
  const io::PatchResult& patch = contacts.cases.front().patches.front();
  ASSERT_GT(patch.fs, 0.25 * patch.fn);
  const io::EvolvingBody law = file(base, "distance_km = 1\n[evolve.wheel]\n", still + kFlow).bodies.front();
  for (const io::EvolvedBody& body : result.generations.back().bodies) {
    const bool rail = body.body == Body::rail;
    double moment = 0.0;
    const Grid2& grid = patch.fields.grid;
    for (int iy = -grid.ny; iy < 2 * grid.ny; ++iy) {
      double before = 0.0, z_before = 0.0;
      for (std::size_t depth = 0; depth < law.flow.depths.size(); ++depth) {
        const double z = law.flow.depths[depth];
        std::vector<Vec3> points;
        for (int ix = -grid.nx; ix < 2 * grid.nx; ++ix)
          points.emplace_back(grid.x0 + ix * grid.dx, grid.y0 + iy * grid.dy, rail ? z : -z);
        double forward = 0.0, back = 0.0;
        for (const auto& p : kalker::subsurface_stress(
                 {grid, patch.fields.pressure, patch.fields.traction_x, patch.fields.traction_s}, Material{}, points)) {
          const double size = std::hypot(p.stress(0, 2), p.stress(1, 2));
          const double over = size > 120e6 ? (size / 120e6 - 1.0) / size * (rail ? -1.0 : 1.0) * p.stress(1, 2) : 0.0;
          forward = std::max(forward, over), back = std::max(back, -over);
        }
        const double here = z * 0.00237 * (forward - back);
        moment += 0.5 * (here + before) * (z - z_before) * grid.dy;
        before = here, z_before = z;
      }
    }
    moment *= passages * (rail ? 1.0 : turn);
    double found = 0.0, moved = 0.0;
    for (const auto& [j, row] : body.record.volume.rows()) {
      found -= row.front() * body.cells.y(j);
      moved += 0.5 * std::fabs(row.front());
    }
    EXPECT_EQ(found > 0.0, rail);
    EXPECT_NEAR(found, moment, 0.03 * std::fabs(moment)) << rail;
    EXPECT_NEAR(body.record.volume.sum(), 0.0, 1e-12 * moved);
    EXPECT_GT(body.flow.max_raised, 1e-7);
    const io::Generation again = io::read_generation(folder_.path() / "out" / io::generation_file(1));
    const io::EvolvedBody& read = again.bodies[rail ? 1 : 0];
    EXPECT_EQ(read.flow.theory + read.flow.source, "ratchettinginvented");
    EXPECT_EQ(read.record.flow[2].strain.rows(), body.record.flow[2].strain.rows());
  }
}

/// Shear below the yield moves nothing; pressure alone shears points both ways along, and presses them out across.
TEST_F(Evolution, MaterialIsElasticBelowItsYield) {
  const std::string still = io::replaced(kLaw, "1e-4", "0");
  const auto strong = run(file(kHertz, "distance_km = 1\nupdates = 1\n[evolve.wheel]\ndy_mm = 0.4\n",
                               still + io::replaced(kFlow, "= 120", "= 400")));
  ASSERT_EQ(strong.status, "complete") << strong.message;
  EXPECT_EQ(strong.generations.back().bodies.front().max_depth, 0.0);
  EXPECT_EQ(strong.generations.back().bodies.front().flow.max_raised, 0.0);
  const std::string rolling =
      io::replaced(kHertz, "vpitch_rad_s = -3.9130434782608696", "vpitch_rad_s = -4.3478260869565215");
  const auto pressed =
      run(file(rolling, "distance_km = 0.1\nupdates = 1\n[evolve.wheel]\ndy_mm = 0.4\n", still + kFlow));
  ASSERT_EQ(pressed.status, "complete") << pressed.message;
  const io::EvolvedBody& wheel = pressed.generations.back().bodies.front();
  double centre = 0.0, spread = 0.0, lost = 0.0;
  for (const auto& [j, row] : wheel.record.volume.rows()) {
    if (row.front() > 0.0) lost += row.front(), centre += row.front() * wheel.cells.y(j);
  }
  ASSERT_GT(lost, 0.0);
  centre /= lost;
  for (const auto& [j, row] : wheel.record.volume.rows())
    spread -= row.front() * std::pow(wheel.cells.y(j) - centre, 2);
  EXPECT_GT(spread, 0.0);  // outwards
}

/// Tractions on the bodies are opposite: below an ellipse that slips along x all over, stresses are mirror images.
TEST_F(Evolution, WheelAndRailEndureTheSame) {
  const auto of_rail = [](std::string text) { return text.replace(text.find("wheel"), 5, "rail"); };
  const auto result = run(file(kHertz, "distance_km = 1\npassages = 1000\nupdates = 1\n[evolve.wheel]\n[evolve.rail]\n",
                               kLaw + of_rail(kLaw) + kFatigue + of_rail(kFatigue)));
  ASSERT_EQ(result.status, "complete") << result.message;
  const auto& bodies = result.generations.back().bodies;
  for (std::size_t depth = 0; depth < 3; ++depth) {
    const auto largest = [&](std::size_t b) {
      double most = 0.0;
      for (const auto& [j, row] : bodies[b].record.stresses[depth].von_mises.rows()) most = std::max(most, row.front());
      return most;
    };
    EXPECT_GT(largest(0), 100e6);
    EXPECT_NEAR(largest(0), largest(1), 1e-3 * largest(1)) << depth;
  }
}

TEST_F(Evolution, HistoriesOfAWholeWheelTakeTheMemoryThatIsStated) {
  // 0.5 mm along and across, a band of 60 mm that contacts have reached, stresses at one depth
  SurfaceRecord record(5781, 1);
  for (int j = 0; j < 120; ++j) {
    for (const auto& row : kSheets) (record.*row.sheet).ref(0, j) = 1.0;
    for (const auto& row : kStressSheets) (record.stresses.front().*row.sheet).ref(0, j) = 1.0;
  }
  std::cout << "memory of the histories [MB]: " << 1e-6 * static_cast<double>(record.memory_bytes()) << '\n';
  EXPECT_EQ(record.memory_bytes(), 14u * 120u * 5781u * sizeof(double));
  EXPECT_LT(record.memory_bytes(), 300u * 1000u * 1000u);
}

/// What workshops measure follows the section: the flange height grows by what the tread loses, and a wheelset of two
/// worn wheels has the conicity that the geometry of the worn surface file has.
TEST_F(Evolution, WheelsAreMeasuredOverTheDistance) {
  const auto result =
      run(file(standard_case("1.0"), "distance_km = 2000\nupdates = 2\nfields_every = 0\n[evolve.wheel]\n",
               io::replaced(kLaw, "1e-4", "1e-2")));
  ASSERT_EQ(result.status, "complete") << result.message;
  const auto number = [](const io::Generation& g, const std::string& name) {
    for (const io::EvolutionQuantity& q : io::quantities_of(g))
      if (q.name == name) return q.value;
    return std::nan("");
  };
  const io::Generation &first = result.generations.front(), &last = result.generations.back();
  EXPECT_NEAR(number(first, "wheel_flange_height_mm"), 28.0, 0.01);
  EXPECT_NEAR(number(first, "wheel_flange_thickness_mm"), 32.5, 0.01);
  EXPECT_EQ(number(first, "wheel_hollow_mm"), 0.0);
  const io::EvolvedBody& wheel = last.bodies.front();
  int tape = 0;
  for (int j = 0; j < wheel.cells.ny; ++j)
    if (std::fabs(wheel.cells.y(j)) < 0.5 * wheel.cells.dy) tape = j;
  const double lost = 1e3 * damage::depth_of(wheel.cells, wheel.record.volume.at(0, tape), tape);
  ASSERT_GT(lost, 0.003);
  EXPECT_NEAR(number(last, "wheel_flange_height_mm") - number(first, "wheel_flange_height_mm"), lost, 1e-3);

  const std::string worn =
      standard_case("1.0", "shape.file = \"" + (folder_.path() / "out" / wheel.surface_file).string() + "\"\n");
  const std::string path = folder_.write("worn.toml", worn);
  const std::string out = folder_.path() / "geometry";
  const ProgramResult geometry = run_program({"geometry", path, "-o", out});
  ASSERT_EQ(geometry.status, 0) << geometry.err;
  const double conicity =
      nlohmann::json::parse(std::ifstream(fs::path(out) / "geometry.json"))["geometry"]["conicity_3mm"];
  EXPECT_NEAR(number(last, "wheel_conicity_3mm"), conicity, 1e-3 * conicity);
  EXPECT_NE(number(first, "wheel_conicity_3mm"), number(last, "wheel_conicity_3mm"));
  const io::Generation again = io::read_generation(folder_.path() / "out" / io::generation_file(2));
  EXPECT_EQ(number(again, "wheel_conicity_3mm"), number(last, "wheel_conicity_3mm"));
}

TEST_F(Evolution, GenerationsAreSurfacesThatOtherCommandsUse) {
  const auto result =
      run(file(standard_case("1.0"), "distance_km = 2000\nupdates = 2\nfields_every = 2\n[evolve.wheel]\n", kLaw));
  ASSERT_EQ(result.status, "complete") << result.message;
  const io::EvolvedBody& wheel = result.generations.back().bodies.front();
  EXPECT_EQ(wheel.surface_file, "wheel_0002.vdb");
  EXPECT_GT(wheel.max_depth, 5e-6);
  const std::string file = "shape.file = \"" + (folder_.path() / "out" / wheel.surface_file).string() + "\"\n";
  const auto again = app::run_cases(io::parse_case_text(standard_case("1.0", file), folder_.path() / "again.toml"));
  double pmax = 0.0;
  for (const io::PatchResult& patch : again.cases.front().patches) pmax = std::max(pmax, patch.pmax);
  EXPECT_NEAR(pmax, result.generations.back().cases.front().pmax, 1e-6 * pmax);
  EXPECT_TRUE(fs::exists(folder_.path() / "out" / "contacts_0002.h5"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out" / "contacts_0001.h5"));
  for (const io::Generation& g : result.generations)
    for (const io::EvolutionQuantity& q : io::quantities_of(g))
      if (q.name == "wheel_volume_balance") {
        EXPECT_LT(std::fabs(q.value), 1e-9);
      }
  EXPECT_EQ(result.generations[1].bodies.front().record.memory_bytes(), 0u);  // the file has them
  EXPECT_GT(io::read_generation(folder_.path() / "out" / io::generation_file(1)).bodies.front().record.memory_bytes(),
            0u);
}

/// ParaView's files have the surface where it is, with what it has endured.
TEST_F(Evolution, WritesSurfacesForParaView) {
  folder_.write("base.toml", standard_case("1.0"));
  const std::string study = folder_.write("study.toml",
                                          "[evolve]\nbase = \"base.toml\"\ndistance_km = 2000\nupdates = "
                                          "2\nfields_every = 0\n[evolve.wheel]\n" +
                                              io::replaced(kLaw, "1e-4", "1e-2") + kFatigue);
  const fs::path out = folder_.path() / "out";
  ASSERT_EQ(run_program({"evolve", study, "-o", out, "--vtk", "--quiet"}).status, 0);
  const XmlElement collection = read_xml(content_of(out / "vtk" / "evolution.pvd"));
  const auto entries = collection.find("DataSet");
  ASSERT_EQ(entries.size(), 2u);  // nothing has changed at first
  EXPECT_EQ(entries[1]->attributes.at("timestep"), "2000");
  ASSERT_EQ(entries[1]->attributes.at("file"), "wheel_0002.vts");
  const XmlElement root = read_xml(content_of(out / "vtk" / "wheel_0002.vts"));
  const io::Generation last = io::read_generation(out / io::generation_file(2));
  const io::EvolvedBody& wheel = last.bodies.front();
  const auto depth = vtk_values<float>(root, "depth_m");
  const auto points = vtk_values<double>(root, "points_m");
  constexpr std::size_t kParts = 72;
  const std::size_t rows = depth.size() / kParts;
  ASSERT_EQ(points.size(), 3 * (kParts + 1) * (rows + 1));
  EXPECT_NEAR(*ranges::max_element(depth), wheel.max_depth, 1e-6 * wheel.max_depth);
  const auto radius = [&](std::size_t k, std::size_t i) {
    const double* p = points.data() + 3 * (k * (kParts + 1) + i);
    return std::hypot(p[0], p[2]);
  };
  for (std::size_t k = 0; k < rows; ++k) {
    const double y = 0.5 * (points[3 * k * (kParts + 1) + 1] + points[3 * (k + 1) * (kParts + 1) + 1]);
    const int j = static_cast<int>(std::lround((y - wheel.cells.y0) / wheel.cells.dy));
    EXPECT_NEAR(y, wheel.cells.y(j), 1e-12);
    EXPECT_NEAR(0.5 * (radius(k, 5) + radius(k + 1, 5)), 0.46 + wheel.z[static_cast<std::size_t>(j)],
                2e-6 + 0.02 * wheel.max_depth);  // curvature within a row
    EXPECT_NEAR(radius(k, 5), radius(k, 60), 1e-12);
  }
  EXPECT_EQ(vtk_values<float>(root, "depth_1_shear_Pa").size(), depth.size());
  const auto pressure = vtk_values<float>(root, "pressure_Pa");
  double largest = 0.0;
  for (const auto& [j, row] : wheel.record.pressure.rows()) largest = std::max(largest, row.front());
  EXPECT_NEAR(*ranges::max_element(pressure), largest, 1e-6 * largest);
}

TEST_F(Evolution, LeftAndRightEvolveAlike) {
  const std::string evolve = "distance_km = 100\nupdates = 1\n[evolve.wheel]\n";
  const std::string right = standard_case("1.0") + "[[cases]]\nwheelset.y_mm = 2\nwheelset.yaw_deg = 0.2\n";
  const std::string left =
      standard_case("1.0") + "[case]\nside = \"left\"\n[[cases]]\nwheelset.y_mm = -2\nwheelset.yaw_deg = -0.2\n";
  const std::string laws = kLaw + io::replaced(kFlow, "0.00237", "1e-6");
  const auto one = run(file(right, evolve, laws)), other = run(file(left, evolve, laws));
  ASSERT_EQ(one.status + other.status, "completecomplete") << one.message << other.message;
  EXPECT_GT(one.generations.back().bodies.front().flow.max_raised, 1e-8);
  const auto a = depths(one.generations.back().bodies.front()), b = depths(other.generations.back().bodies.front());
  ASSERT_GT(*ranges::max_element(a), 0.0);
  for (std::size_t j = 0; j < a.size(); ++j) EXPECT_NEAR(a[j], b[j], 1e-9 * *ranges::max_element(a));
}

/// The rail's own cells: volume and work of both bodies follow from the same contacts.
TEST_F(Evolution, BothBodiesWearByTheSameWork) {
  std::string rail_law = kLaw;
  rail_law.replace(rail_law.find("wheel"), 5, "rail");
  const auto result =
      run(file(standard_case("1.0"), "distance_km = 1\npassages = 1000\nupdates = 1\n[evolve.wheel]\n[evolve.rail]\n",
               kLaw + rail_law));
  ASSERT_EQ(result.status, "complete") << result.message;
  const auto& bodies = result.generations.back().bodies;
  ASSERT_EQ(bodies.size(), 2u);
  // 1000 m of rolling, and 1000 passages over a metre of rail
  const double wheel = bodies[0].record.work.sum(), rail = bodies[1].record.work.sum();
  EXPECT_NEAR(wheel, rail, 1e-9 * rail);
  EXPECT_NEAR(bodies[0].record.volume.sum(), bodies[1].record.volume.sum(), 1e-9 * rail);
  EXPECT_EQ(bodies[1].surface_file, "rail_0001.vdb");
}

/// Explicit updates: halving them halves the error.
TEST_F(Evolution, UpdatesConvergeWithOrderOne) {
  std::vector<std::vector<double>> found;
  for (const int updates : {2, 4, 8, 16}) {
    const auto result = run(
        file(kHertz, "distance_km = 2\nupdates = " + std::to_string(updates) + "\nfields_every = 0\n[evolve.wheel]\n",
             kLaw));
    ASSERT_EQ(result.status, "complete") << result.message;
    found.push_back(depths(result.generations.back().bodies.front()));
  }
  std::vector<double> steps;
  for (std::size_t k = 0; k + 1 < found.size(); ++k) {
    double difference = 0.0;
    for (std::size_t j = 0; j < found[k].size(); ++j)
      difference = std::max(difference, std::fabs(found[k][j] - found[k + 1][j]));
    steps.push_back(difference);
  }
  std::cout << "differences of depth [um]: " << 1e6 * steps[0] << ' ' << 1e6 * steps[1] << ' ' << 1e6 * steps[2]
            << '\n';
  EXPECT_NEAR(std::log2(steps[0] / steps[1]), 1.0, 0.4);
  EXPECT_NEAR(std::log2(steps[1] / steps[2]), 1.0, 0.4);
}

/// Finer elements come to Archard's closed form: volume is k / H times force and way of sliding, whatever the shape.
TEST_F(Evolution, ElementsConverge) {
  const double way = 0.2 * 1e3 / 2.0, expected = 1e-4 / 3e9 * way;
  std::vector<double> errors, found;
  for (const char* element : {"0.8", "0.4", "0.2"}) {
    std::string base = kHertz;
    for (const char* key : {"dx_mm = ", "ds_mm = "})
      base = io::replaced(base, key + std::string("0.4"), key + std::string(element));
    const auto result = run(file(
        base, "distance_km = 1\nupdates = 1\nfields_every = 0\n[evolve.wheel]\nsmoothing_mm = 0\ndy_mm = 0.4\n", kLaw));
    ASSERT_EQ(result.status, "complete") << result.message;
    const double volume = result.generations.back().bodies.front().record.volume.sum();
    errors.push_back(std::fabs(volume / (expected * 60e3) - 1.0));
    found.push_back(result.generations.back().bodies.front().max_depth);
  }
  std::cout << "errors of volume: " << errors[0] << ' ' << errors[1] << ' ' << errors[2] << '\n';
  EXPECT_LT(errors[0], 1e-3);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_GT(std::log2(errors[k] / errors[k + 1]), 0.8);
    EXPECT_NEAR(found[k], found[2], 2e-3 * found[2]);
  }
}

/// Every generation sampled anew as a spline: the same evolution but for the error of the fit.
TEST_F(Evolution, SplinesOfEveryGenerationEvolveAlike) {
  const std::string evolve = "distance_km = 2000\nupdates = 3\nfields_every = 0\n[evolve.wheel]\n";
  const auto offsets = run(file(standard_case("1.0"), evolve, kLaw));
  const auto splines = run(file(
      standard_case("1.0", "shape.standard = \"S1002\"\nbackend = \"spline\"\nresolution_mm = 0.5\n"), evolve, kLaw));
  ASSERT_EQ(offsets.status + splines.status, "completecomplete");
  const auto a = depths(offsets.generations.back().bodies.front()),
             b = depths(splines.generations.back().bodies.front());
  const double deepest = *ranges::max_element(a);
  for (std::size_t j = 0; j < a.size(); ++j) EXPECT_NEAR(a[j], b[j], 0.01 * deepest);
  const double p = offsets.generations.back().cases.front().pmax, q = splines.generations.back().cases.front().pmax;
  EXPECT_NE(p, q);
  EXPECT_NEAR(p, q, 1e-3 * p);
}

std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != "lock") out[entry.path().filename().string()] = content_of(entry.path());
  return out;
}

TEST_F(Evolution, GoesOnAfterAKillToTheSameBytes) {
  folder_.write("base.toml", standard_case("1.0"));
  const std::string study =
      folder_.write("study.toml", "[evolve]\nbase = \"base.toml\"\ndistance_km = 2000\nupdates = 5\n[evolve.wheel]\n" +
                                      kLaw + kFatigue + io::replaced(kFlow, "0.00237", "1e-7"));
  const std::string one = folder_.path() / "one", two = folder_.path() / "two";
  ASSERT_EQ(run_program({"evolve", study, "-o", one, "--quiet"}).status, 0);
  RunningProgram killed({"treadmark", "evolve", study, "-o", two});
  while (killed.running() && !fs::exists(fs::path(two) / "generation_0002.h5"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  killed.send(SIGKILL);
  killed.wait();
  const ProgramResult rest = run_program({"evolve", study, "-o", two, "--resume", "--threads", "1"});
  ASSERT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("distance_km"));
  const auto a = contents(one), b = contents(two);
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, bytes] : a) EXPECT_TRUE(b.contains(name) && b.at(name) == bytes) << name;
  EXPECT_THAT(run_program({"evolve", study, "-o", two, "--set", "evolve.distance_km=3"}).err,
              HasSubstr("another evolution"));
  const ProgramResult full =
      RunningProgram({"sh", "-c", "\"$0\" --quiet evolve \"$1\" -o \"$2\" > /dev/full", "treadmark", study, two})
          .wait();
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.err, HasSubstr("could not be written to standard output"));
  if (has_part("report")) {
    const std::string page = folder_.path() / "page.html";
    ASSERT_EQ(run_program({"report", two, "-o", page}).status, 0);
    for (const char* part : {"Over the generations", "Section at the chosen generation", "assumed", "generation 5"})
      EXPECT_THAT(content_of(page), HasSubstr(part));
  }
  const auto json = nlohmann::json::parse(a.at("evolution.json"));
  EXPECT_EQ(json["generations"].size(), 6u);
  EXPECT_EQ(json["laws"][0]["source"], "assumed");
}

/// Limits of an update: none of them is exceeded, and everything is reached.
TEST_F(Evolution, StepsKeepTheLimits) {
  const auto result = run(file(
      kHertz, "distance_km = 100\nmax_depth_mm = 0.02\nmax_pressure_change = 0.05\nfields_every = 0\n[evolve.wheel]\n",
      kLaw));
  ASSERT_EQ(result.status, "complete") << result.message;
  ASSERT_GT(result.generations.size(), 3u);
  for (std::size_t k = 1; k < result.generations.size(); ++k) {
    const io::Generation &before = result.generations[k - 1], &after = result.generations[k];
    EXPECT_LE(after.bodies[0].max_depth - before.bodies[0].max_depth, 0.0201e-3);
    EXPECT_TRUE(!after.limits_kept || after.pressure_change <= 0.05);
  }
  EXPECT_DOUBLE_EQ(result.generations.back().distance, 100e3);
  EXPECT_LT(result.generations.back().cases.front().pmax, result.generations.front().cases.front().pmax);
}

/// Full slip at some 6 W/mm2: the severe regime of Krause and Poll, whose volume is 21e-10 kg by J of steel; the damage
/// of the whole-life model falls from 65 N on.
TEST_F(Evolution, TakesLawsByName) {
  const std::string head = "distance_km = 1\nupdates = 1\n[evolve.wheel]\ndy_mm = 0.4\n";
  const auto result = run(file(kHertz, head, "law = \"krause-poll\"\nfatigue = \"burstow-r220\"\n"));
  ASSERT_EQ(result.status, "complete") << result.message;
  const io::EvolvedBody& wheel = result.generations.back().bodies.front();
  EXPECT_THAT(wheel.source, HasSubstr("krause-poll: Krause and Poll 1986"));
  const double volume = 21e-10 / 7850.0 * wheel.record.work.sum();
  EXPECT_NEAR(wheel.record.volume.sum(), volume, 2e-5 * volume);
  const double t_gamma = result.generations.front().cases.front().t_gamma;
  const double damage = result.generations.front().bodies.front().fatigue.contacts.front()[FatigueMeasure::whole_life];
  EXPECT_NEAR(damage, 1e-5 * (175.0 - t_gamma) / 110.0, 1e-9 * std::fabs(damage));

  const auto remarks = nlohmann::json::parse(app::evolution_json(result))["remarks"];
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_EQ(remarks[0]["name"], "unverified_law");
  EXPECT_THAT(remarks[0]["text"].get<std::string>(), HasSubstr("law of the wheel: krause-poll"));
  EXPECT_THAT(remarks[1]["text"].get<std::string>(), HasSubstr("burstow-r220"));

  const std::string rail = "passages = 3\n[evolve.rail]\n", set[] = {"evolve.rail.law=british-rail"};
  file(kHertz, rail, "law = \"jendel\"\n");
  EXPECT_EQ(io::read_evolution_file(folder_.path() / "study.toml", set).bodies.front().law.patch_t_gamma.size(), 5u);
  try {
    file(kHertz, rail, "law = \"jendl\"\n");
    ADD_FAILURE() << "a law that nobody knows";
  } catch (const Error& misspelt) {
    EXPECT_THAT(misspelt.what(), HasSubstr("study.toml:5:7: law 'jendl' is not known (did you mean 'jendel'?)"));
  }
  EXPECT_THAT(error(kHertz, rail, "law = \"burstow-r220\"\n"), HasSubstr("law 'burstow-r220' is not known"));
  EXPECT_THAT(error(kHertz, rail, "law = 3\n"), HasSubstr("evolve.rail.law must be a table"));
}

TEST(EvolveDocs, NamedLawsAreThoseOfTheProgram) {
  for (const NamedLaw& law : named_laws())
    expect_in_document("evolve.md",
                       fmt::format("| `{}` | `{}` | {} | {} | {} | {} |\n", law.name, law.kind(), io::numbers_of(law),
                                   law.source, law.validity, law.verified ? "yes" : "no"));
}

TEST(EvolveDocs, TableOfKeysIsUpToDate) { expect_in_document("evolve.md", io::evolve_key_table()); }

TEST(EvolveExamples, AreReadAndBuilt) {
  for (const char* name : {"hollow-wheel.toml", "spread-of-rails.toml", "rounding-flat.toml", "flat-in-motion.toml",
                           "flowing-flat.toml", "tired-rail.toml", "growing-squat.toml", "growing-polygon.toml"})
    EXPECT_EQ(error_of([&] {
                app::check_evolution(io::read_evolution_file(fs::path(TREADMARK_SOURCE_DIR) / "examples" / name));
              }),
              "")
        << name;
}

TEST(Stretches, MakeUpTheTurn) {
  const auto turn = 2.0 * std::numbers::pi;
  const auto all = app::stretches({0.1, 6.2, 0.0}, Body::wheel, 0.0);
  double sum = 0.0;
  for (const auto& s : all) sum += s.end - s.begin;
  EXPECT_NEAR(sum, turn, 1e-12);
  EXPECT_NEAR(all[2].begin, 0.5 * (6.2 - turn), 1e-12);
  EXPECT_NEAR(all[2].end, 0.05, 1e-12);
  const auto rail = app::stretches({1.0, 1.2}, Body::rail, 0.5);
  EXPECT_NEAR(rail[0].begin, 0.9, 1e-12);
  EXPECT_NEAR(rail[1].end, 1.3, 1e-12);
  EXPECT_THAT(error_of([] { app::stretches({1.0, 1.0}, Body::rail, 0.5); }), HasSubstr("at one place"));
}

TEST_F(Evolution, SaysWhatIsWrongAndWhere) {
  const std::string base = standard_case("1.0"), good = "distance_km = 1\n[evolve.wheel]\n";
  EXPECT_THAT(error(base, "distance_km = 1\n[evolve.wheel]\n"),
              HasSubstr("study.toml:4:1: evolve.wheel.law is missing"));
  EXPECT_THAT(error(base, "distance_km = 1\n"), HasSubstr("nothing evolves"));
  EXPECT_THAT(error(base, "[evolve.wheel]\n", kLaw), HasSubstr("evolve.distance_km is missing"));
  EXPECT_THAT(error(base, "passages = 3\n" + good, kLaw), HasSubstr("evolve.passages needs evolve.rail"));
  EXPECT_THAT(error(base, "weights = [1, 2]\n" + good, kLaw), HasSubstr("2 values for 1 positions"));
  EXPECT_THAT(error(base, "updates = 3\nmax_depth_mm = 0.1\n" + good, kLaw), HasSubstr("max_depth_mm"));
  const auto law = [&](const char* from, const char* to) { return error(base, good, io::replaced(kLaw, from, to)); };
  EXPECT_THAT(law("hardness_GPa = 3.0", "hardness_GPa = -3.0"),
              HasSubstr("study.toml:9:16: evolve.wheel.law.hardness_GPa"));
  EXPECT_THAT(law("hardness_GPa = 3.0\n", ""), HasSubstr("evolve.wheel.law.hardness_GPa is missing"));
  EXPECT_THAT(law("archard", "archrd"), HasSubstr("study.toml:7:10"));
  EXPECT_THAT(law("source = \"assumed\"\n", ""), HasSubstr("evolve.wheel.law.source is missing"));
  EXPECT_THAT(law("k = [1e-4]", "k = [1e-4, 2e-4]"), HasSubstr("k has 2 values"));
  EXPECT_THAT(law("k = [1e-4]", "kk = [1e-4]"), HasSubstr("unknown key 'evolve.wheel.law.kk'"));
  EXPECT_THAT(
      error(base, "distance_km = 1\n[[evolve.vary]]\nkey = \"wheelset.y_m\"\nvalues = [1]\n[evolve.wheel]\n", kLaw),
      HasSubstr("study.toml:6:11: run 1 (wheelset.y_m = 1): unknown key 'wheelset.y_m'"));
  EXPECT_THAT(error(base + "[case]\nregime = \"shift\"\n", good, kLaw), HasSubstr("must roll"));
  const auto fatigue = [&](const char* from, const char* to) {
    return error(base, good, kLaw + io::replaced(kFatigue, from, to));
  };
  EXPECT_THAT(fatigue("shear_yield_MPa = 300\n", ""),
              HasSubstr("study.toml:12:1: evolve.wheel.fatigue.shear_yield_MPa is missing"));
  EXPECT_THAT(fatigue("shear_yield_MPa = 300", "shear_yield_MPa = -300"), HasSubstr("study.toml:15:19"));
  EXPECT_THAT(fatigue("\"shakedown\"", "\"shakdown\""), HasSubstr("study.toml:13:12: measure 'shakdown' is not known"));
  EXPECT_THAT(fatigue("source = \"guessed\"\n", ""), HasSubstr("evolve.wheel.fatigue.source is missing"));
  EXPECT_THAT(fatigue("[1.0, 2.0, 4.0]", "[2.0, 1.0]"), HasSubstr("depths_mm must increase"));
  EXPECT_THAT(fatigue("[1.0, 2.0, 4.0]", "[0.2]"), HasSubstr("0.2 mm below elements of 1 mm"));
  EXPECT_THAT(error(base, "distance_km = 1e6\nupdates = 1\n[evolve.wheel]\nsmoothing_mm = 0\n", kLaw),
              HasSubstr("would fold"));
  const auto flow = [&](const char* from, const char* to) {
    return error(base, "distance_km = 200\nupdates = 1\n[evolve.wheel]\n", kLaw + io::replaced(kFlow, from, to));
  };
  EXPECT_THAT(flow("shear_yield_MPa = 120\n", ""),
              HasSubstr("study.toml:13:1: evolve.wheel.flow.shear_yield_MPa is missing"));
  EXPECT_THAT(flow("shear_yield_MPa = 120", "shear_yield_MPa = -120"), HasSubstr("study.toml:16:19"));
  EXPECT_THAT(flow("source = \"invented\"\n", ""), HasSubstr("evolve.wheel.flow.source is missing"));
  EXPECT_THAT(flow("\"ratchetting\"", "\"ratcheting\""), HasSubstr("study.toml:14:10"));
  EXPECT_THAT(flow("[1.0, 1.5, 2.0,", "[2.0, 1.5, 1.0,"), HasSubstr("depths_mm must be positive and increase"));
  EXPECT_THAT(flow("0.00237", "0.00237\nhardening_rate = 3"),
              HasSubstr("hardening_factor and hardening_rate go together"));
  EXPECT_THAT(flow("[1.0, 1.5, 2.0,", "[0.4, 1.5, 2.0,"), HasSubstr("0.4 mm below elements of 1 mm"));
  EXPECT_THAT(flow("depths_mm = [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 10.0, 14.0]", "depths_mm = [1, 2]"),
              HasSubstr("the material flows at 2 mm, the deepest of depths_mm"));
  EXPECT_THAT(flow("invented", "guessed"), HasSubstr("would fold"));
}

}  // namespace
}  // namespace treadmark::testing
