// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

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

}  // namespace
}  // namespace treadmark::app
