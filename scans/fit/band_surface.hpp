// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "treadmark/model/shape/slices.hpp"
#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/scans/fit/spline_field.hpp"

namespace treadmark::scans {

/// A fitted band as a surface: the section, moved by the field along its normals.
struct FittedBand {
  const Band& band;
  const SplineField& field;
  double s_min = 0.0, s_max = 0.0;  ///< usable part of the section [m]
  double u_zero = 0.0;              ///< station of the band that becomes u = 0: [rad] wheel, [m] rail

  double u_at(double a) const { return (band.a_min + a) / band.radius - u_zero; }
  /// (y, v) in the section's plane.
  Vec2 across(double a, double s) const;
  /// In the surface frame with the new zero of u.
  Vec3 point(double a, double s) const;
};

/// Slices at the knots that the field has along a, where its finer functions matter (a coefficient beyond tolerance
/// [m]), but no farther apart than 33 mm, and closer at open ends; across, points spacing apart. A closed wheel has the
/// same slice at -pi and pi.
SliceSet to_slices(const FittedBand& fitted, double spacing, double tolerance, std::string name);

/// Where the slices of to_slices stand, from the beginning of the band [m]; not in order. finest: distance of the
/// places where they may [m]; 0: that of the finest knots. Of parts of a band with the same finest all find the same
/// ones.
std::vector<double> slice_stations(const FittedBand& fitted, double tolerance, double finest = 0.0);
/// The slice there.
Profile slice_at(const FittedBand& fitted, double a, double spacing, std::string name);

/// The section without damage, as a profile: z of a wheel is the radius less nominal_radius [m].
Profile section_profile(const FittedBand& fitted, double nominal_radius, double spacing, std::string name);

/// Nodes for triangles: (a, s) spacing apart in equilateral order, those in open cells left out. A closed band's rows
/// divide its length evenly.
std::vector<Vec2> triangle_nodes(const FittedBand& fitted, const BandPoints& points, std::span<const std::uint8_t> open,
                                 double spacing);

/// What the triangles over two nodes miss, up to what is linear: the field with the curvature of circumference and
/// section. For decimation of nodes.
std::vector<double> sagitta(const FittedBand& fitted, std::span<const Vec2> nodes);

}  // namespace treadmark::scans
