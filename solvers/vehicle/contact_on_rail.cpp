// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contact_on_rail.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

ContactOnRail::ContactOnRail(std::shared_ptr<ContactElement> contact, MovingRail rail, double load, double tolerance)
    : contact_(std::move(contact)), rail_(std::move(rail)), load_(load), tolerance_(tolerance) {
  if (!contact_) throw Error(ErrorKind::configuration, "a rail has no contact upon it");
  if (!(load > 0.0) || !(tolerance > 0.0))
    throw Error(ErrorKind::configuration, "load and tolerance of a contact on a rail must be positive");
}

ContactReaction ContactOnRail::evaluate(const PairMotion& motion) {
  constexpr int kMost = 40;
  const MovingRail::Answer answer = started_ ? rail_.after(motion.time) : rail_.at_rest();
  double w = answer.free + answer.compliance * std::max(0.0, started_ ? 2.0 * accepted_force_ - force_before_ : load_);
  for (int i = 0; i < kMost; ++i) {
    PairMotion m = motion;
    RailMotion bending;
    bending.z = w;
    if (started_) bending.vz = rail_.rate(answer.compliance > 0.0 ? (w - answer.free) / answer.compliance : force_);
    m.rail.z += bending.z;
    m.rail.vz += bending.vz;
    ContactReaction r = contact_->evaluate(m);
    if (r.status == Status::failed || r.status == Status::not_converged) return r;
    force_ = r.on_rail.force.z();
    deflection_ = w;
    double stiffness = 0.0;
    for (const PatchTangent& patch : r.tangents) {
      const double down = patch.X_TC.rotation(2, 2);
      stiffness += patch.stiffness_n * down * down;
    }
    const double softening = 1.0 + answer.compliance * stiffness;
    const double off = answer.free + answer.compliance * force_ - w;
    // What the force would still change by, also where there is none yet.
    constexpr double kLeastStiffness = 1e8;
    if (std::abs(off) * std::max(stiffness, kLeastStiffness) / softening <=
        tolerance_ * std::max(load_, std::abs(force_))) {
      r.bending = bending;
      for (PatchTangent& patch : r.tangents) patch.stiffness_n /= softening;
      if (started_) {
        const MovingRail::Moved moved = rail_.moved(force_);
        r.on_wheelset.force.x() += force_ * moved.slope;
        r.elastic_energy += moved.energy;
        r.frictional_power += moved.power;
        r.rail_power = moved.power;
      } else {
        r.elastic_energy += 0.5 * answer.compliance * force_ * force_;
      }
      return r;
    }
    w += off / softening;
  }
  ContactReaction failed;
  failed.status = Status::not_converged;
  failed.message = "contact force and deflection of the rail did not come to agree";
  return failed;
}

void ContactOnRail::accept() {
  contact_->accept();
  if (started_)
    rail_.accept(force_);
  else
    rail_.begin(force_);
  force_before_ = started_ ? accepted_force_ : force_;
  accepted_force_ = force_;
  started_ = true;
}

void ContactOnRail::save(ByteWriter& out) const {
  out.put(started_);
  for (const double value : {force_, deflection_, accepted_force_, force_before_}) out.put(value);
  rail_.save(out);
  contact_->save(out);
}

void ContactOnRail::restore(ByteReader& in) {
  in.get(started_);
  for (double* value : {&force_, &deflection_, &accepted_force_, &force_before_}) in.get(*value);
  rail_.restore(in);
  contact_->restore(in);
}

}  // namespace treadmark::vehicle
