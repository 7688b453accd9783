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

bool failed(const ContactReaction& r) { return r.status == Status::failed || r.status == Status::not_converged; }

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

void add_rail(ContactReaction& r, const MovingRail::Moved& moved, double force) {
  r.on_wheelset.force.x() += force * moved.slope;
  r.elastic_energy += moved.energy;
  r.frictional_power += moved.power;
  r.rail_power = moved.power;
}

void soften(ContactReaction& r, double by) {
  for (PatchTangent& patch : r.tangents) patch.stiffness_n /= by;
}

}  // namespace

ContactOnRail::ContactOnRail(std::shared_ptr<ContactElement> contact, MovingRail rail, double load, double tolerance)
    : contact_(std::move(contact)), rail_(std::move(rail)), load_(load), tolerance_(tolerance) {
  if (!contact_) throw Error(ErrorKind::configuration, "a rail has no contact upon it");
  if (!(load > 0.0) || !(tolerance > 0.0))
    throw Error(ErrorKind::configuration, "load and tolerance of a contact on a rail must be positive");
}

ContactReaction ContactOnRail::evaluate(const PairMotion& motion) {
  return started_ ? moving(motion) : at_rest(motion);
}

ContactReaction ContactOnRail::at_rest(const PairMotion& motion) {
  constexpr int kMost = 40;
  const double compliance = rail_.at_rest().compliance;
  RailMotion bending;
  bending.z = compliance * load_;
  for (int i = 0; i < kMost; ++i) {
    ContactReaction r = contact_->evaluate(on_deflected(motion, bending));
    if (failed(r)) return r;
    const double force = r.on_rail.force.z(), stiffness = vertical_stiffness(r);
    const double softening = 1.0 + compliance * stiffness, off = compliance * force - bending.z;
    // What the force would still change by, also where there is none yet.
    if (std::abs(off) * std::max(stiffness, kLeastStiffness) / softening <=
        tolerance_ * std::max(load_, std::abs(force))) {
      trial_ = Trial{motion.time, force, 0.0, 0.0, 0.0};
      r.bending = bending;
      add_rail(r, rail_.moved_at_rest(force), force);
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
  if (!(last_.time > before_.time)) return last_.force;
  return last_.force + (motion.time - last_.time) / (last_.time - before_.time) * (last_.force - before_.force);
}

ContactReaction ContactOnRail::moving(const PairMotion& motion) {
  const MovingRail::Answer answer = rail_.after(motion.time);
  const double predicted = std::max(0.0, predicted_force(motion));
  RailMotion bending;
  bending.z = answer.free + answer.compliance * predicted;
  bending.vz = rail_.rate(predicted);
  ContactReaction r = contact_->evaluate(on_deflected(motion, bending));
  if (failed(r)) return r;

  const double found = r.on_rail.force.z(), stiffness = vertical_stiffness(r);
  const double softening = 1.0 + answer.compliance * stiffness;
  const double lower = answer.compliance * (found - predicted) / softening;  // the rail
  const double force = found - stiffness * lower;
  if (found > 0.0) scale(r, force / found);
  r.corrected = std::abs(lower) * std::max(stiffness, kLeastStiffness);
  r.elastic_energy -= 0.5 * (found + force) * lower;
  bending.z += lower;
  bending.vz = rail_.rate(force);
  r.bending = bending;
  soften(r, softening);
  trial_ = Trial{motion.time, force, height_of(motion, r.contact_y), r.contact_y, stiffness / softening};

  add_rail(r, rail_.moved(force), force);
  return r;
}

void ContactOnRail::accept() {
  contact_->accept();
  const Instant now{trial_->time, trial_->force};
  if (started_)
    rail_.accept(now.force);
  else
    rail_.begin(now.force);
  before_ = started_ ? last_ : now;
  last_ = now;
  started_ = true;
  trial_.reset();
}

void ContactOnRail::save(ByteWriter& out) const {
  out.put(started_);
  for (const Instant& instant : {last_, before_}) out.put(instant.time), out.put(instant.force);
  rail_.save(out);
  contact_->save(out);
}

void ContactOnRail::restore(ByteReader& in) {
  in.get(started_);
  for (Instant* instant : {&last_, &before_}) in.get(instant->time), in.get(instant->force);
  trial_.reset();
  rail_.restore(in);
  contact_->restore(in);
}

}  // namespace treadmark::vehicle
