// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/check_rail.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

ContactWithCheckRail::ContactWithCheckRail(std::shared_ptr<ContactElement> contact, wheelrail::Side side,
                                           const CheckRail& rail, const FlangeBack& back, const Vec3& rail_marker)
    : contact_(std::move(contact)),
      side_(side == wheelrail::Side::right ? 1.0 : -1.0),
      rail_(rail),
      back_(back),
      marker_(rail_marker) {
  if (!contact_) throw Error(ErrorKind::configuration, "a check rail stands beside no contact");
  if (!(rail.stiffness > 0.0) || !(rail.damping >= 0.0) || !(rail.friction >= 0.0))
    throw Error(ErrorKind::configuration, "stiffness, damping and friction of a check rail must not be negative");
  if (!(rail.flare_length >= 0.0) || !(rail.to - rail.from >= 2.0 * rail.flare_length))
    throw Error(ErrorKind::configuration, "a check rail must be as long as the flares at both its ends");
}

ContactWithCheckRail::Face ContactWithCheckRail::face_at(double x) const {
  if (!(x >= rail_.from && x <= rail_.to)) return {};
  Face face{true, rail_.face_y, 0.0};
  if (!(rail_.flare_length > 0.0)) return face;
  const bool behind = x > 0.5 * (rail_.from + rail_.to);
  const double inside = behind ? rail_.to - x : x - rail_.from, t = 1.0 - inside / rail_.flare_length;
  if (!(t > 0.0)) return face;
  face.y -= rail_.flare * t * t;
  face.slope = (behind ? -2.0 : 2.0) * rail_.flare * t / rail_.flare_length;
  return face;
}

ContactReaction ContactWithCheckRail::evaluate(const PairMotion& motion) {
  ContactReaction r = contact_->evaluate(motion);
  if (is_unsolved(r)) return r;
  const wheelrail::SixMotion &q = motion.wheelset, &v = motion.wheelset_velocity;
  // Points of wheel and rail that touch, below the axle: about the wheelset's centre and the rail marker.
  const Vec3 arm(-side_ * back_.y * std::sin(q.yaw), side_ * back_.y * std::cos(q.yaw), back_.radius + rail_.depth);
  const Face face = face_at(back_.rail_x + q.x + arm.x());
  if (!face.there) return r;
  const Vec3 rail_arm(0.0, side_ * face.y - marker_.y(), rail_.depth - marker_.z());
  const double wheel_y = arm.y() + q.y - q.roll * arm.z();
  const double rail_y = side_ * face.y + motion.rail.y - motion.rail.roll * rail_arm.z();
  const double depth = side_ * (rail_y - wheel_y);
  if (!(depth > 0.0)) return r;

  const Mat3 rolled = rotation_x(q.roll);
  const Vec3 axle = (rolled * rotation_z(q.yaw)).col(1);
  const Vec3 of_wheel =
      Vec3(v.x, v.y, v.z) + (v.roll * Vec3::UnitX() + v.yaw * rolled.col(2) + v.pitch * axle).cross(arm);
  const Vec3 slip(of_wheel.x(), 0.0, of_wheel.z() - motion.rail.vz - motion.rail.vroll * rail_arm.y());
  const double rate = side_ * (motion.rail.vy - motion.rail.vroll * rail_arm.z() - v.y + v.roll * arm.z()) +
                      face.slope * v.x - v.yaw * (side_ * arm.x() + face.slope * arm.y());
  const double normal = std::max(0.0, rail_.stiffness * depth + rail_.damping * rate);
  constexpr double kSlow = 0.01;  // [m/s]
  const double drag = rail_.friction * normal / std::hypot(slip.norm(), kSlow);
  const Vec3 push(-normal * face.slope, side_ * normal, 0.0), on_wheel = push - drag * slip;
  // The back of the flange is flat: turning about the axle comes no nearer to the face, so that its push has no moment
  // about it, in the flare neither.
  Vec3 moment = arm.cross(push);
  moment -= moment.dot(axle) * axle;

  r.on_wheelset += {on_wheel, moment - arm.cross(drag * slip)};
  r.on_rail += {-on_wheel, rail_arm.cross(-on_wheel)};
  r.check_force += normal;
  r.elastic_energy += 0.5 * rail_.stiffness * depth * depth;
  r.frictional_power += drag * slip.squaredNorm() + (normal - rail_.stiffness * depth) * rate;
  PatchTangent t;
  t.X_TC.origin = Vec3(0.0, q.y, q.z - back_.radius) + arm;
  t.X_TC.rotation.col(0) = Vec3::UnitX();
  t.X_TC.rotation.col(1) = side_ * Vec3::UnitZ();
  t.X_TC.rotation.col(2) = -side_ * Vec3::UnitY();
  t.stiffness_n = rail_.stiffness;
  t.damping_x = t.damping_s = drag;
  t.normal_force = normal;
  r.tangents.push_back(t);
  return r;
}

}  // namespace treadmark::vehicle
