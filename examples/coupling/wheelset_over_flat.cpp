// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A wheelset below a sprung mass rolls over a wheel flat. The bodies belong to Simbody, an open multibody program; what
// wheels and rails do to each other is Treadmark's, through its C interface alone. flat.toml is the same for `treadmark
// simulate`.
#include <Simbody.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "treadmark.h"

using namespace SimTK;

namespace {

// examples/vehicles/wheel-on-mass.toml and examples/tracks/gm-tt0088.toml, in SI. Axes of both programs: x forward, y
// right, z down.
constexpr double kSpeed = 20.0, kDistance = 0.4, kRadius = 0.46, kPitch = 20.0 * 3.14159265358979 / 180.0,
                 kGravity = 9.81;
constexpr double kLoad = 9307.5, kWheelset = 1813.0, kRail = 245.0;
constexpr double kPrimary = 2 * 1.22e6, kDamper = 2 * 4e3, kDamperEnd = 2 * 1e6;  // both sides together
constexpr double kSupportY = 16.154e6, kSupportDampingY = 80.77e3, kSupportZ = 62e6, kSupportDampingZ = 55.4e3;

const std::string kContact =
    "[track]\ngauge_mm = 1435.0\ngauge_height_mm = 14.0\ncant = \"1:40\"\n"
    "[wheelset]\nnominal_radius_mm = 460.0\nflange_back_distance_mm = 1360.0\nflange_back_position_mm = -70.0\n"
    "z_mm = 0.0\nvelocity_m_s = 20.0\n"
    "[friction]\ncoefficient = 0.3\n"
    "[discretisation]\ndx_mm = 1.0\nds_mm = 1.0\n"
    "[rail]\nshape.standard = \"60E1\"\n"
    "[wheel]\nshape.standard = \"S1002\"\n";
const char* const kFlat = "[[wheel.flats]]\nshape = \"rounded\"\nlength_mm = 80.0\ndepth_mm = 0.4\nwidth_mm = 86.0\n";

void require(tm_status status) {
  if (status > TM_FAILED) throw std::runtime_error(tm_message());
}

/// One wheel on its rail: positions and velocities in, forces on the rail out.
class Contact {
 public:
  Contact(bool left, bool flat) {
    const std::string text = kContact + (flat ? kFlat : "");
    require(tm_case_parse(text.data(), text.size(), nullptr, 1, &case_));
    require(tm_case_set(case_, left ? "case.side=left" : "case.side=right"));
    require(tm_pair_of_case(case_, &pair_));
    const char* const names[] = {"wheelset.s",           "wheelset.pitch",        "wheelset.vpitch",
                                 "wheelset.z",           "wheelset.vz",           "track.irregularity_y",
                                 "track.irregularity_z", "track.irregularity_vy", "track.irregularity_vz"};
    for (int i = 0; i < kInputs; ++i) require(tm_case_find_number(names[i], &ids_[i]));
  }
  ~Contact() {
    tm_pair_free(pair_);
    tm_case_free(case_);
  }
  Contact(const Contact&) = delete;
  Contact& operator=(const Contact&) = delete;

  /// Height of the wheelset at which the wheel presses so hard, and the lateral force then.
  std::pair<double, double> rest(double load, const Vec3& rail) {
    set({0.0, kPitch, -kSpeed / kRadius, 0.0, 0.0, rail[1], rail[2], 0.0, 0.0});
    require(tm_case_set_number(case_, "wheelset.vertical_force", load));  // in place of the height
    const auto [z, fy, fz] = solve();
    return {z, fy};
  }

  Vec3 force(double time, double z, double vz, const Vec3& rail, const Vec3& v_rail) {
    const double rate = -kSpeed / kRadius;
    set({kSpeed * time, kPitch + rate * time, rate, z, vz, rail[1], rail[2], v_rail[1], v_rail[2]});
    const auto [z_again, fy, fz] = solve();
    return {0.0, fy, fz};
  }

 private:
  static constexpr int kInputs = 9;

  void set(const std::array<double, kInputs>& values) {
    for (int i = 0; i < kInputs; ++i) require(tm_case_set_number_by_id(case_, ids_[i], values[i]));
  }
  /// Height of the wheelset, lateral and vertical force on the rail.
  std::array<double, 3> solve() {
    tm_solution* solution = nullptr;
    const tm_status end = tm_pair_solve(pair_, case_, &solution);
    require(end);
    std::array<double, 3> out{};
    const char* const names[] = {"wheelset.z", "force_on_rail.fy_tr", "force_on_rail.fz_tr"};
    for (int i = 0; i < 3; ++i) require(tm_solution_number(solution, names[i], &out[i]));
    const std::string why = end == TM_OK || end == TM_NO_CONTACT ? "" : tm_solution_message(solution);
    tm_solution_free(solution);
    if (!why.empty()) throw std::runtime_error(why);
    if (end == TM_NO_CONTACT) out[1] = out[2] = 0.0;
    return out;
  }

  tm_case* case_ = nullptr;
  tm_pair* pair_ = nullptr;
  int ids_[kInputs] = {};
};

/// The contact as a force of Simbody.
class ContactForce : public Force::Custom::Implementation {
 public:
  ContactForce(Contact& contact, const MobilizedBody& wheelset, const MobilizedBody& rail)
      : contact_(contact), wheelset_(wheelset), rail_(rail) {}

  Vec3 on_rail(const State& s) const {
    return contact_.force(s.getTime(), wheelset_.getBodyOriginLocation(s)[2], wheelset_.getBodyOriginVelocity(s)[2],
                          rail_.getBodyOriginLocation(s), rail_.getBodyOriginVelocity(s));
  }
  void calcForce(const State& s, Vector_<SpatialVec>& body_forces, Vector_<Vec3>&, Vector&) const override {
    const Vec3 force = on_rail(s);
    rail_.applyBodyForce(s, SpatialVec(Vec3(0), force), body_forces);
    wheelset_.applyBodyForce(s, SpatialVec(Vec3(0), Vec3(0, 0, -force[2])), body_forces);  // guided: z only
  }
  Real calcPotentialEnergy(const State&) const override { return 0.0; }

 private:
  Contact& contact_;
  const MobilizedBody &wheelset_, &rail_;
};

/// A damper whose end is held by a spring; its own travel is a state of the system.
class SpringAndDamper : public Force::Custom::Implementation {
 public:
  SpringAndDamper(const GeneralForceSubsystem& forces, const MobilizedBody& between)
      : forces_(forces), between_(between) {}

  void set_travel(State& s, double travel) const { forces_.updZ(s)[travel_] = travel; }
  void realizeTopology(State& s) const override { travel_ = forces_.allocateZ(s, Vector(1, Real(0))); }
  void realizeAcceleration(const State& s) const override { forces_.updZDot(s)[travel_] = spring_force(s) / kDamper; }
  void calcForce(const State& s, Vector_<SpatialVec>&, Vector_<Vec3>&, Vector& mobility_forces) const override {
    between_.applyOneMobilityForce(s, 2, -spring_force(s), mobility_forces);
  }
  Real calcPotentialEnergy(const State&) const override { return 0.0; }

 private:
  double spring_force(const State& s) const { return kDamperEnd * (between_.getOneQ(s, 2) - forces_.getZ(s)[travel_]); }
  const GeneralForceSubsystem& forces_;
  const MobilizedBody& between_;
  mutable ZIndex travel_;
};

int run() {
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  const auto body = [](double mass) { return Body::Rigid(MassProperties(mass, Vec3(0), UnitInertia(1))); };
  // Bodies that can move in any direction; nothing but the forces below moves them.
  MobilizedBody::Translation load(matter.Ground(), body(kLoad));
  MobilizedBody::Translation wheelset(load, body(kWheelset));
  MobilizedBody::Translation left(matter.Ground(), body(kRail)), right(matter.Ground(), body(kRail));

  Force::ConstantForce(forces, load, Vec3(0), Vec3(0, 0, kLoad * kGravity));
  Force::ConstantForce(forces, wheelset, Vec3(0), Vec3(0, 0, kWheelset * kGravity));
  Force::MobilityLinearSpring(forces, wheelset, MobilizerQIndex(2), kPrimary, 0.0);
  auto* damper = new SpringAndDamper(forces, wheelset);
  Force::Custom(forces, damper);
  for (const auto* rail : {&left, &right}) {
    Force::MobilityLinearSpring(forces, *rail, MobilizerQIndex(1), kSupportY, 0.0);
    Force::MobilityLinearDamper(forces, *rail, MobilizerUIndex(1), kSupportDampingY);
    Force::MobilityLinearSpring(forces, *rail, MobilizerQIndex(2), kSupportZ, 0.0);
    Force::MobilityLinearDamper(forces, *rail, MobilizerUIndex(2), kSupportDampingZ);
  }
  Contact left_contact(true, true), right_contact(false, false);
  auto *left_force = new ContactForce(left_contact, wheelset, left),
       *right_force = new ContactForce(right_contact, wheelset, right);
  Force::Custom(forces, left_force);
  Force::Custom(forces, right_force);

  // At rest: the rails carry the weights, and the wheelset is as low as its wheels must be for that.
  State state = system.realizeTopology();
  const double wheel_load = 0.5 * (kLoad + kWheelset) * kGravity, sunk = wheel_load / kSupportZ;
  double z = 0.0, side = 0.0;
  for (int i = 0; i < 10; ++i) {
    const auto [height, lateral] = right_contact.rest(wheel_load, Vec3(0, side, sunk));
    z = height, side = lateral / kSupportY;
  }
  left.setOneQ(state, 1, -side), right.setOneQ(state, 1, side);
  left.setOneQ(state, 2, sunk), right.setOneQ(state, 2, sunk);
  const double pressed = -kLoad * kGravity / kPrimary;
  wheelset.setOneQ(state, 2, pressed), load.setOneQ(state, 2, z - pressed);
  damper->set_travel(state, pressed);

  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(1e-5);
  integrator.setMaximumStepSize(1e-4);
  integrator.setReturnEveryInternalStep(true);
  integrator.initialize(state);
  double largest = 0.0, at = 0.0, at_rest = 0.0;
  while (integrator.getTime() < kDistance / kSpeed) {
    integrator.stepTo(kDistance / kSpeed);
    system.realize(integrator.getState(), Stage::Velocity);
    const double force = left_force->on_rail(integrator.getState())[2];
    if (at_rest == 0.0) at_rest = force;
    if (force > largest) largest = force, at = integrator.getTime();
  }
  std::printf("static %.1f N\nlargest %.1f N after %.4f m\nsteps %d\n", at_rest, largest, kSpeed * at,
              integrator.getNumStepsTaken());
  return 0;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
