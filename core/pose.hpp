// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace treadmark {

/// (x, y)
using Vec2 = Eigen::Vector2d;
/// (x, y, z)
using Vec3 = Eigen::Vector3d;
/// A rotation, or a stress.
using Mat3 = Eigen::Matrix3d;

/// Rigid pose of a frame B in a frame A: p_A = origin + rotation * p_B. Written X_AB.
/// All frames are right-handed; see core/README.md for axes and signs.
struct Pose {
  Vec3 origin = Vec3::Zero();        ///< origin of B in A [m]
  Mat3 rotation = Mat3::Identity();  ///< axes of B in A (columns)

  /// Coordinates in A of a point given in B.
  Vec3 apply(const Vec3& p_B) const { return origin + rotation * p_B; }
  /// Coordinates in B of a point given in A.
  Vec3 apply_inverse(const Vec3& p_A) const { return rotation.transpose() * (p_A - origin); }
  /// X_BA.
  Pose inverse() const { return {-(rotation.transpose() * origin), rotation.transpose()}; }

  /// X_AC = X_AB * X_BC.
  friend Pose operator*(const Pose& X_AB, const Pose& X_BC) {
    return {X_AB.apply(X_BC.origin), X_AB.rotation * X_BC.rotation};
  }
};

/// Rotation by the right-hand rule about x [rad].
Mat3 rotation_x(double roll);
/// About y.
Mat3 rotation_y(double pitch);
/// About z.
Mat3 rotation_z(double yaw);

/// Roll, yaw, pitch [rad] of R = Rx(roll) Rz(yaw) Ry(pitch).
struct RollYawPitch {
  double roll = 0.0, yaw = 0.0, pitch = 0.0;  ///< [rad]
};
/// R of these angles.
Mat3 rotation(const RollYawPitch& angles);
/// The angles of R [rad], yaw within +-pi/2.
RollYawPitch roll_yaw_pitch(const Mat3& rotation);

/// Angle wrapped to [-pi, pi).
double wrap_angle(double angle);

}  // namespace treadmark
