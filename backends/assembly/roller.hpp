// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/defects.hpp"
#include "treadmark/model/shape/slices.hpp"
#include "treadmark/model/shape/surface_spec.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::assembly {

/// The wheel that a roller becomes by a half turn about x: profile (y, z) -> (-y, -z), nominal radius that of the
/// roller. Positions x of slices become angles x / radius; triangles are those of the roller itself in the rail frame,
/// and only moved. The wheel has no defects: see add_roller_defects. Errors: Error(configuration) for a radius that is
/// not positive and finite, or slices that go round more than once.
SurfaceSpec wheel_of_roller(const SurfaceSpec& roller);

/// The way back for data sampled from such a wheel: slices at x = radius theta, triangles in the rail frame.
SliceSet roller_slices(const SliceSet& wheel, double radius);
TriangleMesh roller_triangles(TriangleMesh wheel, double radius);

/// Rail defects on the wheel of a roller of any backend; their x is the arc length radius theta from the top of the
/// roller, in
/// [-pi radius, pi radius). Errors: those of check_defects; Error(configuration) for flattened heads and milling paths.
std::shared_ptr<const Surface> add_roller_defects(std::shared_ptr<const Surface> wheel, const Defects& defects,
                                                  double radius);

}  // namespace treadmark::assembly
