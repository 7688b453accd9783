// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"
#include "treadmark/tests/support/refusal.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

ContactTables::Table any_table() {
  const vehicle::ContactUnderLoad contact{1e-4, 1.0, 0.0, 0.0, 0.4, {{1.0, 0.0, 0.0, 0.4, 1e-4, 0.0}}};
  const vehicle::ContactTableColumns columns{{-1e-3, {contact}}, {1e-3, {contact}}};
  return std::make_shared<const vehicle::ContactTable>(std::vector<vehicle::ContactTableColumns>{columns},
                                                       vehicle::ContactTable::Loads{{1e5}}, wheelrail::Problem{},
                                                       wheelrail::Placement{});
}

TEST(ContactTables, OneIsMadeForEveryContact) {
  ContactTables tables;
  std::atomic<int> made{0};
  const auto make = [&] { return ++made, any_table(); };
  const wheelrail::Problem p;
  const ContactTables::Table first = tables.get("a", p, 1e5, make);
  EXPECT_EQ(tables.get("a", p, 1e5, make), first);
  wheelrail::Problem moved = p;  // what a table does not depend on
  moved.state.velocity.x = 70.0;
  moved.regime = kalker::Regime::transient;
  moved.discretisation.dx = 0.2e-3;
  EXPECT_EQ(tables.get("a", moved, 1e5, make), first);
  EXPECT_EQ(made, 1);

  wheelrail::Problem canted = p, soft = p, slippery = p, finer = p;
  canted.track.cant = 0.025;
  soft.material.shear_modulus_1 *= 0.5;
  slippery.friction.kinetic = 0.1;
  finer.solver.eps *= 0.1;
  for (const wheelrail::Problem& other : {canted, soft, slippery, finer})
    EXPECT_NE(tables.get("a", other, 1e5, make), first);
  EXPECT_NE(tables.get("a", p, 1.1e5, make), first);
  EXPECT_NE(tables.get("b", p, 1e5, make), first);
  EXPECT_EQ(made, 7);
}

TEST(ContactTables, ThreadsWaitForTheOneThatMakesIt) {
  ContactTables tables;
  std::atomic<int> made{0};
  std::vector<ContactTables::Table> got(4);
  std::vector<std::thread> threads;
  for (ContactTables::Table& table : got)
    threads.emplace_back([&] {
      table = tables.get("a", {}, 1e5, [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return ++made, any_table();
      });
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(made, 1);
  for (const ContactTables::Table& table : got) EXPECT_EQ(table, got.front());
}

TEST(ContactTables, AfterAnErrorTheNextOneTries) {
  ContactTables tables;
  EXPECT_THROW(tables.get("a", {}, 1e5, []() -> ContactTables::Table { throw Error(ErrorKind::numerical, "no"); }),
               Error);
  EXPECT_NE(tables.get("a", {}, 1e5, any_table), nullptr);
}

TEST(ContactTables, FilesCountByWhatIsInThem) {
  testing::SampleSimulation input;
  fs::copy_file(input.path("rail.prr"), input.path("other.prr"));
  const auto key = [&](const char* file) {
    io::SurfaceSource rail;
    io::GeometryFile geometry;
    geometry.file = input.path(file);
    rail.geometry = geometry;
    SurfaceStore store;
    return store.content_key(rail, Body::rail, 0.0);
  };
  const std::string before = key("other.prr");
  EXPECT_EQ(key("other.prr"), before);
  std::ofstream(input.path("other.prr"), std::ios::app) << "\n";
  EXPECT_NE(key("other.prr"), before);
}

TEST(ContactTables, AVehicleFromAKeptTableIsTheSame) {
  testing::SampleSimulation input;
  ContactTables tables;
  const auto forces = [&](ContactTables* from, const char* speed) {
    const std::vector<std::string> settings{std::string("simulation.speed_m_s=") + speed};
    const io::SimulationFile file = io::read_simulation_file(input.path("simulation.toml"), settings);
    SurfaceStore store;
    const BuiltVehicle built = build_vehicle(file, store, from);
    const vehicle::Equilibrium e = vehicle::find_equilibrium(built.vehicle);
    std::vector<double> out;
    for (const vehicle::ContactReaction& r : e.reactions)
      out.push_back(r.on_rail.force.y()), out.push_back(r.normal_force);
    return out;
  };
  forces(&tables, "20");
  EXPECT_EQ(forces(&tables, "30"), forces(nullptr, "30"));
}

constexpr double kTorque = 4000.0;  // on each axle [N m]

/// Two wheelsets below a guided load, driven; wheels: contact of all of them, as they are named.
std::string driven_on(const testing::SampleSimulation& input, const std::array<double, 2>& radius_mm,
                      const std::string& contact, const std::string& wheel = "shape.standard = \"S1002\"") {
  std::string vehicle =
                  "[vehicle]\nname = \"two radii\"\n[[bodies]]\nname = \"load\"\nmass_kg = 16000\n"
                  "position_m = [0, 0, -1]\nfree = [\"z\"]\n",
              simulation = "[simulation]\nvehicle = \"two.toml\"\nspeed_m_s = 5\ndistance_m = 0.06\n";
  for (int i = 0; i < 2; ++i) {
    const double x = i == 0 ? 0.9 : -0.9, radius = radius_mm.at(static_cast<std::size_t>(i));
    vehicle += fmt::format(
        "[[bodies]]\nname = \"axle{0}\"\nmass_kg = 1800\ninertia_kg_m2 = [1100, 110, 1100]\nposition_m = [{1}, 0, "
        "{2}]\nfree = [\"z\", \"roll\", \"pitch\"]\n[[wheelsets]]\nbody = \"axle{0}\"\nnominal_radius_mm = {3}\n"
        "[[springs]]\nname = \"primary{0}\"\nbetween = [\"axle{0}\", \"load\"]\nat_m = [[{1}, -1, {2}], [{1}, 1, "
        "{2}]]\nstiffness_N_per_m = [30e6, 4e6, 1.2e6]\ndamping_N_s_per_m = [0, 0, 40e3]\n",
        i + 1, x, -1e-3 * radius, radius);
    simulation += fmt::format(
        "[[simulation.torques]]\nwheelset = {}\ntime_s = [0, 0.003]\ntorque_N_m = [0, {}]\nreaction = \"ground\"\n",
        i + 1, kTorque);
    for (const char* side : {"left", "right"})
      simulation +=
          fmt::format("[[simulation.wheels]]\nwheelset = {}\nside = \"{}\"\ncontact = \"{}\"\n", i + 1, side, contact);
  }
  input.write("two.toml", vehicle);
  input.write("driven.toml", simulation + "[wheel]\n" + wheel +
                                 "\n[rail]\nshape.standard = \"60E1\"\n[case]\nregime = \"steady\"\n"
                                 "[friction]\ncoefficient = 0.3\n[discretisation]\ndx_mm = 1.5\nds_mm = 1.5\n");
  return input.path("driven.toml");
}

/// A column at the end.
double last_of(const io::SimulationResult& r, const std::string& name) {
  return r.values[r.values.size() - r.columns.size() + io::column_index(r, name)];
}

TEST(WheelsOfTwoRadii, HaveContactsOfTheirOwn) {
  const testing::SampleSimulation input;
  ContactTables tables;
  const auto run = [&](const std::array<double, 2>& radius_mm, const std::string& contact) {
    const io::SimulationFile file = io::read_simulation_file(driven_on(input, radius_mm, contact), {});
    SurfaceStore store;
    SimulationOptions options;
    options.tables = &tables;
    io::SimulationResult r = run_simulation(file, store, options, {});
    EXPECT_EQ(r.status, "complete") << r.message;
    return r;
  };
  // What turns an axle goes into its rails over its own radius.
  using Radii = std::array<double, 2>;
  for (const auto& [contact, radius_mm] :
       {std::pair{"table", Radii{460.0, 400.0}}, {"table", Radii{400.0, 460.0}}, {"full", Radii{460.0, 300.0}}}) {
    const io::SimulationResult r = run(radius_mm, contact);
    for (int set = 0; set < 2; ++set) {
      const double left = last_of(r, set == 0 ? "Tx_N" : "ws2_left.Tx_N"),
                   right = last_of(r, fmt::format("ws{}_right.Tx_N", set + 1)),
                   force = kTorque / (1e-3 * radius_mm.at(static_cast<std::size_t>(set)));
      EXPECT_NEAR(std::abs(left + right), force, 0.005 * force) << contact << ' ' << set;
    }
  }
  // Contacts are those of a vehicle all of whose wheels are as large.
  const auto pressure = [&](const Radii& radius_mm, const char* wheel) {
    return last_of(run(radius_mm, "full"), std::string(wheel) + ".pmax_Pa");
  };
  const double small = pressure({400.0, 400.0}, "ws2_right"), large = pressure({460.0, 460.0}, "ws2_right");
  EXPECT_GT(small, 1.01 * large);
  EXPECT_NEAR(pressure({460.0, 400.0}, "ws2_right"), small, 0.002 * small);
  EXPECT_NEAR(pressure({400.0, 460.0}, "ws2_right"), large, 0.002 * large);
}

TEST(WheelsOfTwoRadii, AreSoInCasesOfTheirWheels) {
  const testing::SampleSimulation input;
  const io::SimulationFile file = io::read_simulation_file(driven_on(input, {460.0, 400.0}, "full"), {});
  const io::WheelRailCase first = contact_input(file, file.wheels[1]), second = contact_input(file, file.wheels[3]);
  EXPECT_EQ(first.wheelset.nominal_radius, file.contact.wheelset.nominal_radius);
  EXPECT_DOUBLE_EQ(second.wheelset.nominal_radius, 0.4);
  EXPECT_DOUBLE_EQ(second.state.velocity.pitch, -5.0 / 0.4);
}

TEST(WheelsOfTwoRadii, ShareNoShapeWithARadiusOfItsOwn) {
  const testing::SampleSimulation input;
  input.write("wheel.ply", "ply\n");
  const auto refusal = [&](const std::array<double, 2>& radius_mm, const std::string& wheel) {
    return testing::refusal_of(
        [&] {
          const io::SimulationFile file = io::read_simulation_file(driven_on(input, radius_mm, "full", wheel), {});
          SurfaceStore store;
          check_vehicle(file, store);
        },
        ErrorKind::configuration);
  };
  EXPECT_THAT(refusal({460.0, 400.0}, "shape.file = \"wheel.ply\""),
              ::testing::HasSubstr("wheelset 1 have a radius of 460 mm and those of wheelset 2 400 mm"));
}

}  // namespace
}  // namespace treadmark::app
