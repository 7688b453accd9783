// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/rail_element.hpp"

#include <algorithm>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

// Where the coordinates of bending and of torsion are among those of an element.
constexpr std::array<int, 4> kBendingAt{0, 1, 3, 4};
constexpr std::array<int, 2> kRollAt{2, 5};

}  // namespace

RailBeam beam_in(const FlexibleTrack& track, RailPlane plane) {
  RailBeam beam = track.rail;
  if (plane == RailPlane::vertical) return beam;
  if (!track.sideways) throw Error(ErrorKind::configuration, "the rails of this track do not bend sideways");
  beam.bending_stiffness = track.sideways->bending_stiffness;
  beam.shear_stiffness = track.sideways->shear_stiffness;
  beam.rotary_inertia = track.sideways->rotary_inertia;
  return beam;
}

RailElement::RailElement(const FlexibleTrack& track, RailPlane plane, double length,
                         const std::optional<BeamElement::Hinge>& hinge)
    : beam_(beam_in(track, plane), length, hinge), length_(length), mass_(track.rail.mass) {
  if (plane == RailPlane::sideways) sideways_ = track.sideways;
}

RailMatrix RailElement::stiffness() const {
  const BeamMatrix bending = beam_.stiffness();
  if (!sideways_) return bending;
  RailMatrix k = RailMatrix::Zero(6, 6);
  k(kBendingAt, kBendingAt) = bending;
  k(kRollAt, kRollAt) =
      sideways_->torsional_stiffness / length_ * (Eigen::Matrix2d() << 1.0, -1.0, -1.0, 1.0).finished();
  return k;
}

RailMatrix RailElement::mass() const {
  const BeamMatrix bending = beam_.mass();
  if (!sideways_) return bending;
  const double above = sideways_->centroid - sideways_->shear_centre;
  RailMatrix m = RailMatrix::Zero(6, 6);
  m(kBendingAt, kBendingAt) = bending;
  m(kRollAt, kRollAt) = (sideways_->polar_inertia + mass_ * above * above) * length_ / 6.0 *
                        (Eigen::Matrix2d() << 2.0, 1.0, 1.0, 2.0).finished();
  const Eigen::Matrix<double, 4, 2> both = mass_ * above * beam_.moments();
  m(kBendingAt, kRollAt) = both;
  m(kRollAt, kBendingAt) = both.transpose();
  return m;
}

RailShape RailElement::at_top(const BeamVector& bending, const Eigen::Vector2d& roll) const {
  if (!sideways_) return bending;
  RailShape top = RailShape::Zero(6, 2);
  top(kBendingAt, 0) = bending;
  top(kRollAt, 0) = (sideways_->height - sideways_->shear_centre) * roll;
  top(kRollAt, 1) = roll;
  return top;
}

RailGive RailElement::at_top(double bending, double roll) const {
  if (!sideways_) return RailGive::Constant(1, 1, bending);
  const double arm = sideways_->height - sideways_->shear_centre;
  return (Eigen::Matrix2d() << bending + arm * arm * roll, arm * roll, arm * roll, roll).finished();
}

RailShape RailElement::motion(double part) const { return at_top(beam_.deflection(part), {1.0 - part, part}); }

RailGive RailElement::own_compliance(double part) const {
  return at_top(beam_.own_compliance(part),
                sideways_ ? length_ * part * (1.0 - part) / sideways_->torsional_stiffness : 0.0);
}

RailGive RailElement::own_slope(double part) const {
  constexpr double kPart = 1e-4;
  const double from = std::max(0.0, part - kPart), to = std::min(1.0, part + kPart);
  return (own_compliance(to) - own_compliance(from)) / ((to - from) * length_);
}

}  // namespace treadmark::vehicle
