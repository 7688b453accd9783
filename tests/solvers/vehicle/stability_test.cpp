// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/stability/stability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "small_vehicles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"
#include "treadmark/solvers/vehicle/stability/falling_speed.hpp"

namespace treadmark::vehicle {
namespace {

using wheelrail::Side;

/// A wheelset with conical wheels on two edges, held by a lateral and a yaw spring, below a load that only moves
/// vertically.
struct Wheelset {
  double conicity = 0.05, radius = 0.46, half_distance = 0.75;  // [-], [m]
  double mass = 1813.0, inertia = 1120.0, spin_inertia = 112.0, load = 9000.0;
  double lateral = 0.0, yaw = 0.0;                      // springs [N/m], [N m/rad]
  double clearance = 0.0;                               // of a stop to both sides; 0: there is none [m]
  double area = 1.1e-4, aspect = 1.3, approach = 3e-5;  // of the contact under the static load
  double weight() const { return (mass + load) * kGravity; }
};

/// Contact of a cone with an edge: the contact stays on the edge, and the cone slides up or down on it.
std::shared_ptr<const ContactTable> cone_on_edge(const Wheelset& w) {
  const double load = 0.5 * w.weight();
  ContactTableColumns columns;
  for (const double y : {-8e-3, -4e-3, 0.0, 4e-3, 8e-3}) {
    const ContactPart all{1.0, std::atan(-w.conicity), -y, w.conicity * y, w.area, std::log(w.aspect)};
    columns.push_back(
        {y, {{w.approach - w.conicity * y, 0.4 * load * w.approach, -w.conicity, -y, w.conicity * y, {all}}}});
  }
  wheelrail::Problem p;
  p.friction.kinetic = 1e4;  // no saturation
  p.wheelset.nominal_radius = w.radius;
  wheelrail::Placement nominal;
  nominal.X_TR.origin = nominal.X_TW.origin = Vec3(0.0, w.half_distance, 0.0);
  nominal.X_TWs.origin = Vec3(0.0, 0.0, -w.radius);
  return std::make_shared<ContactTable>(std::vector<ContactTableColumns>{columns}, ContactTable::Loads{{load}}, p,
                                        nominal);
}

VehicleAtSpeed on_edges(const Wheelset& w) {
  VehicleModel model = wheel_on_mass(w.mass, w.load, 1e6, 3e4);
  model.bodies[0].position.z() = -1.0;
  model.bodies[1].position.z() = -w.radius;
  model.bodies[1].inertia = {w.inertia, w.spin_inertia, w.inertia};
  model.bodies[1].free = {false, true, true, true, true, true};
  model.springs.push_back(spring(kGround, "wheelset", {0, 0, -w.radius}, {0, w.lateral, 0, 0, 0, w.yaw}));
  model.wheelsets[0].nominal_radius = w.radius;
  if (w.clearance > 0.0)
    model.bump_stops.push_back({"stop",
                                kGround,
                                "wheelset",
                                {0, 0, -w.radius},
                                Freedom::y,
                                {w.clearance, 2.0 * w.clearance},
                                {0.0, 5e6 * w.clearance},
                                {}});
  const auto table = cone_on_edge(w);
  return [=](double speed) {
    VehicleOnTrack v;
    v.speed = speed;
    v.system = assemble(model, {}, speed, kGravity);
    for (const Side side : {Side::left, Side::right})
      v.wheels.push_back({0, side, side == Side::left ? "left" : "right", std::make_shared<TableContact>(table, side),
                          Vec3(0.0, side == Side::left ? -w.half_distance : w.half_distance, 0.0)});
    v.connect();
    return v;
  };
}

/// Linear equations of the same wheelset by hand, M q'' + C q' + K q = 0 of lateral displacement y and yaw psi, with
/// Kalker's coefficients, roll phi = -sigma y by the constraint of two cones on two edges, and the difference of the
/// normal forces from the equilibrium of moments about the track (cf. Wickens 1965; terms of conicity^2 dropped).
struct ByHand {
  Eigen::Matrix2d m, c, k;

  ByHand(const Wheelset& w, double speed) {
    const CombinedMaterial steel = combine(Material{});
    const double size_squared = w.area / std::numbers::pi, size = std::sqrt(size_squared);
    const auto kalker =
        kalker::kalker_coefficients(size * std::sqrt(w.aspect), size / std::sqrt(w.aspect), steel.poisson);
    const double f11 = steel.shear_modulus * size_squared * kalker.c11,
                 f22 = steel.shear_modulus * size_squared * kalker.c22,
                 f23 = steel.shear_modulus * size_squared * size * kalker.c23;
    const double lambda = w.conicity, r = w.radius, b = w.half_distance, weight = w.weight(), n = 0.5 * weight;
    const double sigma = lambda / (b - lambda * r), effective = sigma * b, gyro = w.spin_inertia * speed / r;
    // Spin -+lambda/r of both wheels in the middle, its lateral forces +-spin, which grow with the normal force.
    const double spin = f23 * lambda / r;
    // Lateral creepage of both wheels: (1 + shift) y'/V - psi.
    const double shift = sigma * r + sigma * b * lambda;
    // t: lateral creep force of one wheel = t_y y + t_dy y' + t_psi psi + t_dpsi psi'.
    const double t_dy = -f22 * (1.0 + shift) / speed, t_psi = f22, t_dpsi = -f23 / speed;
    // Half the difference of the normal forces, right less left, from roll; phi = -sigma y.
    const double lever = 2.0 * (b - r * lambda) + 2.0 * spin * (b * lambda + r) / n, arm = 2.0 * (b * lambda + r);
    const double n_y = (weight * (1.0 + sigma * r) + 2.0 * spin * (lambda - b * sigma + r * lambda * sigma)) / lever,
                 n_ddy = w.inertia * sigma / lever, n_dy = -arm * t_dy / lever, n_psi = -arm * t_psi / lever,
                 n_dpsi = (-arm * t_dpsi - gyro) / lever;
    // m y'' + k_y y = W phi + 2 t + 2 spin lambda phi - by_n (half the difference).
    const double by_n = 2.0 * lambda - 2.0 * spin / n;
    m << w.mass + by_n * n_ddy, 0.0, 0.0, w.inertia;
    c(0, 0) = -2.0 * t_dy + by_n * n_dy;
    c(0, 1) = -2.0 * t_dpsi + by_n * n_dpsi;
    k(0, 0) = w.lateral + (weight + 2.0 * spin * lambda) * sigma + by_n * n_y;
    k(0, 1) = -2.0 * t_psi + by_n * n_psi;
    // I psi'' - gyro phi' = creep along the rails, moments of creep, normal and spin forces ahead of and behind the
    // axle.
    c(1, 0) = gyro * sigma - 2.0 * f23 * (1.0 + shift) / speed;
    c(1, 1) = 2.0 * f11 * b * b / speed;
    k(1, 0) = 2.0 * f11 * b * effective / r;
    k(1, 1) = w.yaw + 2.0 * f23 - (b - lambda * r) * (weight * lambda - 2.0 * spin);
  }

  /// Roots of the characteristic polynomial of degree four.
  std::vector<std::complex<double>> roots() const {
    Eigen::Matrix4d a;
    a << Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Identity(), -m.inverse() * k, -m.inverse() * c;
    const Eigen::Vector4cd values = a.eigenvalues();
    return {values.begin(), values.end()};
  }
  std::complex<double> hunting() const {
    const auto all = roots();
    return *ranges::max_element(all, {}, [](std::complex<double> z) { return z.imag() > 0.0 ? z.real() : -1e9; });
  }
};

double critical_by_hand(const Wheelset& w) {
  double low = 1.0, high = 500.0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (ByHand(w, middle).hunting().real() > 0.0 ? high : low) = middle;
  }
  return low;
}

/// The vibration of y and psi with the least damping.
Eigenmode hunting(const ModesAtSpeed& at) {
  Eigenmode found;
  found.value = -1e9;
  for (const Eigenmode& m : at.modes)
    if (m.frequency > 0.0 && m.frequency < 30.0 && std::abs(m.shape[1]) > 0.1 && m.value.real() > found.value.real())
      found = m;
  return found;
}

TEST(Stability, EigenvaluesOfASuspendedWheelsetAreThoseOfTheHandWrittenEquations) {
  for (const double conicity : {0.02, 0.05, 0.1}) {
    Wheelset w;
    w.conicity = conicity;
    w.lateral = 1e6;
    w.yaw = 2e6;
    for (const double speed : {5.0, 20.0, 60.0, 100.0}) {
      const ModesAtSpeed at = modes_at_speed(on_edges(w), speed);
      ASSERT_EQ(at.report.status, Status::ok) << at.report.message;
      const std::complex<double> expected = ByHand(w, speed).hunting(), found = hunting(at).value;
      EXPECT_LT(std::abs(found - expected), 0.01 * std::abs(expected)) << conicity << ' ' << speed;
    }
  }
}

TEST(Stability, CriticalSpeedOfASuspendedWheelset) {
  for (const double conicity : {0.025, 0.05, 0.1}) {
    Wheelset w;
    w.conicity = conicity;
    w.lateral = 0.5e6;
    w.yaw = 1e6;
    const double expected = critical_by_hand(w);
    StabilitySettings settings;
    for (int i = 1; i <= 10; ++i) settings.speeds.push_back(0.17 * i * expected);
    settings.speed_tolerance = 1e-3;
    const StabilityResult r = stability(on_edges(w), settings);
    ASSERT_EQ(r.verdict, StabilityVerdict::critical);
    EXPECT_LT(r.critical->error, 1e-3);
    EXPECT_NEAR(r.critical->speed, expected, 0.01 * expected);
    const Eigenmode& growing = r.critical->beyond.modes[*r.critical->beyond.fastest_growth];
    EXPECT_NEAR(2.0 * std::numbers::pi * growing.frequency, ByHand(w, expected).hunting().imag(),
                0.01 * growing.value.imag());
    EXPECT_NEAR(growing.damping_ratio, 0.0, 1e-3);
  }
}

/// Klingel 1883. On edges a wheelset rolls so that its contact moves further sideways than its centre, which raises
/// both the difference of radii and the lateral creepage: neither counts.
TEST(Stability, AFreeWheelsetRunsInKlingelsWave) {
  for (const double conicity : {0.025, 0.05, 0.15}) {
    Wheelset w;
    w.conicity = conicity;
    const double speed = 1.0;
    const ModesAtSpeed at = modes_at_speed(on_edges(w), speed);
    ASSERT_EQ(at.report.status, Status::ok) << at.report.message;
    const double wave = 2.0 * std::numbers::pi * std::sqrt(w.radius * w.half_distance / conicity);
    EXPECT_NEAR(speed / hunting(at).frequency, wave, 1e-3 * wave);
  }
}

/// In time: a small lateral offset grows or decays by the eigenvalue's real part.
TEST(Stability, ADisturbedRunGrowsAsTheEigenvalueSays) {
  Wheelset w;
  w.lateral = 0.5e6;
  w.yaw = 1e6;
  const double critical = critical_by_hand(w);
  for (const double share : {0.8, 1.2}) {
    const double speed = share * critical;
    const VehicleAtSpeed vehicle = on_edges(w);
    const std::complex<double> expected = hunting(modes_at_speed(vehicle, speed)).value;
    const VehicleOnTrack v = vehicle(speed);
    SystemState start = find_equilibrium(v).state;
    const Eigen::Index y = 1;
    ASSERT_EQ(v.system.coordinates[1].name, "wheelset.y");
    start.q[y] += 2e-5;
    SimulationSettings settings;
    settings.duration = 2.5;
    settings.position_tolerance = 1e-10;
    settings.max_travel = 0.05;
    Simulation simulation(v, start, settings);
    // Amplitudes at the crests, after other motions have died away.
    std::vector<std::array<double, 2>> crests, last;
    while (!simulation.finished()) {
      simulation.advance();
      last.push_back({simulation.state().time, simulation.state().q[y]});
      const std::size_t n = last.size();
      if (n > 2 && last[n - 2][0] > 1.0 && last[n - 2][1] > last[n - 3][1] && last[n - 2][1] >= last[n - 1][1])
        crests.push_back(last[n - 2]);
    }
    ASSERT_GE(crests.size(), 4u);
    const double span = crests.back()[0] - crests.front()[0],
                 growth = std::log(crests.back()[1] / crests.front()[1]) / span,
                 angular = 2.0 * std::numbers::pi * static_cast<double>(crests.size() - 1) / span;
    EXPECT_NEAR(growth, expected.real(), 0.01 * std::abs(expected)) << share;
    EXPECT_GT(growth * expected.real(), 0.0);
    EXPECT_NEAR(angular, expected.imag(), 0.01 * expected.imag()) << share;
  }
}

/// A run with falling speed after a lateral offset.
FallResult fall(const Wheelset& w, const FallSettings& settings, double offset) {
  VehicleOnTrack v = on_edges(w)(settings.from);
  SystemState start = find_equilibrium(v).state;
  LineSetup line;
  line.speed = profile_of(settings);
  v.line = std::make_shared<const LineEffects>(v.system, line);
  start.q[1] += offset;
  SimulationSettings s;
  s.duration = line.speed.time.back();
  s.position_tolerance = 1e-8;
  s.max_travel = 0.1;
  Simulation simulation(v, start, s);
  SwayHistory history;
  history.sway.emplace_back();
  const auto note = [&] {
    const Travel now = simulation.vehicle().travel(simulation.state().time);
    history.distance.push_back(now.distance);
    history.speed.push_back(now.speed);
    history.sway[0].push_back(simulation.state().q[1]);
  };
  for (note(); !simulation.finished(); note()) simulation.advance();
  return judge_fall(history, settings);
}

/// With a stop that limits its sway.
Wheelset stopped_wheelset() {
  Wheelset w;
  w.lateral = 0.5e6;
  w.yaw = 1e6;
  w.clearance = 3e-3;
  return w;
}

/// The stop ends the growth of the sway and makes it less unstable: the limit cycle shrinks to the clearance at the
/// linear critical speed, and beyond that decays by the eigenvalues, whose integral over time says when it is gone.
TEST(FallingSpeed, EndsALimitCycleWhereTheEigenvaluesSay) {
  const Wheelset w = stopped_wheelset();
  const double critical = critical_by_hand(w);
  FallSettings settings{1.1 * critical, 0.8 * critical, 600.0, 0.8, 100.0, 1e-4};
  const auto by_hand = [&](double deceleration) {
    constexpr double kStep = 1e-3;
    double speed = critical, logarithm = 0.0;
    while (logarithm > std::log(settings.amplitude / w.clearance)) {
      logarithm += ByHand(w, speed - 0.5 * kStep).hunting().real() * kStep / deceleration;
      speed -= kStep;
    }
    return speed;
  };
  std::vector<double> died;
  for (const double deceleration : {0.8, 0.2, 0.05}) {
    settings.deceleration = deceleration;
    const FallResult r = fall(w, settings, 2e-3);
    ASSERT_EQ(r.verdict, FallVerdict::died) << deceleration;
    EXPECT_GT(r.first_amplitude, w.clearance);
    const double expected = by_hand(deceleration);
    EXPECT_NEAR(r.speed, expected, 0.1 * (critical - expected)) << deceleration;
    died.push_back(r.speed);
  }
  for (std::size_t i = 0; i + 1 < died.size(); ++i) {
    const SlowFall s = slowest_fall(died[i], died[i + 1]);
    EXPECT_LT(s.low, critical);
    EXPECT_GT(s.high, critical) << i;
    EXPECT_LT(critical - died[i + 1], 0.55 * (critical - died[i]));
  }
}

TEST(FallingSpeed, SaysWhereThereIsNoLimitCycleAndWhereItLasts) {
  const Wheelset w = stopped_wheelset();
  const double critical = critical_by_hand(w);
  FallSettings settings{0.9 * critical, 0.85 * critical, 600.0, 1.0, 100.0, 1e-6};
  EXPECT_EQ(fall(w, settings, 2e-3).verdict, FallVerdict::none);
  settings.from = 1.2 * critical;
  settings.to = 1.1 * critical;
  EXPECT_EQ(fall(w, settings, 2e-3).verdict, FallVerdict::lasting);
}

/// Between the flanges the amplitude of a cycle swells and fades; where it dies away, it does so all the way.
TEST(FallingSpeed, ACycleThatSwellsAndFadesIsOne) {
  const FallSettings settings{50.0, 20.0, 200.0, 1.0, 50.0, 1e-4};
  const auto verdict = [&](auto amplitude) {
    SwayHistory history;
    history.sway.resize(1);
    for (int i = 0; i <= 6000; ++i) {
      const double x = 0.1 * i;
      history.distance.push_back(x);
      history.speed.push_back(50.0 - 0.05 * std::max(0.0, x - settings.hold));
      history.sway[0].push_back(amplitude(x) * std::sin(2.0 * std::numbers::pi * x / 9.0));
    }
    return judge_fall(history, settings).verdict;
  };
  for (double phase = 0.0; phase < 6.0; phase += 0.3) {
    const auto swells = [&](double x) {
      return 6e-3 * (1.0 + 0.07 * std::sin(2.0 * std::numbers::pi * x / 130.0 + phase));
    };
    EXPECT_EQ(verdict(swells), FallVerdict::lasting) << phase;
    EXPECT_EQ(verdict([&](double x) { return swells(x) * std::exp(-x / 200.0); }), FallVerdict::none) << phase;
  }
}

TEST(FallingSpeed, RunningSwayOfASineIsItsAmplitude) {
  SwayHistory history;
  history.sway.resize(2);
  for (int i = 0; i <= 4000; ++i) {
    const double x = 0.1 * i + 0.03 * (i % 3);
    history.distance.push_back(x);
    history.speed.push_back(50.0 - 0.01 * x);
    history.sway[0].push_back(1e-3 + 2e-3 * std::exp(-x / 50.0) * std::sin(2.0 * std::numbers::pi * x / 4.0));
    history.sway[1].push_back(0.0);
  }
  const std::vector<SwayAt> sway = running_sway(history, 8.0);
  for (const SwayAt& at : sway) {
    // mean square of the decaying sine over the window
    const double expected = 2e-3 * std::exp(-at.distance / 50.0) * std::sqrt(0.5 * std::sinh(0.16) / 0.16);
    EXPECT_NEAR(at.rms, expected, 0.01 * expected);
    EXPECT_NEAR(at.speed, 50.0 - 0.01 * at.distance, 1e-9);
  }
  const LastAbove last = last_above(sway, 1e-5);
  EXPECT_FALSE(last.never_above || last.at_end);
  const double place = 50.0 * std::log(2e-3 * std::sqrt(0.5 * std::sinh(0.16) / 0.16) / 1e-5);
  EXPECT_NEAR(last.speed, 50.0 - 0.01 * place, 0.01);
  EXPECT_TRUE(last_above(sway, 1e-2).never_above);
  EXPECT_TRUE(last_above(sway, 1e-9).at_end);
}

TEST(FallingSpeed, RefusesWhatIsNoFall) {
  const FallSettings good{50.0, 20.0, 400.0, 0.5, 100.0, 1e-4};
  const SpeedProfile profile = profile_of(good);
  EXPECT_EQ(profile.time, (std::vector{0.0, 8.0, 68.0}));
  EXPECT_EQ(profile.speed, (std::vector{50.0, 50.0, 20.0}));
  const auto refused = [&](auto change) {
    FallSettings bad = good;
    change(bad);
    EXPECT_THROW(profile_of(bad), Error);
  };
  refused([](FallSettings& s) { s.to = 50.0; });
  refused([](FallSettings& s) { s.to = 0.0; });
  refused([](FallSettings& s) { s.from = std::nan(""); });
  refused([](FallSettings& s) { s.deceleration = 0.0; });
  refused([](FallSettings& s) { s.window = 200.0; });
  refused([](FallSettings& s) { s.amplitude = -1.0; });
}

TEST(Stability, AnOverdampedMassHasTheTwoRealEigenvaluesOfItsFormula) {
  // The wheel hardly moves.
  const double m = 9000.0, k = 2e6, c = 4e5;
  const ModesAtSpeed at = modes_at_speed(
      [&](double speed) { return on_hertz_springs(wheel_on_mass(1813.0, m, k, c), {}, speed, 1e15); }, 20.0);
  const double half = 0.5 * c / m, root = std::sqrt(half * half - k / m);
  for (const double expected : {-half + root, -half - root})
    EXPECT_TRUE(ranges::any_of(at.modes, [&](const Eigenmode& mode) {
      return mode.frequency == 0.0 && mode.damping_ratio == 1.0 &&
             std::abs(mode.value.real() - expected) < 1e-3 * std::abs(expected);
    })) << expected;
  EXPECT_FALSE(at.fastest_growth);
}

TEST(Stability, MotionsKeepTheirNumberFromSpeedToSpeed) {
  Wheelset w;
  w.lateral = 0.5e6;
  w.yaw = 1e6;
  StabilitySettings settings;
  for (double speed = 10.0; speed < 100.0; speed += 2.5) settings.speeds.push_back(speed);
  const StabilityResult r = stability(on_edges(w), settings);
  ASSERT_EQ(r.at.size(), settings.speeds.size());
  int number = -1;
  for (const ModesAtSpeed& at : r.at) {
    const std::complex<double> swaying = hunting(at).value;
    const auto place = ranges::find(at.modes, swaying, &Eigenmode::value) - at.modes.begin();
    const int here = at.branch[static_cast<std::size_t>(place)];
    if (number < 0) number = here;
    EXPECT_EQ(here, number) << at.speed;
    std::vector<int> sorted = at.branch;
    ranges::sort(sorted);
    EXPECT_EQ(ranges::adjacent_find(sorted), sorted.end());
  }
}

TEST(Stability, SaysWhereAVehicleIsStable) {
  Wheelset w;
  w.lateral = 0.5e6;
  w.yaw = 1e6;
  const double critical = critical_by_hand(w);
  StabilitySettings settings;
  settings.speeds = {0.5 * critical, 0.9 * critical};
  EXPECT_EQ(stability(on_edges(w), settings).verdict, StabilityVerdict::stable);
  settings.speeds = {1.1 * critical, 1.2 * critical};
  EXPECT_EQ(stability(on_edges(w), settings).verdict, StabilityVerdict::unstable);
}

TEST(Stability, RefusesSpeedsThatMakeNoSense) {
  const VehicleAtSpeed vehicle = on_edges({});
  for (const std::vector<double>& speeds : {std::vector<double>{}, {0.0, 1.0}, {2.0, 1.0}, {std::nan("")}}) {
    StabilitySettings settings;
    settings.speeds = speeds;
    EXPECT_THROW(stability(vehicle, settings), Error);
  }
  StabilitySettings settings;
  settings.speeds = {1.0};
  settings.speed_tolerance = 0.0;
  EXPECT_THROW(stability(vehicle, settings), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
