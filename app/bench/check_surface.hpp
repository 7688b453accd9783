// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/app/bench/bench_scene.hpp"

namespace treadmark::app {

/// What a surface was held against and how that ended.
struct SurfaceAgreement {
  std::string reason;       ///< what does not agree, in words; empty if all does
  double difference = 0.0;  ///< largest normal distance from the surface as given [m]
};

/// Heights, seen level and tilted, against the surface as given (within what samples so far apart may lose where it is
/// so curved), against the same surface's single points seen in a third plane, and slopes against differences of
/// heights. resolution: of the samples [m]; 0 = no samples, the surfaces must be equal.
SurfaceAgreement check_surface(const Surface& subject, const BenchView& truth, double resolution);

/// How far chords of this length may lie from a surface so curved, with room for two directions [m].
double representation_limit(double resolution, double largest_curvature);

}  // namespace treadmark::app
