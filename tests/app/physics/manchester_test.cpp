// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/stability/eigenmodes.hpp"
#include "treadmark/tests/solvers/vehicle/axle_beam.hpp"

namespace treadmark::app {
namespace {

const std::string kExample = std::string(TREADMARK_SOURCE_DIR) + "/examples/flat-at-speed.toml";

io::SimulationFile example(std::vector<std::string> overrides) { return io::read_simulation_file(kExample, overrides); }

double value(const std::vector<io::NamedValue>& values, const std::string& name) {
  for (const io::NamedValue& v : values)
    if (v.name == name) return v.value;
  ADD_FAILURE() << "no " << name;
  return 0.0;
}

double column(const io::SimulationResult& r, std::size_t row, const std::string& name) {
  return r.values[row * r.columns.size() + io::column_index(r, name)];
}

TEST(Manchester, StandsOnItsWheelsWith54p55Kilonewton) {
  SurfaceStore store;
  const io::SimulationResult r = static_results(example({"simulation.wheels.0.contact=table"}), store, {});
  constexpr double kLoad = 44482.0 * 9.81 / 8.0;
  for (int set = 1; set <= 4; ++set) {
    EXPECT_NEAR(value(r.statics, "wheelset" + std::to_string(set) + ".load_N"), 2.0 * kLoad, 1.0);
    for (const char* side : {"_left", "_right"})
      EXPECT_NEAR(value(r.statics, "ws" + std::to_string(set) + side + ".Q_N"), kLoad, 10.0);
  }
  EXPECT_NEAR(kLoad, 54.55e3, 5.0);
}

/// Heavy bodies on soft springs move by themselves: frequencies by hand, damping left out.
TEST(Manchester, EigenfrequenciesByHand) {
  SurfaceStore store;
  const auto file =
      example({"simulation.wheels.0.contact=table", "vehicle.scale_damping=1e-3", "track_model.scale_damping=1e-3"});
  BuiltVehicle built = build_vehicle(file, store);
  const vehicle::Equilibrium e = vehicle::find_equilibrium(built.vehicle);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  const auto modes = vehicle::eigenmodes(built.vehicle, e.state);
  const auto frequency = [&](const std::string& most, double share) {
    for (const auto& m : modes)
      if (built.vehicle.system.coordinates[static_cast<std::size_t>(m.shares[0].first)].name.starts_with(most) &&
          m.shares[0].second > share)
        return m.frequency;
    ADD_FAILURE() << "no mode of " << most;
    return 0.0;
  };
  const auto hertz = [](double stiffness, double mass) {
    return std::sqrt(stiffness / mass) / (2.0 * std::numbers::pi);
  };
  // The car on 4 secondary springs in series with the primary ones of both bogies.
  const double secondary = 4 * 0.43e6, primary = 16 / 2.0 * 1.22e6;
  EXPECT_NEAR(frequency("car.z", 0.9), hertz(secondary * primary / (secondary + primary), 32000.0), 0.02);
  const double pitch_secondary = secondary * 9.5 * 9.5, pitch_primary = primary * 9.5 * 9.5;
  EXPECT_NEAR(frequency("car.pitch", 0.9),
              hertz(pitch_secondary * pitch_primary / (pitch_secondary + pitch_primary), 1.97e6), 0.03);
  // Bogies bounce between their springs, both alike.
  double bounce = 0.0;
  for (const auto& m : modes) {
    const std::string& name = built.vehicle.system.coordinates[static_cast<std::size_t>(m.shares[0].first)].name;
    if (name.starts_with("bogie") && name.ends_with(".z") && bounce == 0.0) bounce = m.frequency;
  }
  EXPECT_NEAR(bounce, hertz(4 * 1.22e6 + 2 * 0.43e6, 2615.0), 0.15);
}

struct Kick {
  const char* coordinate;
  double displacement, rate;
};
const std::vector<Kick> kKicks{
    {"car.z", 0.02, 0.0}, {"bogie1.y", 0.0, 0.05}, {"wheelset1.z", 0.0, 0.02}, {"wheelset3.yaw", 1e-4, 0.0}};

/// Nothing excites it but its own displacement from equilibrium. contact_share: of the turnover that contacts may lose
/// or gain.
void check_energy_of_a_free_run(std::vector<std::string> overrides, double tolerance, double contact_share,
                                const std::vector<Kick>& kicks = kKicks) {
  SurfaceStore store;
  const auto file = example(overrides);
  BuiltVehicle built = build_vehicle(file, store);
  vehicle::SystemState start = vehicle::find_equilibrium(built.vehicle).state;
  for (const Kick& kick : kicks) {
    const auto& coordinates = built.vehicle.system.coordinates;
    const auto found = ranges::find(coordinates, kick.coordinate, &vehicle::Coordinate::name);
    ASSERT_NE(found, coordinates.end()) << kick.coordinate;
    start.q[found - coordinates.begin()] += kick.displacement;
    start.v[found - coordinates.begin()] += kick.rate;
  }
  vehicle::SimulationSettings settings = integration_settings(file);
  settings.position_tolerance = tolerance;
  vehicle::Simulation s(built.vehicle, start, settings);
  while (!s.finished()) s.advance();
  const vehicle::EnergyBalance& e = s.energy();
  EXPECT_GT(e.turnover, 10.0);
  EXPECT_GT(e.dampers, 1.0);
  EXPECT_GT(e.friction, 1.0);
  EXPECT_LT(std::abs(e.integration_error(s.energy_at_start())), 1e-4 * e.turnover);
  EXPECT_LT(std::abs(e.contact_error(s.energy_at_start())), contact_share * e.turnover);
}

/// 50 m of straight, a transition of 50 m and a curve without irregularities.
io::SimulationFile into_a_curve(double radius, double cant, double speed) {
  const std::vector<std::string> overrides{"simulation.distance_m=150"};
  io::SimulationFile file =
      io::read_simulation_file(std::string(TREADMARK_SOURCE_DIR) + "/examples/curve.toml", overrides);
  file.irregularities.reset();
  file.settings.speed = speed;
  file.settings.profile = {{0.0}, {speed}};
  file.settings.duration = file.settings.distance / speed;
  const double curvature = 1.0 / radius;
  cant = std::copysign(cant, radius);
  std::vector<LayoutElement>& elements = file.layout->elements;
  elements[1].length = 50.0;
  elements[1].curvature.to = curvature, elements[1].cant.to = cant;
  elements[2].curvature = {curvature, curvature}, elements[2].cant = {cant, cant};
  return file;
}

/// A start in a tight curve is the steady state of a run into it: forces of the rails within a per cent of those of a
/// wheel at rest.
TEST(Manchester, StartsInTightCurvesWhereARunIntoThemEnds) {
  constexpr double kLoad = 44482.0 * 9.81 / 8.0;
  io::SimulationFile file = into_a_curve(-250.0, 0.1, 12.0);
  SurfaceStore store;
  ContactTables tables;
  BuiltVehicle run = build_vehicle(file, store, &tables);
  vehicle::SimulationSettings settings = integration_settings(file);
  settings.position_tolerance = 1e-6;
  vehicle::Simulation s(run.vehicle, vehicle::find_equilibrium(run.vehicle).state, settings);
  while (!s.finished()) s.advance();

  file.start += file.settings.distance;
  const BuiltVehicle started = build_vehicle(file, store, &tables);
  const vehicle::Equilibrium e = vehicle::find_equilibrium(started.vehicle);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  EXPECT_LT(e.residual, 1e-5);
  for (std::size_t i = 0; i < e.reactions.size(); ++i) {
    const Vec3 found = e.reactions[i].on_rail.force, ran = s.reactions()[i].on_rail.force;
    EXPECT_NEAR((found - ran).norm(), 0.0, 0.01 * kLoad)
        << i << ": " << found.transpose() << " and " << ran.transpose();
  }
}

/// Eight full contacts in a tight curve, with the friction that Y/Q of the inner leading wheel tells: forces are those
/// that a published comparison of programs has of Universal Mechanism (docs/vehicle-simulation.md), and flanges lose no
/// work.
TEST(Manchester, GuidesItselfInATightCurveAsPublished) {
  constexpr double kPublished[4][4] = {// vertical left and right, lateral left and right [kN]
                                       {54.4, 55.1, 32.2, -23.1},
                                       {39.9, 68.7, 1.5, -21.9},
                                       {49.3, 59.2, 19.9, -25.1},
                                       {44.3, 64.9, 4.1, -10.8}};
  constexpr double kVertical = 1.5, kLateral = 1.0;  // [kN]
  io::SimulationFile file = into_a_curve(150.0, 0.1, 4.4);
  file.start = 205.0;
  file.settings.distance = 0.01;
  file.settings.duration = file.settings.distance / file.settings.speed;
  file.track.reset();
  file.contact.friction.kinetic = 0.42;
  file.contact.tangential_model = TangentialModel::fastsim;
  for (io::WheelContactInput& wheel : file.wheels) wheel.model = io::ContactModelInput::full;
  SurfaceStore store;
  ContactTables tables;
  BuiltVehicle built = build_vehicle(file, store, &tables);
  const vehicle::Equilibrium e = vehicle::find_equilibrium(built.vehicle, {}, built.easy ? &*built.easy : nullptr);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  for (std::size_t i = 0; i < e.reactions.size(); ++i) {
    const vehicle::WheelOnRail& wheel = built.vehicle.wheels[i];
    const std::size_t right = wheel.side == wheelrail::Side::right;
    const double(&row)[4] = kPublished[wheel.wheelset];
    const Vec3 force = 1e-3 * e.reactions[i].on_rail.force;
    EXPECT_NEAR(force.z(), row[right], kVertical) << wheel.name;
    EXPECT_NEAR(-force.y(), row[2 + right], kLateral) << wheel.name;
  }
  vehicle::Simulation s(built.vehicle, e.state, integration_settings(file));
  while (!s.finished()) s.advance();
  EXPECT_GT(s.energy().drive, 10.0);
  EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-3 * s.energy().turnover);
}

TEST(Manchester, EnergyOfAFreeRunIsBalanced) {
  check_energy_of_a_free_run({"simulation.wheels.0.contact=table", "simulation.distance_m=20"}, 2e-10, 1e-6);
}

const std::string kFlexible =
    "simulation.vehicle=" + std::string(TREADMARK_SOURCE_DIR) + "/examples/vehicles/manchester-flexible.toml";

TEST(Manchester, EnergyOfAFreeRunIsBalancedWithFlexibleWheelsets) {
  check_energy_of_a_free_run({"simulation.wheels.0.contact=table", "simulation.distance_m=5", kFlexible}, 2e-10, 1e-4,
                             {{"wheelset1.z", 0.0, 0.1},
                              {"bogie1.y", 0.0, 0.1},
                              {"wheelset1.bending1_vertical", 0.0, 0.5},
                              {"wheelset2.bending2_horizontal", 0.0, 0.5},
                              {"wheelset4.torsion1", 0.0, 1.0}});
}

TEST(Manchester, EnergyOfAFreeRunIsBalancedWithFullContact) {
  check_energy_of_a_free_run({"simulation.wheels.0.defects=false", "simulation.distance_m=1", "case.regime=steady"},
                             1e-9, 1e-4);
}

/// The shipped numbers are those of the beam that the file describes, and the rest of the vehicle is manchester.toml.
TEST(ManchesterFlexible, HasTheModesOfItsBeam) {
  const VehicleModel rigid = example({}).vehicle, flexible = example({kFlexible}).vehicle;
  double polar = 0.0;
  const testing::AxleBeam beam = testing::manchester_axle(&polar);
  EXPECT_NEAR(beam.total_mass(), 1813.0, 1e-9);
  EXPECT_NEAR(beam.transverse_inertia(), 1120.0, 1e-9);
  EXPECT_NEAR(beam.polar_inertia(), 112.0, 1e-9);
  const FlexibleAxle expected = beam.axle(1.5, polar, {-1.0, -0.75, 0.75, 1.0}, 3, 1, 0.005);
  for (const WheelsetSpec& wheelset : flexible.wheelsets) {
    const FlexibleAxle& axle = wheelset.axle.value();
    EXPECT_EQ(axle.wheel_distance, expected.wheel_distance);
    EXPECT_EQ(axle.places, expected.places);
    EXPECT_NEAR(axle.wheel_polar_inertia, polar, 1e-3);
    ASSERT_EQ(axle.bending.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const BendingMode &found = axle.bending[i], &wanted = expected.bending[i];
      EXPECT_NEAR(found.mass / wanted.mass, 1.0, 1e-5) << i;
      EXPECT_NEAR(found.stiffness / wanted.stiffness, 1.0, 2e-5) << i;
      EXPECT_NEAR(found.damping / wanted.damping, 1.0, 2e-5) << i;
      for (std::size_t place = 0; place < 4; ++place) {
        EXPECT_NEAR(found.shape[place], wanted.shape[place], 1e-5) << i << ' ' << place;
        EXPECT_NEAR(found.slope[place], wanted.slope[place], 1e-5) << i << ' ' << place;
      }
    }
    ASSERT_EQ(axle.torsion.size(), 1u);
    EXPECT_NEAR(axle.torsion[0].inertia / expected.torsion[0].inertia, 1.0, 1e-5);
    EXPECT_NEAR(axle.torsion[0].stiffness / expected.torsion[0].stiffness, 1.0, 2e-5);
    EXPECT_NEAR(axle.torsion[0].wheel_rotation[0], -1.0, 1e-6);
  }
  ASSERT_EQ(flexible.bodies.size(), rigid.bodies.size());
  for (std::size_t i = 0; i < rigid.bodies.size(); ++i) {
    const BodySpec &a = flexible.bodies[i], &b = rigid.bodies[i];
    EXPECT_EQ(std::tie(a.name, a.mass, a.inertia, a.position, a.free),
              std::tie(b.name, b.mass, b.inertia, b.position, b.free));
  }
  ASSERT_EQ(flexible.springs.size(), rigid.springs.size());
  for (std::size_t i = 0; i < rigid.springs.size(); ++i) {
    const SpringSpec &a = flexible.springs[i], &b = rigid.springs[i];
    EXPECT_EQ(std::tie(a.name, a.body_a, a.body_b, a.position, a.stiffness, a.damping, a.damper_stiffness),
              std::tie(b.name, b.body_a, b.body_b, b.position, b.stiffness, b.damping, b.damper_stiffness));
  }
  ASSERT_EQ(flexible.bump_stops.size(), rigid.bump_stops.size());
  for (std::size_t i = 0; i < rigid.bump_stops.size(); ++i) {
    const BumpStopSpec &a = flexible.bump_stops[i], &b = rigid.bump_stops[i];
    EXPECT_EQ(std::tie(a.name, a.body_a, a.body_b, a.position, a.direction, a.displacement, a.force),
              std::tie(b.name, b.body_a, b.body_b, b.position, b.direction, b.displacement, b.force));
  }
}

/// One passage of the flat in each representation of the wheel: the same forces within 2 % of the largest.
TEST(FlatAtSpeed, RepresentationsGiveTheSameForces) {
  const std::vector<std::string> common{"simulation.distance_m=0.36", "simulation.wheels.0.pitch_deg=25",
                                        "discretisation.dx_mm=1.0", "discretisation.ds_mm=1.0"};
  const auto run = [&](const std::string& backend) {
    std::vector<std::string> overrides = common;
    if (!backend.empty()) {
      overrides.push_back("wheel.backend=" + backend);
      overrides.push_back("wheel.resolution_mm=1.0");
    }
    SurfaceStore store;
    io::SimulationResult r = run_simulation(example(overrides), store, {}, {});
    EXPECT_EQ(r.status, "complete") << r.message;
    return r;
  };
  const io::SimulationResult truth = run("");
  const double q_max = value(truth.summary, "q_max_N");
  EXPECT_GT(q_max, 80e3);
  // At instants of its own each: compared at the same distance.
  const auto at = [](const io::SimulationResult& r, double x) {
    std::size_t row = 1;
    while (row + 1 < r.rows() && column(r, row, "x_m") < x) ++row;
    const double x0 = column(r, row - 1, "x_m"), x1 = column(r, row, "x_m"), share = (x - x0) / (x1 - x0);
    return (1.0 - share) * column(r, row - 1, "Q_N") + share * column(r, row, "Q_N");
  };
  for (const std::string backend : {"spline", "mesh", "offset"}) {
    const io::SimulationResult r = run(backend);
    double worst = 0.0;
    for (double x = 0.01; x < 0.36; x += 0.5e-3) worst = std::max(worst, std::abs(at(r, x) - at(truth, x)));
    EXPECT_LT(worst, 0.02 * q_max) << backend;
    EXPECT_NEAR(value(r.summary, "q_max_N"), q_max, 0.01 * q_max) << backend;
  }
}

}  // namespace
}  // namespace treadmark::app
