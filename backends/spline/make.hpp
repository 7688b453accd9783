// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <span>
#include <string>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/slices.hpp"
#include "treadmark/model/shape/spline_surface.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::spline {

/// A rail of constant cross-section or, for a wheel profile, a round wheel with r = nominal_radius [m] + z.
/// nominal_radius is not used for a rail. Errors: those of fit_profile, and a radius that is not positive.
std::shared_ptr<const Surface> make_profile_surface(const Profile& profile, double nominal_radius);

/// A rail or wheel from slices; nominal_radius [m] as above. Errors: those of fit_slices, and a radius that is not
/// positive.
std::shared_ptr<const Surface> make_slice_surface(const SliceSet& slices, double nominal_radius);

/// A full-parametric tensor-product B-spline surface through the points of a grid: cubic in both directions, periodic
/// round a closed wheel. Heights by safeguarded Newton iteration in (u, v). Without gaps: every point must be present.
/// Errors: Error(input_data) for a grid with fewer than 4 x 4 points or with gaps.
std::shared_ptr<const Surface> make_nurbs_surface(const sampling::PointGrid& points);

/// The same for a chain of arcs, exactly: rational quadratic arcs, swept along x over [x_min, x_max] (rail) or revolved
/// about the axle by exact circles (wheel). Errors: Error(configuration) for a bad chain, radius or range.
std::shared_ptr<const Surface> make_nurbs_surface(const ArcChain& chain, Body body, double nominal_radius,
                                                  double x_min = -1.0, double x_max = 1.0);

/// That spline with its coefficients.
struct FittedSpline {
  SplineSurface spline;
  std::shared_ptr<const Surface> surface;
};
FittedSpline fit_tensor_spline(const sampling::PointGrid& points);

/// The same points by truncated hierarchical B-splines of degree 2 or 3, backend "thb-quadratic" or "thb"; see fit_thb.
/// note: how much of what it took, in sentences. Errors: those of fit_thb.
std::shared_ptr<const Surface> make_thb_surface(const sampling::PointGrid& points, int degree, std::string& note);
/// Scattered points of a scan, as closely as their noise allows.
std::shared_ptr<const Surface> make_thb_surface(std::span<const Vec3> points, Body body, const sampling::Region& region,
                                                int degree, std::string& note);

/// A surface as its splines are, without samples: backend "nurbs" of a tensor spline, exactly up to degree 3, above it
/// within 10 nm, which is added to the note; "thb", or "thb-quadratic" where no degree is above 2, of a hierarchical
/// one. Errors: those of GivenSpline.
std::shared_ptr<const Surface> make_given_surface(const SplineSurface& splines, Body body, std::string* note = nullptr);

/// What the functions above make, as splines of degree 3 or 2: told_spline.
SplineSurface tell_nurbs(const sampling::PointGrid& points);
SplineSurface tell_nurbs(const ArcChain& chain, Body body, double nominal_radius, double x_min = -1.0,
                         double x_max = 1.0);
SplineSurface tell_thb(const sampling::PointGrid& points, int degree, std::string& note);
SplineSurface tell_thb(std::span<const Vec3> points, Body body, const sampling::Region& region, int degree,
                       std::string& note);

}  // namespace treadmark::spline
