// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contact_on_rail.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

/// Of a contact, also of one that does not touch yet [N/m].
constexpr double kLeastStiffness = 1e8;

double vertical_stiffness(const ContactReaction& r) {
  double stiffness = 0.0;
  for (const PatchTangent& patch : r.tangents) {
    const double down = patch.X_TC.rotation(2, 2);
    stiffness += patch.stiffness_n * down * down;
  }
  return stiffness;
}

PairMotion on_deflected(PairMotion motion, const RailMotion& bending) {
  motion.rail.z += bending.z;
  motion.rail.vz += bending.vz;
  return motion;
}

double height_of(const PairMotion& motion, double contact_y) {
  return motion.wheelset.z + contact_y * motion.wheelset.roll - motion.rail.z;
}

/// All forces of a reaction by the same share.
void scale(ContactReaction& r, double by) {
  for (wheelrail::Wrench* wrench : {&r.on_rail, &r.on_wheelset}) {
    wrench->force *= by;
    wrench->moment *= by;
  }
  for (double* force : {&r.normal_force, &r.lateral_creep_force, &r.longitudinal_creep_force}) *force *= by;
}

void soften(ContactReaction& r, double by) {
  for (PatchTangent& patch : r.tangents) patch.stiffness_n /= by;
}

}  // namespace

ContactOnRail::ContactOnRail(std::shared_ptr<ContactElement> contact, std::shared_ptr<LoadedRail> rail,
                             std::size_t wheel, double tolerance)
    : contact_(std::move(contact)), rail_(std::move(rail)), wheel_(wheel), tolerance_(tolerance) {
  if (!contact_) throw Error(ErrorKind::configuration, "a rail has no contact upon it");
  if (!rail_ || wheel >= rail_->wheels()) throw Error(ErrorKind::configuration, "a contact has no rail below it");
  if (!(tolerance > 0.0))
    throw Error(ErrorKind::configuration, "the tolerance of a contact on a rail must be positive");
}

ContactReaction ContactOnRail::evaluate(const PairMotion& motion) {
  return rail_->started() ? moving(motion) : at_rest(motion);
}

ContactReaction ContactOnRail::at_rest(const PairMotion& motion) {
  constexpr int kMost = 40;
  const LoadedRail::Answer answer = rail_->at_rest(wheel_);
  const double load = rail_->load(wheel_);
  RailMotion bending;
  bending.z = answer.deflection(load);
  for (int i = 0; i < kMost; ++i) {
    ContactReaction r = contact_->evaluate(on_deflected(motion, bending));
    if (is_unsolved(r)) return r;
    const double force = r.on_rail.force.z(), stiffness = vertical_stiffness(r);
    const double softening = 1.0 + answer.compliance * stiffness, off = answer.deflection(force) - bending.z;
    // What the force would still change by, also where there is none yet.
    if (std::abs(off) * std::max(stiffness, kLeastStiffness) / softening <=
        tolerance_ * std::max(load, std::abs(force))) {
      trial_ = Trial{motion.time, force, 0.0, 0.0, stiffness / softening, softening, answer};
      rail_->press(wheel_, force, trial_->stiffness);
      r.give = answer.compliance * (load - force);
      r.bending = bending;
      soften(r, softening);
      return r;
    }
    bending.z += off / softening;
  }
  ContactReaction r;
  r.status = Status::not_converged;
  r.message = "contact force and deflection of the rail did not come to agree";
  return r;
}

double ContactOnRail::predicted_force(const PairMotion& motion) const {
  // Again at the same time, for another motion of the wheel.
  if (trial_ && trial_->time == motion.time)
    return trial_->force + trial_->stiffness * (height_of(motion, trial_->contact_y) - trial_->height);
  return rail_->counted_on(wheel_, motion.time);
}

ContactReaction ContactOnRail::moving(const PairMotion& motion) {
  const LoadedRail::Answer answer = rail_->after(wheel_, motion.time);
  const double predicted = std::max(0.0, predicted_force(motion));
  RailMotion bending;
  bending.z = answer.deflection(predicted);
  bending.vz = answer.rate_under(predicted);
  ContactReaction r = contact_->evaluate(on_deflected(motion, bending));
  if (is_unsolved(r)) return r;

  const double found = r.on_rail.force.z(), stiffness = vertical_stiffness(r);
  const double softening = 1.0 + answer.compliance * stiffness;
  const double lower = answer.compliance * (found - predicted) / softening;  // the rail
  const double force = found - stiffness * lower;
  if (found > 0.0) scale(r, force / found);
  r.corrected = std::abs(lower) * std::max(stiffness, kLeastStiffness);
  r.elastic_energy -= 0.5 * (found + force) * lower;
  bending.z += lower;
  bending.vz = answer.rate_under(force);
  r.bending = bending;
  soften(r, softening);
  trial_ =
      Trial{motion.time, force, height_of(motion, r.contact_y), r.contact_y, stiffness / softening, softening, answer};
  rail_->press(wheel_, force, trial_->stiffness);
  r.on_wheelset.force.x() += force * rail_->slope(wheel_, force, answer);
  return r;
}

bool ContactOnRail::settle(ContactReaction& r) {
  const Trial& t = *trial_;
  const double missed =
      std::abs(rail_->missed(wheel_, t.answer)) * std::max(t.stiffness, kLeastStiffness / t.softening);
  if (speaks_for_rail()) {
    const MovingRail::Moved rail = rail_->moved();
    r.elastic_energy += rail.energy;
    r.frictional_power += rail.power;
    r.rail_power = rail.power;
    rail_->settle(t.time);
  }
  if (!rail_->started()) return missed <= tolerance_ * std::max(rail_->load(wheel_), std::abs(t.force));
  r.corrected += missed;
  return true;
}

void ContactOnRail::accept() {
  contact_->accept();
  if (speaks_for_rail()) rail_->accept(trial_->time);
  trial_.reset();
}

void ContactOnRail::save(ByteWriter& out) const {
  if (speaks_for_rail()) rail_->save(out);
  contact_->save(out);
}

void ContactOnRail::restore(ByteReader& in) {
  trial_.reset();
  if (speaks_for_rail()) rail_->restore(in);
  contact_->restore(in);
}

}  // namespace treadmark::vehicle
