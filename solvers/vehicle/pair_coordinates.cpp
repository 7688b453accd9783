// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/pair_coordinates.hpp"

namespace treadmark::vehicle {
namespace {

/// Axes of the rates of roll, pitch and yaw: orientations are composed as roll, yaw, pitch.
struct WheelsetAxes {
  Vec3 roll = Vec3::UnitX(), pitch, yaw;
  explicit WheelsetAxes(const wheelrail::SixMotion& q) {
    const Mat3 rolled = rotation_x(q.roll);
    yaw = rolled.col(2);
    pitch = (rolled * rotation_z(q.yaw)).col(1);
  }
};

}  // namespace

PairVector generalised_force(const ContactReaction& reaction, const PairMotion& motion) {
  const WheelsetAxes axes(motion.wheelset);
  const auto& [force, moment] = reaction.on_wheelset;
  PairVector f;
  f << force, moment.dot(axes.roll), moment.dot(axes.pitch), moment.dot(axes.yaw), reaction.on_rail.force.y(),
      reaction.on_rail.force.z(), reaction.on_rail.moment.x();
  return f;
}

PairTangent pair_tangent(const ContactReaction& reaction, const PairMotion& motion, const Vec3& rail_marker,
                         double radius) {
  const WheelsetAxes axes(motion.wheelset);
  const Vec3 centre(0.0, motion.wheelset.y, motion.wheelset.z - radius);
  const Vec3 marker = rail_marker + Vec3(0.0, motion.rail.y, motion.rail.z);
  PairTangent tangent;
  for (const PatchTangent& patch : reaction.tangents) {
    // Displacement of the wheel at the contact against the rail, by the nine coordinates.
    Eigen::Matrix<double, 3, kPairCoordinates> relative = Eigen::Matrix<double, 3, kPairCoordinates>::Zero();
    const Vec3 arm = patch.X_TC.origin - centre;
    relative.leftCols<3>().setIdentity();
    relative.col(3) = axes.roll.cross(arm);
    relative.col(4) = axes.pitch.cross(arm);
    relative.col(5) = axes.yaw.cross(arm);
    relative.col(6) = -Vec3::UnitY();
    relative.col(7) = -Vec3::UnitZ();
    relative.col(8) = -Vec3::UnitX().cross(Vec3(patch.X_TC.origin - marker));
    const Eigen::Matrix<double, 3, kPairCoordinates> in_contact = patch.X_TC.rotation.transpose() * relative;
    const Vec3 stiffness(0.0, 0.0, patch.stiffness_n), damping(patch.damping_x, patch.damping_s, 0.0);
    tangent.stiffness += in_contact.transpose() * stiffness.asDiagonal() * in_contact;
    tangent.damping += in_contact.transpose() * damping.asDiagonal() * in_contact;
  }
  return tangent;
}

}  // namespace treadmark::vehicle
