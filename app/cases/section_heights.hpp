// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/random.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/surface_errors.hpp"

namespace treadmark::app {

/// What a surface may have beside its own shape, along all of it: heights, a spline through values at places across it,
/// and a rigid motion of the section; a wheel moves across alone.
struct SectionHeights {
  Facing facing = Facing::up;           ///< of which surface
  double first = 0.0, step = 0.0;       ///< y of the places [m]
  std::vector<double> values = {};      ///< z of a rail, radius of a wheel [m]; none: it only moves
  double y = 0.0, z = 0.0, roll = 0.0;  ///< [m], [rad]
};
/// The surface with these heights, times a factor.
std::shared_ptr<const Surface> with_heights(std::shared_ptr<const Surface> surface, const SectionHeights& heights,
                                            double factor);
/// Over which factor such a change of the surface is differenced.
double factor_step(const SectionHeights& heights);
/// Several one after the other, each times its factor; those with the same places together.
std::shared_ptr<const Surface> with_heights(std::shared_ptr<const Surface> surface,
                                            std::span<const SectionHeights> heights, std::span<const double> factors);

/// y of places over all of a surface. Errors: Error(configuration) for too many.
std::vector<double> places_across(const Surface& surface, double step);

/// A place of a section given by points (y, z) with their arc lengths, nearest to a y: where it is flattest of the
/// pieces over it; across it heights are more along z the steeper it is.
struct SectionPlace {
  double arc = 0.0, cosine = 1.0;  ///< [m]; of the steepness, not below that beyond which heights tell nothing
};
std::vector<SectionPlace> places_of_section(std::span<const double> arcs, std::span<const double> y,
                                            std::span<const double> z, std::span<const double> places);

/// Errors of one source: independent of each other, each of one standard deviation.
struct SourceOfErrors {
  std::string name;
  std::vector<SectionHeights> errors;
};
/// Root mean square over a surface of what one moves by such errors [m].
double extent_of(const SourceOfErrors& source, std::span<const double> places);
/// What a measured surface has besides the draws of its scatter, near a station u of a rail [m] or wheel [rad].
std::vector<SourceOfErrors> sources_of_errors(const SurfaceErrors& errors, Body body, double u, const Surface& surface);
/// Heights that a draw of its scatter near there has at places across it [m], as many as count.
std::vector<std::vector<double>> draws_of_errors(const SurfaceErrors& errors, Body body, double u,
                                                 std::span<const double> places);
inline constexpr std::size_t kNearestDraws = 16;  ///< that count, as many as of profiles

/// Of the standard normal distribution (Box and Muller 1958).
double normal(Random& random);

}  // namespace treadmark::app
