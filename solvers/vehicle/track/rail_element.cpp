// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/rail_element.hpp"

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

Eigen::Vector2d RailElement::roll_between(double from, double to) const {
  const double second = 0.5 * (to * to - from * from) * length_;
  return {(to - from) * length_ - second, second};
}

double RailElement::own_roll_between(double from, double to) const {
  const double a = from * length_, d = (to - from) * length_, first = d * (a + 0.5 * d);
  return (d * d * (a + d / 3.0) - first * first / length_) / sideways_->torsional_stiffness;
}

}  // namespace treadmark::vehicle
