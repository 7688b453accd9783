// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "treadmark/model/vehicle/flexible_track.hpp"
#include "treadmark/solvers/vehicle/track/beam_element.hpp"

namespace treadmark::vehicle {

/// The two motions of a symmetric rail that do not disturb each other.
enum class RailPlane {
  vertical,  ///< bending; moves the rail's top by z
  sideways   ///< bending and torsion; moves it by y and roll
};

/// Coordinates at each node: deflection, rotation of the section as the slope of the deflection and, sideways, roll.
constexpr int node_coordinates(RailPlane plane) { return plane == RailPlane::vertical ? 2 : 3; }
/// How a force can act on the rail's top and that can move: z, or y and roll.
constexpr int top_motions(RailPlane plane) { return plane == RailPlane::vertical ? 1 : 2; }

using RailMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
/// Motions of the top in columns, by coordinates of up to three nodes.
using RailShape = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 2>;
/// Motions of the top by forces at it.
using RailGive = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;

/// A finite element of a rail in one plane: BeamElement and, sideways, St Venant's torsion with linear interpolation,
/// exact for loads at its ends at rest, too. The deflection is that of the shear centre; the centroid above it couples
/// bending with torsion by its mass. A hinge lets the rail bend, not twist.
class RailElement {
 public:
  /// The track has RailSideways for that plane.
  RailElement(const FlexibleTrack& track, RailPlane plane, double length,
              const std::optional<BeamElement::Hinge>& hinge = {});

  RailMatrix stiffness() const;
  RailMatrix mass() const;
  const BeamElement& beam() const { return beam_; }
  /// Integrals along the element, from one part of its length to another, of what roll the coordinates give [m].
  Eigen::Vector2d roll_between(double from, double to) const;
  /// Roll of this stretch, integrated, under a moment spread over it while the ends stand still, times the length of
  /// the stretch [m/N].
  double own_roll_between(double from, double to) const;

 private:
  BeamElement beam_;
  double length_;
  std::optional<RailSideways> sideways_;  ///< none: vertical
  double mass_;                           ///< [kg/m]
};

/// The beam that bends in a plane.
RailBeam beam_in(const FlexibleTrack& track, RailPlane plane);

}  // namespace treadmark::vehicle
