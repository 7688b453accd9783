// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "treadmark/core/surface.hpp"
#include "treadmark/core/surface_spec.hpp"

namespace treadmark {

/// The backends of this build: "analytic", "spline".
std::span<const std::string_view> backend_names();

/// Standard profiles that StandardProfile::name may name: "60E1", "S1002".
std::span<const std::string_view> standard_profile_names();

/// The surface of one wheel or rail.
/// backend = "": points and slices become splines; standard profiles and arc chains stay analytic.
/// "spline" for a standard profile or arc chain samples it at kResampleStep and fits the samples.
/// Errors: Error(configuration) for a backend that is unknown, not part of this build, or that cannot represent the
/// shape; for a wheel without a positive nominal radius; for flats on a rail, or on a wheel given by points or slices;
/// for a shape that belongs to the other body. Error(input_data) when points or slices cannot be fitted.
std::shared_ptr<const Surface> create_surface(const SurfaceSpec& spec, std::string_view backend = "");

/// Arc-length step at which formulas are sampled for other backends [m].
inline constexpr double kResampleStep = 0.25e-3;

}  // namespace treadmark
