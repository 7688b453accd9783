// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/contact_on_rail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <Eigen/LU>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

/// Of a contact, also of one that does not touch yet [N/m].
constexpr double kLeastStiffness = 1e8;
/// Moments about the rail's top are compared with forces at this arm [m].
constexpr double kArm = 0.1;

PairMotion on_deflected(PairMotion motion, const RailMotion& by) {
  RailMotion& rail = motion.rail;
  rail.y += by.y, rail.z += by.z, rail.roll += by.roll;
  rail.vy += by.vy, rail.vz += by.vz, rail.vroll += by.vroll;
  return motion;
}

RailMotion bending_under(const LoadedRail::Answer& answer, const Vec3& force) {
  const Vec3 q = answer.motion(force), v = answer.rate_under(force);
  return {q.x(), q.y(), q.z(), v.x(), v.y(), v.z()};
}

Vec3 force_on_top(const ContactReaction& r) { return {r.on_rail.force.y(), r.on_rail.force.z(), r.on_rail.moment.x()}; }

/// Motion of a point along a direction by y, z and roll of its body; arm: from the origin of the body's axes.
Vec3 along(const Vec3& direction, const Vec3& arm) {
  return {direction.y(), direction.z(), arm.y() * direction.z() - arm.z() * direction.y()};
}

Vec3 top(double y, double z, double roll) { return {y, z, roll}; }

Vec3 rates(const wheelrail::SixMotion& wheelset) { return {wheelset.y, wheelset.z, wheelset.roll}; }

Vec3 rates(const RailMotion& rail) { return {rail.vy, rail.vz, rail.vroll}; }

double size_of(const Vec3& force) { return (Vec3(1.0, 1.0, 1.0 / kArm).cwiseProduct(force)).cwiseAbs().maxCoeff(); }

/// Change of the forces by what they are off, also where there is no contact yet.
double change_by(const Vec3& change, const Vec3& moved, double softening) {
  return std::max(size_of(change), std::abs(moved.y()) * kLeastStiffness / softening);
}

}  // namespace

ContactOnRail::ContactOnRail(std::shared_ptr<ContactElement> contact, std::shared_ptr<LoadedRail> rail,
                             std::size_t wheel, double tolerance, const Vec3& marker, double radius)
    : contact_(std::move(contact)),
      rail_(std::move(rail)),
      wheel_(wheel),
      tolerance_(tolerance),
      marker_(marker),
      radius_(radius) {
  if (!contact_) throw Error(ErrorKind::configuration, "a rail has no contact upon it");
  if (!rail_ || wheel >= rail_->wheels()) throw Error(ErrorKind::configuration, "a contact has no rail below it");
  if (!(tolerance > 0.0))
    throw Error(ErrorKind::configuration, "the tolerance of a contact on a rail must be positive");
}

ContactReaction ContactOnRail::evaluate(const PairMotion& motion) {
  return rail_->started() ? moving(motion) : at_rest(motion);
}

/// motion: with the deflection at which the reaction was evaluated.
ContactOnRail::Tangents ContactOnRail::tangents_of(const ContactReaction& r, const PairMotion& motion,
                                                   const LoadedRail::Answer& answer) const {
  const Vec3 marker = marker_ + Vec3(0.0, motion.rail.y, motion.rail.z),
             centre(0.0, motion.wheelset.y, motion.wheelset.z - radius_);
  Tangents t;
  for (const PatchTangent& patch : r.tangents) {
    const Vec3 on_rail = patch.X_TC.origin - marker, on_wheel = patch.X_TC.origin - centre,
               normal = patch.X_TC.rotation.col(2), aside = patch.X_TC.rotation.col(1);
    const Tangents::Patch& p =
        t.patches.emplace_back(Tangents::Patch{on_rail, on_wheel, along(normal, on_rail), along(aside, on_rail),
                                               along(normal, on_wheel), along(aside, on_wheel)});
    t.stiffness += patch.stiffness_n * p.normal * p.normal.transpose();
    t.damping += patch.damping_s * p.aside * p.aside.transpose();
    t.wheel_stiffness += patch.stiffness_n * p.normal * p.wheel_normal.transpose();
    t.wheel_damping += patch.damping_s * p.aside * p.wheel_aside.transpose();
  }
  // Beside slip that turns round creep forces rise more than where friction is used up: the secant of two evaluations
  // knows. It never makes tangents less steep, or forces would count as agreed that belong to slip of the other
  // direction.
  t.creep_force = r.lateral_creep_force;
  double rise = 0.0;
  for (std::size_t i = 0; i < t.patches.size(); ++i) {
    const double slip =
        t.patches[i].wheel_aside.dot(rates(motion.wheelset_velocity)) - t.patches[i].aside.dot(rates(motion.rail));
    t.slip.push_back(slip);
    if (rail_->started() && is_again(motion.time) && trial_->tangents.slip.size() == t.patches.size())
      rise += r.tangents[i].damping_s * (slip - trial_->tangents.slip[i]);
  }
  constexpr double kSteepest = 1e4;
  if (rise != 0.0) {
    const double share = std::clamp((t.creep_force - trial_->tangents.creep_force) / rise, 1.0, kSteepest);
    t.share = share;
    t.damping *= share;
    t.wheel_damping *= share;
  }
  t.by_force = t.stiffness * answer.compliance + t.damping * answer.rate_by_force;
  t.together = (Mat3::Identity() + t.by_force).inverse();
  return t;
}

/// Brings a reaction that was found under predicted forces to agreement with the rail: motions and forces are those at
/// which the tangents meet the rail's answer. Presses these forces on the rail.
void ContactOnRail::agree(ContactReaction& r, const PairMotion& motion, const LoadedRail::Answer& answer,
                          const Vec3& predicted, Tangents t) {
  const Vec3 found = force_on_top(r), off = found - predicted, more = t.together * off, force = predicted + more;
  const Vec3 moved = answer.compliance * more, rate = answer.rate_by_force * more;
  r.corrected = change_by(t.by_force * more, moved, 1.0);
  for (std::size_t i = 0; i < t.patches.size(); ++i) {
    const Tangents::Patch& p = t.patches[i];
    PatchTangent& patch = r.tangents[i];
    const double deeper = -p.normal.dot(moved), normal = patch.stiffness_n * deeper,
                 aside = -t.share * patch.damping_s * p.aside.dot(rate);
    const Vec3 change = normal * patch.X_TC.rotation.col(2) + aside * patch.X_TC.rotation.col(1);
    r.on_rail += {change, p.on_rail.cross(change)};
    r.on_wheelset += {-change, -p.on_wheel.cross(change)};
    r.normal_force += normal;
    r.lateral_creep_force += aside;
    r.elastic_energy += (patch.normal_force + 0.5 * normal) * deeper;
    patch.normal_force += normal;
  }
  for (PatchTangent& patch : r.tangents) patch.damping_s *= t.share;
  // The wheel meets each contact upon a rail that gives way under all of them.
  const auto soften = [&](double PatchTangent::*steepness, Vec3 Tangents::Patch::*direction, const Mat3& gives) {
    std::vector<double> by;
    for (const Tangents::Patch& p : t.patches) {
      double& sum = by.emplace_back(1.0);
      for (std::size_t i = 0; i < t.patches.size(); ++i)
        sum += std::max(0.0, r.tangents[i].*steepness * (p.*direction).dot(gives * t.patches[i].*direction));
    }
    for (std::size_t i = 0; i < t.patches.size(); ++i) r.tangents[i].*steepness /= by[i];
  };
  soften(&PatchTangent::stiffness_n, &Tangents::Patch::normal, answer.compliance);
  soften(&PatchTangent::damping_s, &Tangents::Patch::aside, answer.rate_by_force);
  r.bending = bending_under(answer, force);
  rail_->press(wheel_, force, t.together * t.stiffness, motion.wheelset.x);
  Vec3 normal_force = Vec3::Zero();
  for (std::size_t i = 0; i < t.patches.size(); ++i) normal_force += r.tangents[i].normal_force * t.patches[i].normal;
  trial_ = Trial{
      {motion.time, force, top(motion.wheelset.y, motion.wheelset.z, motion.wheelset.roll),
       top(motion.wheelset_velocity.y, motion.wheelset_velocity.z, motion.wheelset_velocity.roll),
       top(motion.rail.y, motion.rail.z, motion.rail.roll) + moved,
       top(motion.rail.vy, motion.rail.vz, motion.rail.vroll) + rate, normal_force,
       drift_with(motion.time, off, !t.patches.empty()), t.stiffness, t.damping, t.wheel_stiffness, t.wheel_damping},
      std::move(t),
      answer};
}

ContactReaction ContactOnRail::at_rest(const PairMotion& motion) {
  constexpr int kMost = 40;
  constexpr double kWish = 0.01;  // of the tolerance
  const LoadedRail::Answer answer = rail_->at_rest(wheel_);
  const double load = rail_->load(wheel_);
  Vec3 force(0.0, load, 0.0);
  double share = 1.0, last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMost; ++i) {
    const PairMotion deflected = on_deflected(motion, bending_under(answer, force));
    ContactReaction r = contact_->evaluate(deflected);
    if (is_unsolved(r)) return r;
    Tangents t = tangents_of(r, deflected, answer);
    const Vec3 found = force_on_top(r), more = t.together * (found - force);
    const double off = change_by(t.by_force * more, answer.compliance * more, 1.0),
                 allowed = tolerance_ * std::max(load, size_of(found));
    const bool falls = off < last;
    if (off <= kWish * allowed || (off <= allowed && !falls)) {
      agree(r, deflected, answer, force, std::move(t));
      r.give = answer.compliance(1, 1) * (load - r.on_rail.force.z());
      return r;
    }
    constexpr double kLeastShare = 0.1;
    if (!falls) share = std::max(kLeastShare, 0.5 * share);
    last = off;
    force += share * more;
  }
  ContactReaction r;
  r.status = Status::not_converged;
  r.message = "contact force and deflection of the rail did not converge";
  return r;
}

/// Drift by a force that was found beyond the one predicted for a time. Where contact begins or ends there is none.
Vec3 ContactOnRail::drift_with(double time, const Vec3& off, bool touching) const {
  if (!(time > last_.time && touching && last_.force.y() > 0.0)) return Vec3::Zero();
  return (is_again(time) ? trial_->found.drift : last_.drift) + off / (time - last_.time);
}

/// By what was found before, at this time or at that of the last instant.
Vec3 ContactOnRail::predicted_force(const PairMotion& motion, const LoadedRail::Answer& answer) const {
  const Found& from = is_again(motion.time) ? trial_->found : last_;
  const auto& [q, v, rail] = std::tie(motion.wheelset, motion.wheelset_velocity, motion.rail);
  const Vec3 wheel = top(q.y, q.z, q.roll) - from.wheel, wheel_rate = top(v.y, v.z, v.roll) - from.wheel_rate,
             moved = top(rail.y, rail.z, rail.roll) + answer.motion(from.force) - from.rail,
             rate = top(rail.vy, rail.vz, rail.vroll) + answer.rate_under(from.force) - from.rail_rate;
  const Mat3 by_force = from.stiffness * answer.compliance + from.damping * answer.rate_by_force;
  const Vec3 change = from.wheel_stiffness * wheel + from.wheel_damping * wheel_rate - from.stiffness * moved -
                      from.damping * rate + (motion.time - from.time) * from.drift;
  const Vec3 force = from.force + (Mat3::Identity() + by_force).inverse() * change;
  return force.y() > 0.0 ? force : Vec3(Vec3::Zero());
}

ContactReaction ContactOnRail::moving(const PairMotion& motion) {
  const LoadedRail::Answer answer = rail_->after(wheel_, motion.time);
  const Vec3 predicted = predicted_force(motion, answer);
  const PairMotion deflected = on_deflected(motion, bending_under(answer, predicted));
  ContactReaction r = contact_->evaluate(deflected);
  if (is_unsolved(r)) return r;
  agree(r, deflected, answer, predicted, tangents_of(r, deflected, answer));
  // What presses feels the slope, which is that of the step, by its mean; creep is that against the rail's own motion.
  r.on_wheelset.force.x() +=
      0.5 * (last_.normal + trial_->found.normal).dot(rail_->slope(wheel_, trial_->found.force, answer));
  return r;
}

bool ContactOnRail::settle(ContactReaction& r) {
  const Trial& t = *trial_;
  const Vec3 moved = rail_->missed(wheel_, t.answer);
  const double missed =
      change_by(t.tangents.together * (t.tangents.stiffness * moved), moved, 1.0 + t.tangents.by_force(1, 1));
  if (speaks_for_rail()) {
    const MovingRail::Moved rail = rail_->moved();
    r.elastic_energy += rail.energy;
    r.frictional_power += rail.power;
    r.rail_power = rail.power;
    rail_->settle(t.found.time);
  }
  if (!rail_->started()) return missed <= tolerance_ * std::max(rail_->load(wheel_), size_of(t.found.force));
  r.corrected += missed;
  return true;
}

void ContactOnRail::accept() {
  contact_->accept();
  if (speaks_for_rail()) rail_->accept(trial_->found.time);
  last_ = trial_->found;
  trial_.reset();
}

void ContactOnRail::save(ByteWriter& out) const {
  if (speaks_for_rail()) rail_->save(out);
  Found::each_number(last_, [&out](double number) { out.put(number); });
  contact_->save(out);
}

void ContactOnRail::restore(ByteReader& in) {
  trial_.reset();
  if (speaks_for_rail()) rail_->restore(in);
  Found::each_number(last_, [&in](double& number) { in.get(number); });
  contact_->restore(in);
}

}  // namespace treadmark::vehicle
