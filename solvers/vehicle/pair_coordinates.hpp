// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/vehicle/contact_element.hpp"

namespace treadmark::vehicle {

/// Coordinates of one wheelset and one rail: wheelset x, y, z, roll, pitch, yaw (order of Freedom), rail marker y, z,
/// roll.
inline constexpr int kPairCoordinates = 9;
using PairVector = Eigen::Matrix<double, kPairCoordinates, 1>;
using PairMatrix = Eigen::Matrix<double, kPairCoordinates, kPairCoordinates>;

/// Generalised forces that a contact reaction exerts on them: their scalar product with the rates is the power of the
/// reaction on both bodies.
PairVector generalised_force(const ContactReaction& reaction, const PairMotion& motion);

/// d(generalised force) = -K d(coordinates) - C d(rates), from the tangents of the patches. K and C are symmetric, not
/// negative.
struct PairTangent {
  PairMatrix stiffness = PairMatrix::Zero(), damping = PairMatrix::Zero();
};
/// rail_marker: profile origin of the rail in track axes at rest [m]; radius: height of the wheelset's centre above the
/// track plane where its z = 0 [m].
PairTangent pair_tangent(const ContactReaction& reaction, const PairMotion& motion, const Vec3& rail_marker,
                         double radius);

}  // namespace treadmark::vehicle
