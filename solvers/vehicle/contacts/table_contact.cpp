// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/vehicle/contacts/creep_law.hpp"
#include "treadmark/solvers/vehicle/contacts/elastic_contact.hpp"

namespace treadmark::vehicle {
namespace {

constexpr std::uint32_t kMark = 0x54424c31;  // what saved states of this element begin with

void require_finite(const PairMotion& m) {
  const RailMotion& r = m.rail;
  double sum = r.y + r.z + r.roll + r.vy + r.vz + r.vroll;
  for (const wheelrail::SixMotion* q : {&m.wheelset, &m.wheelset_velocity})
    sum += q->x + q->y + q->z + q->roll + q->yaw + q->pitch;
  if (!std::isfinite(sum)) throw Error(ErrorKind::configuration, "a motion of wheel or rail is not a finite number");
}

void flip(wheelrail::SixMotion& q) { q.y = -q.y, q.roll = -q.roll, q.yaw = -q.yaw; }

PairMotion mirrored(PairMotion m) {
  flip(m.wheelset);
  flip(m.wheelset_velocity);
  for (double* value : {&m.rail.y, &m.rail.roll, &m.rail.vy, &m.rail.vroll, &m.curvature}) *value = -*value;
  return m;
}

ContactReaction mirrored(ContactReaction r) {
  const wheelrail::Wrenches seen = wheelrail::mirrored(wheelrail::Wrenches{r.on_rail, {}, r.on_wheelset, {}});
  r.on_rail = seen.track;
  r.on_wheelset = seen.wheelset;
  r.lateral_creep_force = -r.lateral_creep_force;
  r.spin_moment = -r.spin_moment;
  r.contact_y = -r.contact_y;
  for (PatchTangent& t : r.tangents) {
    t.X_TC.origin.y() = -t.X_TC.origin.y();
    t.X_TC.rotation.row(1) *= -1.0;
    t.X_TC.rotation.col(1) *= -1.0;
  }
  return r;
}

wheelrail::Placement placed(const ContactTable& table, const PairMotion& m) {
  const wheelrail::Placement& nominal = table.nominal();
  wheelrail::Placement now;
  now.X_TR = {nominal.X_TR.origin + Vec3(0.0, m.rail.y, m.rail.z), rotation_x(m.rail.roll) * nominal.X_TR.rotation};
  const Vec3 centre = nominal.X_TWs.origin + Vec3(0.0, m.wheelset.y, m.wheelset.z);
  now.X_TWs = {centre, rotation_x(m.wheelset.roll) * rotation_z(m.wheelset.yaw)};
  now.X_TW = now.X_TWs * (nominal.X_TWs.inverse() * nominal.X_TW);
  return now;
}

/// Seen from the rail, so that a motion of both bodies as one changes nothing.
RelativePlace relative_place(const wheelrail::Placement& nominal, const wheelrail::Placement& now,
                             const PairMotion& m) {
  const Vec3 at_rest = nominal.X_TW.origin - nominal.X_TR.origin;
  const Vec3 moved = rotation_x(-m.rail.roll) * (now.X_TW.origin - now.X_TR.origin) - at_rest;
  return {moved.y(), moved.z(), m.wheelset.roll - m.rail.roll, m.wheelset.yaw};
}

/// Where the normal meets the axle: the pressure of a round wheel has no moment about it, also where yaw moves the
/// contact ahead or behind. There a rail that bends has another direction, and so has the normal.
void put_below_the_axle(Pose& X_TC, const Pose& X_TWs, double curvature) {
  constexpr int kTimes = 2;  // the direction changes by less than a thousandth
  const Mat3 upright = X_TC.rotation;
  const Vec3 arm = X_TC.origin - X_TWs.origin;
  for (int i = 0; i < kTimes; ++i) {
    const Vec3 across = X_TC.rotation.col(2).cross(X_TWs.rotation.col(1));
    const double x = -(arm.y() * across.y() + arm.z() * across.z()) / across.x();
    X_TC.origin.x() = X_TWs.origin.x() + x;
    if (curvature == 0.0) return;
    X_TC.rotation = rotation_z(curvature * x) * upright;
  }
}

ContactReaction not_covered(const ContactTable& table, const RelativePlace& place, const std::optional<SheetEnd>& end) {
  ContactReaction r;
  r.status = Status::failed;
  const auto turned = [&](const char* how, double angle, const TableAngles& angles) {
    r.message = fmt::format("the wheel {} by {:.4g} mrad; the contact table reaches to {:.4g} mrad each way", how,
                            1e3 * angle, 1e3 * angles.reach());
    return r;
  };
  if (!table.roll().covers(place.roll)) return turned("rolls against the rail", place.roll, table.roll());
  if (!table.yaw().covers(place.yaw)) return turned("is yawed", place.yaw, table.yaw());
  if (!end) {
    r.message = fmt::format(
        "contact {:.4g} mm aside of the central position changes too much from roll to roll or yaw "
        "to yaw of the contact table: it needs more of them",
        1e3 * place.y);
    return r;
  }
  if (!table.grows()) {
    r.message = fmt::format(
        "the wheel stands {:.4g} mm aside of its central position over the rail (right-hand side), rolled against it "
        "by {:.4g} mrad; the contact table reaches from {:.4g} to {:.4g} mm",
        1e3 * place.y, 1e3 * place.roll, 1e3 * table.y_min(), 1e3 * table.y_max());
    return r;
  }
  if (const std::string unsolved = table.unsolved(end->y, end->sheet); !unsolved.empty()) {
    r.message = fmt::format(
        "the wheel stands {:.4g} mm aside of its central position over the rail (right-hand side), where the contact "
        "table has no answer; {}",
        1e3 * place.y, unsolved);
    return r;
  }
  r.derailed = true;
  r.message = fmt::format(
      "the {}: the wheel stands {:.4g} mm {} of its central position over the rail and {:.4g} mm {}",
      place.y > 0.0 ? "flange has climbed the rail" : "tread has left the rail", 1e3 * std::abs(place.y),
      place.y > 0.0 ? "outside" : "inside", 1e3 * std::abs(place.z), place.z < 0.0 ? "above it" : "below it");
  return r;
}

}  // namespace

TableContact::TableContact(std::shared_ptr<const ContactTable> table, wheelrail::Side side,
                           std::shared_ptr<const CreepTable> creep, FrictionAlong friction)
    : table_(std::move(table)), creep_(std::move(creep)), side_(side), friction_(std::move(friction)) {
  if (!table_) throw Error(ErrorKind::configuration, "a contact element has no table");
  problem_ = table_->problem();
  problem_.regime = kalker::Regime::steady;
  material_ = combine(problem_.material);
  if (!creep_) return;
  require_tabulated(problem_.material);
  if (creep_->poisson() != material_.poisson)
    throw Error(ErrorKind::configuration, "a table of creep forces is for another Poisson's ratio");
}

ContactReaction TableContact::evaluate(const PairMotion& motion) {
  require_finite(motion);
  if (side_ == wheelrail::Side::right) return evaluate_right_hand(motion);
  return mirrored(evaluate_right_hand(mirrored(motion)));
}

ContactReaction TableContact::under_load(PairMotion motion, double load) {
  motion.wheelset.z = 0.0;
  require_finite(motion);
  if (!(load > 0.0) || !std::isfinite(load))
    throw Error(ErrorKind::configuration, "the vertical load of a wheel must be positive and finite");
  const bool right = side_ == wheelrail::Side::right;
  if (!right) motion = mirrored(motion);
  // What the pressures carry, so that they and the friction carry the load: a secant.
  constexpr int kMost = 40;
  constexpr double kBalance = 1e-9;
  ContactReaction r;
  std::optional<LocalContact> local;
  double carried = load, before = 0.0, excess_before = 0.0;
  for (int i = 0; i < kMost; ++i) {
    // On a rail that rolls the place changes aside with the height.
    const RelativePlace place = relative_place(table_->nominal(), placed(*table_, motion), motion);
    if (!local || !local->is_at(place)) local.emplace(*table_, place);
    if (local->covered()) motion.wheelset.z += local->height_under_load(carried) - place.z;
    r = evaluate_right_hand(motion, &*local);
    if (r.status != Status::ok) break;
    r.wheelset_z = motion.wheelset.z;
    const double excess = r.on_rail.force.z() - load;
    if (std::abs(excess) <= kBalance * load) return right ? r : mirrored(r);
    if (!std::isfinite(excess)) break;
    const double slope = i == 0 ? 1.0 : (excess - excess_before) / (carried - before);
    before = carried, excess_before = excess;
    carried -= excess / (slope > 0.0 ? slope : 1.0);
    carried = std::clamp(carried, 0.2 * before, 5.0 * before);
  }
  if (!is_unsolved(r)) {
    r.status = Status::not_converged;
    r.message =
        fmt::format("no height gives the vertical load of {:.6g} N: friction on the flange carries the wheel", load);
  }
  return right ? r : mirrored(r);
}

ContactReaction TableContact::evaluate_right_hand(const PairMotion& motion, const LocalContact* local) {
  tried_ = motion.wheelset.x;
  const wheelrail::Placement now = placed(*table_, motion);
  const RelativePlace place = relative_place(table_->nominal(), now, motion);
  const ElasticContact elastic = local && local->is_at(place) ? local->at(place.z) : elastic_contact(*table_, place);
  if (!elastic.in_table) return not_covered(*table_, place, elastic.end);

  ContactReaction r;
  r.least_gap = -elastic.penetration;
  if (!(elastic.normal_force > 0.0)) {
    r.status = Status::no_contact;
    r.message = "wheel and rail do not touch";
    return r;
  }
  const Mat3 rolled = rotation_x(motion.rail.roll);
  // The arm ends on the undeformed wheel, the contact point lies on the rail.
  const auto pose = [&](double angle, double arm_y, double arm_z) {
    Pose X_TC{now.X_TW.origin + rolled * Vec3(0.0, arm_y, arm_z), rotation_x(angle + motion.rail.roll)};
    X_TC.origin -= elastic.penetration * X_TC.rotation.col(2);
    put_below_the_axle(X_TC, now.X_TWs, motion.curvature);
    return X_TC;
  };
  const Pose resultant = pose(std::atan(elastic.slope), elastic.arm_y, elastic.arm_z);
  // Friction takes what the creepages put in: forces act where these are those of both bodies.
  const auto act = [&](const Pose& X_TC, const Vec3& force, const Vec3& moment) {
    const Vec3 on_wheel = X_TC.apply({0.0, 0.0, elastic.penetration});
    r.on_rail += {force, (X_TC.origin - now.X_TR.origin).cross(force) + moment};
    r.on_wheelset += {-force, -((on_wheel - now.X_TWs.origin).cross(force) + moment)};
  };
  act(resultant, elastic.normal_force * resultant.rotation.col(2), Vec3::Zero());
  r.tangents.push_back({resultant, elastic.stiffness, 0.0, 0.0, elastic.normal_force});

  problem_.state.position = motion.wheelset;
  problem_.state.velocity = motion.wheelset_velocity;
  friction_.put(problem_.friction, motion.wheelset.x);
  problem_.track.vy = motion.rail.vy, problem_.track.vz = motion.rail.vz, problem_.track.vroll = motion.rail.vroll;
  double patches = 0.0;
  for (std::size_t i = 0; i < elastic.count; ++i) {
    const ElasticPart& part = elastic.parts[i];
    const double weight = part.weight;
    const Pose X_TC = pose(part.angle, part.arm_y, part.arm_z);
    const wheelrail::ContactKinematics creepage =
        wheelrail::contact_kinematics(problem_, now, X_TC, elastic.penetration);
    const FrictionLaw law = friction_at(problem_.friction_inclination, problem_.friction_laws,
                                        part.angle + motion.rail.roll, problem_.friction);
    const CreepContact patch{part.a, part.b, law.static_friction() * part.normal_force};
    const CreepForce creep =
        creep_ ? creep_force(*creep_, patch, material_, creepage) : creep_force(patch, material_, creepage);
    const Vec2 friction = weight * creep.force, damping = weight * creep.damping;
    const double moment = weight * creep.moment;
    act(X_TC, X_TC.rotation * Vec3(friction.x(), friction.y(), 0.0), moment * X_TC.rotation.col(2));
    r.longitudinal_creep_force += friction.x();
    r.lateral_creep_force += friction.y();
    r.spin_moment += moment;
    r.frictional_power += weight * creep.power;
    patches += weight;
    r.tangents.push_back({X_TC, 0.0, damping.x(), damping.y(), 0.0});
    if (!part.strongest) continue;
    r.contact_x += weight * X_TC.origin.x();
    r.contact_y += weight * X_TC.origin.y();
  }
  r.patches = to_whole<int>(std::round(patches));
  r.area = elastic.area;
  r.max_pressure = elastic.max_pressure;
  r.normal_force = elastic.normal_force;
  r.elastic_energy = elastic.energy;
  return r;
}

void TableContact::save(ByteWriter& out) const {
  out.put(kMark);
  if (friction_.varies()) out.put(at_);
}

void TableContact::restore(ByteReader& in) {
  if (in.get<std::uint32_t>() != kMark)
    throw Error(ErrorKind::input_data, "a saved state is not that of a contact element with a table", {}, "start anew");
  if (friction_.varies()) in.get(at_);
}

}  // namespace treadmark::vehicle
