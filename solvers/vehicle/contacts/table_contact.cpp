// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
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

ContactReaction not_covered(const ContactTable& table, const RelativePlace& place) {
  ContactReaction r;
  r.status = Status::failed;
  const auto turned = [&](const char* how, double angle, const TableAngles& angles) {
    r.message = fmt::format("the wheel {} by {:.4g} mrad; the contact table reaches to {:.4g} mrad each way", how,
                            1e3 * angle, 1e3 * angles.most);
    return r;
  };
  if (!table.roll().covers(place.roll)) return turned("rolls against the rail", place.roll, table.roll());
  if (!table.yaw().covers(place.yaw)) return turned("is yawed", place.yaw, table.yaw());
  r.message = fmt::format(
      "the wheel stands {:.4g} mm aside of its central position over the rail (right-hand side); the contact table "
      "reaches from {:.4g} to {:.4g} mm: the flange climbs, or the wheel leaves the rail",
      1e3 * place.y, 1e3 * table.y_min(), 1e3 * table.y_max());
  return r;
}

}  // namespace

TableContact::TableContact(std::shared_ptr<const ContactTable> table, wheelrail::Side side,
                           std::shared_ptr<const CreepTable> creep)
    : table_(std::move(table)), creep_(std::move(creep)), side_(side) {
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
    const double slope = i == 0 ? 1.0 : (excess - excess_before) / (carried - before);
    before = carried, excess_before = excess;
    carried -= excess / (slope > 0.0 ? slope : 1.0);
    carried = std::clamp(carried, 0.2 * before, 5.0 * before);
  }
  if (r.status == Status::ok) {
    r.status = Status::not_converged;
    r.message =
        fmt::format("no height gives the vertical load of {:.6g} N: friction on the flange carries the wheel", load);
  }
  return right ? r : mirrored(r);
}

ContactReaction TableContact::evaluate_right_hand(const PairMotion& motion, const LocalContact* local) {
  const wheelrail::Placement now = placed(*table_, motion);
  const RelativePlace place = relative_place(table_->nominal(), now, motion);
  const ElasticContact elastic = local && local->is_at(place) ? local->at(place.z) : elastic_contact(*table_, place);
  if (!elastic.in_table) return not_covered(*table_, place);

  ContactReaction r;
  r.least_gap = -elastic.penetration;
  if (!(elastic.normal_force > 0.0)) {
    r.status = Status::no_contact;
    r.message = "wheel and rail do not touch";
    return r;
  }
  const double angle = std::atan(elastic.slope) + motion.rail.roll;
  Pose X_TC{now.X_TW.origin + rotation_x(motion.rail.roll) * Vec3(0.0, elastic.arm_y, elastic.arm_z),
            rotation_x(angle)};
  // The arm ends on the undeformed wheel, the contact point lies on the rail.
  X_TC.origin -= elastic.penetration * X_TC.rotation.col(2);
  put_below_the_axle(X_TC, now.X_TWs, motion.curvature);

  problem_.state.position = motion.wheelset;
  problem_.state.velocity = motion.wheelset_velocity;
  problem_.track.vy = motion.rail.vy, problem_.track.vz = motion.rail.vz, problem_.track.vroll = motion.rail.vroll;
  const wheelrail::ContactKinematics creepage = wheelrail::contact_kinematics(problem_, now, X_TC, elastic.penetration);
  const FrictionLaw law = friction_at(problem_.friction_inclination, problem_.friction_laws, angle, problem_.friction);
  const CreepContact patch{elastic.a, elastic.b, law.static_friction() * elastic.normal_force};
  const CreepForce creep =
      creep_ ? creep_force(*creep_, patch, material_, creepage) : creep_force(patch, material_, creepage);

  const Vec3 force = X_TC.rotation * Vec3(creep.force.x(), creep.force.y(), elastic.normal_force);
  const Vec3 moment = creep.moment * X_TC.rotation.col(2);
  const auto about = [&](const Vec3& point, const Vec3& at) {
    return wheelrail::Wrench{force, (at - point).cross(force) + moment};
  };
  // Friction takes what the creepages put in: forces act where these are those of both bodies.
  r.on_rail = about(now.X_TR.origin, X_TC.origin);
  const wheelrail::Wrench at_centre = about(now.X_TWs.origin, X_TC.apply({0.0, 0.0, elastic.penetration}));
  r.on_wheelset = {-at_centre.force, -at_centre.moment};
  r.longitudinal_creep_force = creep.force.x();
  r.lateral_creep_force = creep.force.y();
  r.spin_moment = creep.moment;
  r.normal_force = elastic.normal_force;
  r.area = std::numbers::pi * elastic.a * elastic.b;
  r.max_pressure = 1.5 * elastic.normal_force / r.area;
  r.contact_x = X_TC.origin.x();
  r.contact_y = X_TC.origin.y();
  r.patches = 1;
  r.elastic_energy = elastic.energy;
  r.frictional_power = creep.power;
  r.tangents.push_back({X_TC, elastic.stiffness, creep.damping.x(), creep.damping.y(), elastic.normal_force});
  return r;
}

void TableContact::save(ByteWriter& out) const { out.put(kMark); }

void TableContact::restore(ByteReader& in) {
  if (in.get<std::uint32_t>() != kMark)
    throw Error(ErrorKind::input_data, "a saved state is not that of a contact element with a table", {}, "start anew");
}

}  // namespace treadmark::vehicle
