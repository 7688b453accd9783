// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace treadmark {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Rigid pose of a frame B in a frame A: p_A = origin + rotation * p_B. Written X_AB.
/// All frames are right-handed; see core/README.md for axes and signs.
struct Pose {
  Vec3 origin = Vec3::Zero();        ///< origin of B in A [m]
  Mat3 rotation = Mat3::Identity();  ///< axes of B in A (columns)

  Vec3 apply(const Vec3& p_B) const { return origin + rotation * p_B; }
  Vec3 apply_inverse(const Vec3& p_A) const { return rotation.transpose() * (p_A - origin); }
  Pose inverse() const { return {-(rotation.transpose() * origin), rotation.transpose()}; }

  /// X_AC = X_AB * X_BC.
  friend Pose operator*(const Pose& X_AB, const Pose& X_BC) {
    return {X_AB.apply(X_BC.origin), X_AB.rotation * X_BC.rotation};
  }
};

/// Rotations by the right-hand rule about x (roll), y (pitch), z (yaw) [rad].
Mat3 rotation_x(double roll);
Mat3 rotation_y(double pitch);
Mat3 rotation_z(double yaw);

/// Roll, yaw, pitch [rad] of R = Rx(roll) Rz(yaw) Ry(pitch).
struct RollYawPitch {
  double roll = 0.0, yaw = 0.0, pitch = 0.0;
};
Mat3 rotation(const RollYawPitch& angles);
RollYawPitch roll_yaw_pitch(const Mat3& rotation);

/// Angle wrapped to [-pi, pi).
double wrap_angle(double angle);

}  // namespace treadmark
