// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/line_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "small_vehicles.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"
#include "treadmark/solvers/vehicle/curving.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"

namespace treadmark::vehicle {
namespace {

using std::numbers::pi;
using wheelrail::Side;

constexpr double kRollingRadius = 0.46, kWheel = 9e10;

LayoutElement element(double length, FromTo curvature, FromTo cant, TransitionShape shape = TransitionShape::linear) {
  return {length, curvature, cant, {1.435, 1.435}, shape, {}};
}

/// A straight, a transition, and a circle.
TrackLayout into_circle(double straight, double transition, double radius, double cant,
                        TransitionShape shape = TransitionShape::linear) {
  TrackLayout layout;
  const double k = 1.0 / radius;
  layout.elements = {element(straight, {0, 0}, {0, 0}), element(transition, {0, k}, {0, cant}, shape),
                     element(2000.0, {k, k}, {cant, cant})};
  return layout;
}

std::shared_ptr<const TrackPath> circle(double radius, double cant) {
  TrackLayout layout;
  layout.elements = {element(5000.0, {1.0 / radius, 1.0 / radius}, {cant, cant})};
  return std::make_shared<const TrackPath>(layout);
}

LineSetup setup_of(std::shared_ptr<const TrackPath> path, double speed, double start = 100.0) {
  LineSetup setup;
  setup.path = std::move(path);
  setup.start = start;
  setup.gravity = kGravity;
  setup.speed = {{0.0}, {speed}};
  return setup;
}

/// A wheel tread that is a cone, on a rail that is round across: closed forms of conicity hold.
struct Cone {
  double slope = 0.05, crown = 0.3;
};
std::shared_ptr<const ContactTable> cone_table() {
  static const auto table = [] {
    constexpr double kHalf = 0.06;
    const Cone cone;
    const wheelrail::Geometry bodies{
        analytic::make_prismatic_surface(analytic::cylinder_chain(cone.crown, 0.12)),
        analytic::make_revolved_surface({-kHalf, cone.slope * kHalf, -std::atan(cone.slope), {{2.0 * kHalf, 0.0}}},
                                        kRollingRadius),
        true, true};
    wheelrail::Problem p;
    p.track.gauge_based = false;
    p.track.rail_y0 = 0.75;
    return build_contact_table(bodies, p, 6e4, {.lateral_range = 8e-3, .step = 1e-3, .element_size = 0.5e-3});
  }();
  return table;
}

constexpr std::array<bool, kFreedoms> kAll{true, true, true, true, true, true};

VehicleOnTrack on_cones(const VehicleModel& model, double speed) {
  VehicleOnTrack v;
  v.system = assemble(model, {}, speed, kGravity);
  v.speed = speed;
  const auto table = cone_table();
  for (std::size_t i = 0; i < v.system.wheelsets.size(); ++i)
    for (const auto side : {Side::left, Side::right}) {
      Vec3 marker = table->nominal().X_TR.origin;
      if (side == Side::left) marker.y() = -marker.y();
      v.wheels.push_back({static_cast<int>(i), side, side == Side::left ? "left" : "right",
                          std::make_shared<TableContact>(table, side), marker});
    }
  v.connect();
  return v;
}

/// A free wheelset; soft springs keep it from running away.
VehicleModel lone_wheelset(double load) {
  VehicleModel m;
  m.bodies = {body("wheelset", 1500.0, {800, 100, 800}, {0, 0, -kRollingRadius}, kAll),
              body("frame", load / kGravity - 1500.0, {1e3, 1e3, 1e3}, {0, 0, -0.8}, kVertical)};
  m.springs = {spring("wheelset", "frame", {0, 0, -kRollingRadius}, {1e3, 1.0, 1e6, 0, 0, 1.0}, {0, 0, 1e4, 0, 0, 0})};
  m.wheelsets = {{"wheelset", kRollingRadius}};
  return m;
}

/// A car on two axles with all that curves act on.
VehicleModel two_axles() {
  VehicleModel m;
  m.bodies = {body("car", 20000.0, {3e4, 2e5, 2e5}, {0, 0, -1.6}, {false, true, true, true, true, true}),
              body("front", 1500.0, {800, 100, 800}, {3.0, 0, -kRollingRadius}, kAll),
              body("rear", 1500.0, {800, 100, 800}, {-3.0, 0, -kRollingRadius}, kAll)};
  for (const char* axle : {"front", "rear"})
    for (const double y : {-1.0, 1.0}) {
      const double x = axle[0] == 'f' ? 3.0 : -3.0;
      m.springs.push_back(spring(axle, "car", {x, y, -0.6}, {1e5, 2e6, 1.5e6, 0, 0, 0}, {2e3, 2e4, 2e4, 0, 0, 0},
                                 {0, 6e6, 0, 0, 0, 0}));
    }
  m.wheelsets = {{"front", kRollingRadius}, {"rear", kRollingRadius}};
  return m;
}

struct Loads {
  double left = 0.0, right = 0.0, lateral = 0.0;
};
Loads loads(const VehicleOnTrack& v, const std::vector<ContactReaction>& reactions) {
  Loads sum;
  for (std::size_t i = 0; i < reactions.size(); ++i) {
    (v.wheels[i].side == Side::left ? sum.left : sum.right) += reactions[i].on_rail.force.z();
    sum.lateral -= reactions[i].on_rail.force.y();
  }
  return sum;
}

VehicleOnTrack on_line(VehicleOnTrack v, LineSetup setup) {
  v.line = std::make_shared<const LineEffects>(v.system, std::move(setup));
  return v;
}

/// Moments about the middle of the track on a circle: of the loads of the rails, and by hand of centrifugal forces at
/// the heights of bodies, of weights where bodies stand, and of turning axles, which lean outwards.
std::pair<double, double> moments(const VehicleOnTrack& v, const Equilibrium& e, const Curving& at, double curvature) {
  const auto bend = [&](double x) { return 0.5 * curvature * x * x; };  // of the line, seen from below the car
  double of_loads = 0.0, by_hand = 0.0;
  for (std::size_t i = 0; i < e.reactions.size(); ++i) {
    const Multibody::Wheelset& set = v.system.wheelsets[static_cast<std::size_t>(v.wheels[i].wheelset)];
    const double x = v.system.bodies[static_cast<std::size_t>(set.body)].position.x();
    of_loads += e.reactions[i].on_rail.force.z() * (e.reactions[i].contact_y + bend(x));
  }
  for (const Multibody::Body& b : v.system.bodies) {
    by_hand += b.mass * (at.lateral_acceleration * b.position.z() +
                         at.normal_acceleration * (e.state.q[b.coordinate[1]] + bend(b.position.x())));
    if (b.wheelset >= 0) by_hand -= b.inertia.y() * v.speed * v.speed * curvature / kRollingRadius;
  }
  return {of_loads, by_hand};
}

/// Steady curving against the balance of a rigid body: springs hardly give way.
TEST(LineEffects, SteadyCurvingAgainstTheBalanceOfTheWholeVehicle) {
  VehicleModel model = two_axles();
  for (SpringSpec& s : model.springs) s.stiffness[1] *= 50.0, s.stiffness[2] *= 50.0;
  constexpr double kSpeed = 45.0;
  for (const double radius : {2000.0, -2000.0})
    for (const double cant : {0.0, 0.06, 0.15}) {
      const double signed_cant = radius > 0.0 ? cant : -cant;
      const auto path = circle(radius, signed_cant);
      const VehicleOnTrack v = on_line(on_cones(model, kSpeed), setup_of(path, kSpeed));
      const Equilibrium e = find_equilibrium(v);
      ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
      const Loads found = loads(v, e.reactions);
      CurvingVehicle whole;
      whole.mass = 23000.0;
      whole.centre_height = (20000.0 * 1.6 + 3000.0 * kRollingRadius) / whole.mass;
      const Curving hand = curving(whole, path->at(100.0), kSpeed, kGravity);
      EXPECT_NEAR(found.lateral, hand.guiding_force, 1e-4 * whole.mass * kGravity);
      const Vec3 felt = v.line->felt_acceleration({3.0, 0.0, 0.0}, 0.0);
      EXPECT_NEAR(felt.y(), hand.lateral_acceleration, 1e-9);
      EXPECT_NEAR(felt.z(), kGravity - hand.normal_acceleration, 1e-9);
      const Vec3 spin = v.line->frame_spin(3.0, 0.0);
      EXPECT_NEAR(spin.norm(), kSpeed / std::abs(radius), 1e-9);
      EXPECT_NEAR(spin.x(), 0.0, 1e-9);  // the cant stays
      EXPECT_NEAR(found.left + found.right, hand.left_load + hand.right_load, 1e-4 * whole.mass * kGravity);
      const auto [of_loads, by_hand] = moments(v, e, hand, 1.0 / radius);
      EXPECT_NEAR(of_loads, by_hand, 0.002 * std::abs(by_hand) + 2e-5 * whole.mass * kGravity) << radius << ' ' << cant;
    }
}

/// A car leans outwards about the plane of its springs, which hardly give way sideways, by a roll flexibility of
/// m g h / (k - m g h), and its weight moves to the outer rail.
TEST(LineEffects, AWeightThatLeansMovesToTheOuterRail) {
  VehicleModel model = two_axles();
  for (SpringSpec& s : model.springs) s.stiffness[1] = 5e8, s.stiffness[2] = 3e5;
  constexpr double kSpeed = 45.0, kRadius = 2000.0, kSpringPlane = 0.6, kCar = 20000.0;
  const auto path = circle(kRadius, 0.0);
  const VehicleOnTrack v = on_line(on_cones(model, kSpeed), setup_of(path, kSpeed));
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  const double height = 1.6 - kSpringPlane, toppling = kCar * kGravity * height, springs = 4.0 * 3e5;
  CurvingVehicle car;
  car.mass = kCar;
  car.centre_height = 1.6;
  car.roll_centre_height = kSpringPlane;
  car.roll_flexibility = toppling / (springs - toppling);
  const Curving hand = curving(car, path->at(100.0), kSpeed, kGravity);
  const auto place = [&](const std::string& name) {
    const auto found = ranges::find(v.system.coordinates, name, &Coordinate::name);
    return e.state.q[found - v.system.coordinates.begin()];
  };
  const double axles_roll = 0.5 * (place("front.roll") + place("rear.roll"));
  EXPECT_NEAR(place("car.roll") - axles_roll, hand.body_roll, 0.01 * std::abs(hand.body_roll));
  EXPECT_GT(std::abs(hand.body_roll), 0.015);
  const auto [of_loads, by_hand] = moments(v, e, hand, 1.0 / kRadius);
  EXPECT_NEAR(of_loads, by_hand, 0.002 * std::abs(by_hand));
  EXPECT_GT(hand.normal_acceleration * kCar * std::abs(place("car.y")), 0.03 * std::abs(by_hand))
      << "what is to be seen";
}

TEST(LineEffects, CurvesToBothSidesAreMirrorImages) {
  constexpr double kSpeed = 40.0;
  const VehicleOnTrack right = on_line(on_cones(two_axles(), kSpeed), setup_of(circle(2000.0, 0.05), kSpeed)),
                       left = on_line(on_cones(two_axles(), kSpeed), setup_of(circle(-2000.0, -0.05), kSpeed));
  const Equilibrium a = find_equilibrium(right, {1e-10, 1e-6, 60}), b = find_equilibrium(left, {1e-10, 1e-6, 60});
  ASSERT_EQ(a.report.status, Status::ok) << a.report.message;
  ASSERT_EQ(b.report.status, Status::ok) << b.report.message;
  for (std::size_t c = 0; c < right.system.coordinates.size(); ++c) {
    if (right.system.coordinates[c].body < 0) continue;  // those of the other side
    const Freedom f = right.system.coordinates[c].freedom;
    const double sign = f == Freedom::y || f == Freedom::roll || f == Freedom::yaw ? -1.0 : 1.0;
    const auto i = static_cast<Eigen::Index>(c);
    EXPECT_NEAR(a.state.q[i], sign * b.state.q[i], 1e-8) << right.system.coordinates[c].name;
  }
  EXPECT_NEAR(a.reactions[0].on_rail.force.z(), b.reactions[1].on_rail.force.z(), 0.5);
  EXPECT_NEAR(a.reactions[0].on_rail.force.y(), -b.reactions[1].on_rail.force.y(), 0.5);
}

/// Redtenbacher: the outer wheel rolls on the larger circle where y = -r s k / (2 lambda).
TEST(LineEffects, AFreeWheelsetFindsItsKinematicPath) {
  constexpr double kCurve = 1000.0, kSpeed = 5.0;
  // Cant without deficiency, so that nothing pushes aside.
  const double cant = 1.5 * kSpeed * kSpeed / (kGravity * kCurve);
  const VehicleOnTrack v = on_line(on_cones(lone_wheelset(1e5), kSpeed), setup_of(circle(kCurve, cant), kSpeed));
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  const double base = e.reactions[1].contact_y - e.reactions[0].contact_y;
  const double expected = -kRollingRadius * base / (2.0 * Cone{}.slope * kCurve);
  EXPECT_NEAR(v.motion(0, e.state).wheelset.y, expected, 0.02 * std::abs(expected));
  for (const ContactReaction& r : e.reactions) EXPECT_LT(std::abs(r.longitudinal_creep_force), 30.0);
}

/// Klingel's wavelength of a cone: 2 pi sqrt(r s / (2 lambda)).
TEST(LineEffects, AFreeWheelsetWavesAsKlingelSays) {
  constexpr double kSpeed = 2.0;
  const VehicleOnTrack v = on_cones(lone_wheelset(1e5), kSpeed);
  SystemState start = find_equilibrium(v).state;
  start.q[1] = 2e-3;
  SimulationSettings settings;
  settings.duration = 40.0;
  settings.position_tolerance = 1e-8;
  settings.max_step = 5e-3;
  settings.max_travel = 0.05;
  Simulation s(v, start, settings);
  std::vector<double> crossings;
  while (!s.finished()) {
    const double t = s.state().time, y = s.state().q[1];
    s.advance();
    if ((y > 0.0) != (s.state().q[1] > 0.0))
      crossings.push_back(kSpeed * (t + (s.state().time - t) * y / (y - s.state().q[1])));
  }
  ASSERT_GE(crossings.size(), 5u);
  const double base = 2.0 * 0.75, klingel = 2.0 * pi * std::sqrt(kRollingRadius * base / (2.0 * Cone{}.slope));
  const double found = 2.0 * (crossings.back() - crossings[1]) / static_cast<double>(crossings.size() - 2);
  EXPECT_NEAR(found, klingel, 0.02 * klingel);
}

TEST(LineEffects, ThroughATransitionIntoTheBalanceOfTheCircle) {
  constexpr double kSpeed = 15.0, kCurve = 2000.0, kCant = 0.03;
  const TrackLayout layout = into_circle(30.0, 80.0, kCurve, kCant);
  const auto path = std::make_shared<const TrackPath>(rounded(layout, 1.0));
  const VehicleOnTrack moving = on_line(on_cones(two_axles(), kSpeed), setup_of(path, kSpeed, 10.0)),
                       steady = on_line(on_cones(two_axles(), kSpeed), setup_of(circle(kCurve, kCant), kSpeed));
  const Equilibrium begin = find_equilibrium(moving), end = find_equilibrium(steady);
  ASSERT_EQ(begin.report.status, Status::ok) << begin.report.message;
  ASSERT_EQ(end.report.status, Status::ok) << end.report.message;
  SimulationSettings settings;
  settings.duration = 20.0;
  settings.position_tolerance = 1e-7;
  settings.max_step = 2e-3;
  settings.max_travel = 0.1;
  Simulation s(moving, begin.state, settings);
  // Waves of the wheelsets fade slowly: means over ten of them.
  constexpr double kFrom = 9.0;
  Vector mean = Vector::Zero(moving.system.size());
  std::vector<Vec3> forces(4, Vec3::Zero());
  double time = 0.0;
  while (!s.finished()) {
    const double before = s.state().time;
    s.advance();
    if (before < kFrom) continue;
    const double step = s.state().time - before;
    time += step;
    mean += step * s.state().q;
    for (std::size_t i = 0; i < 4; ++i) forces[i] += step * s.reactions()[i].on_rail.force;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(forces[i].z() / time, end.reactions[i].on_rail.force.z(), 150.0);
    EXPECT_NEAR(forces[i].y() / time, end.reactions[i].on_rail.force.y(), 150.0);
  }
  for (const int c : {0, 2, 6, 12}) EXPECT_NEAR(mean[c] / time, end.state.q[c], 3e-4) << c;
  const double turnover = s.energy().turnover;
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * turnover);
  EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-4 * turnover);
}

/// In the frame of the line the vehicle must feel no more of a joint than the line has: kinks are rounded.
TEST(LineEffects, RoundedLinesHaveFiniteTurningEverywhereAndTheSameCircles) {
  TrackLayout layout = into_circle(40.0, 60.0, 300.0, 0.1);
  layout.elements.push_back(element(100.0, {-1.0 / 500.0, -1.0 / 500.0}, {0.1, 0.1}));
  const TrackPath sharp(layout), round(rounded(layout, 1.0));
  EXPECT_NEAR(round.length(), sharp.length(), 1e-9);
  EXPECT_NEAR(round.largest_curvature_step(), 0.0, 1e-15);
  for (const double s : {10.0, 70.0, 150.0, 1000.0, 2150.0}) {
    EXPECT_NEAR(round.at(s).heading, sharp.at(s).heading, 1e-4) << s;
    EXPECT_NEAR(round.at(s).curvature.value, sharp.at(s).curvature.value, 1e-12) << s;
    EXPECT_NEAR(round.at(s).cant.value, sharp.at(s).cant.value, 1e-12) << s;
  }
  EXPECT_NEAR(round.at(1000.0).heading, sharp.at(1000.0).heading, 1e-12);
  double last = round.at(38.0).cant_angle.first;
  for (double s = 38.0; s < 103.0; s += 0.01) {
    const PathPoint p = round.at(s);
    EXPECT_NEAR(p.cant_angle.first, last, 1e-5) << s;
    last = p.cant_angle.first;
  }
}

/// The frames are those of a rigid body in space: what the class computes by formulas against differences of poses.
TEST(LineEffects, ForcesOfInertiaAgainstDifferencesOfPoses) {
  constexpr double kSpeed = 30.0;
  TrackLayout layout = into_circle(50.0, 80.0, -400.0, -0.12, TransitionShape::bloss);
  layout.cant_axis = CantAxis::low_rail;
  const auto path = std::make_shared<const TrackPath>(layout);
  VehicleModel model;
  model.bodies = {body("wheelset", 1500.0, {800, 100, 800}, {0, 0.1, -kRollingRadius}, kAll)};
  model.wheelsets = {{"wheelset", kRollingRadius}};
  const Multibody system = assemble(model, {}, kSpeed, kGravity);
  LineSetup setup = setup_of(path, kSpeed, 60.0);
  setup.speed = {{0.0, 10.0}, {kSpeed, 20.0}};
  const LineEffects line(system, setup);
  for (const double time : {0.3, 0.8, 1.5, 2.5}) {
    const auto pose = [&](double t) { return path->at(60.0 + travel_at(setup.speed, t).distance).X_LT(); };
    constexpr double h = 1e-3;
    const Vec3 centre(0.0, 0.1, -kRollingRadius);
    const auto where = [&](double t) { return pose(t).apply(centre); };
    const Vec3 a = (where(time + h) - 2.0 * where(time) + where(time - h)) / (h * h);
    const Mat3 axes = pose(time).rotation.transpose();
    const Vec3 weight = axes * Vec3(0, 0, kGravity) - Vec3(0, 0, kGravity);
    const Vector f = line.state(time).force;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], 1500.0 * (weight - axes * a)[c], 0.02) << time << ' ' << c;
    // Angular momentum in space: that of the frame's turning and of the axle, which turns in it.
    const auto momentum = [&](double t) {
      const auto d = [&](double dt) { return pose(t + dt).rotation; };
      const Mat3 skew = d(0.0).transpose() * (d(h) - d(-h)) / (2.0 * h);
      const Vec3 spin(skew(2, 1), skew(0, 2), skew(1, 0));
      Vec3 inside = Vec3(800, 100, 800).cwiseProduct(spin);
      inside.y() -= 100.0 * travel_at(setup.speed, t).speed / kRollingRadius;
      return Vec3(pose(t).rotation * inside);
    };
    const Vec3 moment = -axes * (momentum(time + h) - momentum(time - h)) / (2.0 * h);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[3 + c], moment[c], 0.02) << time << ' ' << c;
  }
}

IrregularitySpec table_of(double amplitude, double wavelength, Irregularity which, double length) {
  IrregularitySpec spec;
  spec.table.emplace();
  for (double s = 0.0; s <= length; s += wavelength / 40.0) {
    spec.table->distance.push_back(s);
    spec.table->values[static_cast<std::size_t>(which)].push_back(
        wavelength > 1e3 ? amplitude : amplitude * std::sin(2.0 * pi * s / wavelength));
  }
  spec.begin = 5.0;
  spec.wind_up = 10.0;
  return spec;
}

/// A mass on a spring over waves of the rails, in closed form.
TEST(LineEffects, AMassOverWavesOfTheLongitudinalLevel) {
  constexpr double kSpeed = 20.0, kMass = 9000.0, kStiffness = 2e6, kDamping = 4e4, kWave = 12.0, kHigh = 4e-3;
  VehicleOnTrack v = on_hertz_springs(wheel_on_mass(500.0, kMass, kStiffness, kDamping), {}, kSpeed, kWheel);
  LineSetup setup = setup_of(nullptr, kSpeed, 0.0);
  setup.irregularities =
      std::make_shared<const Irregularities>(table_of(kHigh, kWave, Irregularity::longitudinal_level, 300.0), 300.0);
  v = on_line(v, setup);
  SimulationSettings settings;
  settings.duration = 12.0;
  settings.max_step = 1e-3;
  settings.max_travel = 1.0;
  const Equilibrium e = find_equilibrium(v);
  Simulation s(v, e.state, settings);
  double most = 0.0;
  while (!s.finished()) {
    s.advance();
    if (s.state().time > 10.0) most = std::max(most, std::abs(s.state().q[0] - e.state.q[0]));
  }
  const double w = 2.0 * pi * kSpeed / kWave;
  const std::complex<double> spring(kStiffness, w * kDamping);
  // The wheel follows the rail, which its contact makes a little higher.
  EXPECT_NEAR(most, kHigh * std::abs(spring / (spring - w * w * kMass)), 5e-3 * most);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
  EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
}

TEST(LineEffects, EvenCrossLevelRollsTheVehicle) {
  constexpr double kSpeed = 15.0, kCross = 6e-3;
  LineSetup setup = setup_of(nullptr, kSpeed, 0.0);
  setup.irregularities =
      std::make_shared<const Irregularities>(table_of(kCross, 2e3, Irregularity::cross_level, 1000.0), 1000.0);
  const VehicleOnTrack v = on_line(on_cones(two_axles(), kSpeed), setup);
  SimulationSettings settings;
  settings.duration = 8.0;
  settings.max_step = 2e-3;
  settings.max_travel = 0.1;
  Simulation s(v, find_equilibrium(v).state, settings);
  while (!s.finished()) s.advance();
  // The weight of the car leans it further against its springs.
  constexpr double kToppling = 20000.0 * kGravity * (1.6 - 0.6), kSprings = 4.0 * 1.5e6;
  const auto roll = [&](std::size_t c) { return s.state().q[static_cast<Eigen::Index>(c)]; };
  for (std::size_t c = 0; c < v.system.coordinates.size(); ++c)
    if (v.system.coordinates[c].freedom == Freedom::roll) {
      const bool leans = v.system.coordinates[c].name == "car.roll";
      const double expected = kCross / 1.5 * (leans ? kSprings / (kSprings - kToppling) : 1.0);
      EXPECT_NEAR(roll(c), expected, 0.03 * expected) << v.system.coordinates[c].name;
    }
}

TEST(LineEffects, EnergyIsBalancedOnIrregularTrack) {
  constexpr double kSpeed = 15.0;
  IrregularitySpec spec;
  spec.spectral.shortest = 3.0;
  spec.spectral.longest = 50.0;
  for (auto& spectrum : spec.spectral.spectra) {
    spectrum.emplace();
    spectrum->amplitude = 5e-8;
    spectrum->omega_c = 0.82;
    spectrum->omega_r = 0.02;
  }
  spec.begin = 110.0;
  LineSetup setup = setup_of(circle(2500.0, 0.02), kSpeed);
  setup.irregularities = std::make_shared<const Irregularities>(spec, 300.0);
  const VehicleOnTrack v = on_line(on_cones(two_axles(), kSpeed), setup);
  SimulationSettings settings;
  settings.duration = 4.0;
  settings.max_step = 1e-3;
  settings.max_travel = 0.1;
  settings.position_tolerance = 1e-8;
  Simulation s(v, find_equilibrium(v).state, settings);
  while (!s.finished()) s.advance();
  EXPECT_GT(s.energy().dampers, 3.0);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
  EXPECT_LT(std::abs(s.energy().contact_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
}

TEST(LineEffects, TorquesAreBorneByLongitudinalCreep) {
  constexpr double kSpeed = 15.0, kTorque = 2000.0;
  LineSetup setup = setup_of(nullptr, kSpeed);
  setup.torques = {{0, {0.0, 1.0}, {0.0, kTorque}, "car", {}}};
  const VehicleOnTrack v = on_line(on_cones(two_axles(), kSpeed), setup);
  SimulationSettings settings;
  settings.duration = 6.0;
  settings.max_step = 2e-3;
  settings.max_travel = 0.1;
  Simulation s(v, find_equilibrium(v).state, settings);
  while (!s.finished()) s.advance();
  double front = 0.0, rear = 0.0;
  for (std::size_t i = 0; i < 4; ++i) (i < 2 ? front : rear) -= s.reactions()[i].longitudinal_creep_force;
  EXPECT_NEAR(front, kTorque / kRollingRadius, 0.005 * kTorque / kRollingRadius);
  EXPECT_NEAR(rear, 0.0, 0.005 * kTorque / kRollingRadius);
  EXPECT_LT(std::abs(s.energy().integration_error(s.energy_at_start())), 1e-4 * s.energy().turnover);
}

TEST(LineEffects, BrakingSlowsAxlesAndShiftsLoad) {
  constexpr double kSpeed = 20.0, kRate = -0.8;
  LineSetup setup = setup_of(nullptr, kSpeed);
  setup.speed = {{0.0, 10.0}, {kSpeed, kSpeed + 10.0 * kRate}};
  const VehicleOnTrack v = on_line(on_cones(two_axles(), kSpeed), setup);
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  SimulationSettings settings;
  settings.duration = 5.0;
  settings.max_step = 2e-3;
  settings.max_travel = 0.1;
  Simulation s(v, e.state, settings);
  while (!s.finished()) s.advance();
  EXPECT_NEAR(s.vehicle().travel(5.0).distance, 5.0 * kSpeed + 0.5 * kRate * 25.0, 1e-9);
  for (std::size_t i = 0; i < 4; ++i) {
    const PairMotion m = v.motion(i, s.state());
    const double at_start = v.motion(i, e.state).wheelset_velocity.pitch;
    EXPECT_NEAR(m.wheelset_velocity.pitch, at_start * (1.0 + 5.0 * kRate / kSpeed), 5e-3) << i;
    // What turns the wheels slower is the rail's force at each: I / R^2 a.
    EXPECT_NEAR(s.reactions()[i].longitudinal_creep_force, 0.5 * 100.0 / (kRollingRadius * kRollingRadius) * kRate, 5.0)
        << i;
  }
}

TEST(LineEffects, CurvesThatAreTooTightAndStrangersAreRefused) {
  const Multibody system = assemble(two_axles(), {}, 10.0, kGravity);
  EXPECT_THROW(LineEffects(system, setup_of(circle(25.0, 0.0), 10.0)), Error);
  LineSetup setup = setup_of(circle(300.0, 0.0), 10.0);
  setup.gauge_at_rest = 1.5;
  EXPECT_THROW(LineEffects(system, setup), Error);
  setup = setup_of(nullptr, 10.0);
  setup.torques = {{2, {0.0}, {1.0}, "car", {}}};
  EXPECT_THROW(LineEffects(system, setup), Error);
  setup.torques = {{0, {0.0}, {1.0}, "nobody", {}}};
  EXPECT_THROW(LineEffects(system, setup), Error);
}

TEST(Driving, WaysAndTimesBelongTogether) {
  const SpeedProfile profile{{0.0, 4.0, 10.0}, {20.0, 12.0, 15.0}};
  EXPECT_NEAR(travel_at(profile, 4.0).distance, 64.0, 1e-12);
  EXPECT_NEAR(travel_at(profile, 10.0).distance, 64.0 + 81.0, 1e-12);
  EXPECT_NEAR(travel_at(profile, 12.0).distance, 145.0 + 30.0, 1e-12);
  EXPECT_NEAR(travel_at(profile, 2.0).speed, 16.0, 1e-12);
  EXPECT_EQ(travel_at(profile, 11.0).acceleration, 0.0);
  for (const double time : {0.0, 1.3, 4.0, 7.7, 10.0, 13.0})
    EXPECT_NEAR(time_at(profile, travel_at(profile, time).distance), time, 1e-12);
  const AxleTorque torque{0, {1.0, 3.0}, {100.0, 300.0}, "ground", {}};
  EXPECT_EQ(torque_at(torque, 0.0), 100.0);
  EXPECT_EQ(torque_at(torque, 2.0), 200.0);
  EXPECT_EQ(torque_at(torque, 5.0), 300.0);
}

}  // namespace
}  // namespace treadmark::vehicle
