// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/app/bench/bench_scene.hpp"
#include "treadmark/detection/contact_search.hpp"

namespace treadmark::app {

/// What a surface was held against and how that ended.
struct SurfaceAgreement {
  std::string reason;       ///< what does not agree, in words; empty if all does
  double difference = 0.0;  ///< largest normal distance from the surface as given [m]
};

/// Heights, seen level and tilted, against the surface as given (within what samples so far apart may lose where it is
/// so curved), against the same surface's single points seen in a third plane, and slopes against differences of
/// heights. resolution: of the samples [m]; 0 = no samples, the surfaces must be equal. one_place: the surface stands
/// for the one as given at one place only, its difference is told and not judged.
SurfaceAgreement check_surface(const Surface& subject, const BenchView& truth, double resolution,
                               bool one_place = false);

/// How far chords of this length may lie from a surface so curved, with room for two directions [m].
double representation_limit(double resolution, double largest_curvature);

/// The wheel moves so far down between a first and a second search [m].
inline constexpr double kWarmStep = 1e-6;

/// Holds a search by the method of its settings, first and after a small move, against searches on the full grid: the
/// same patches, references and least gaps. Returns what does not agree, or nothing; patches: their number, if not
/// null.
std::string check_search(const detection::BodyPair& bodies, const detection::SearchSettings& settings,
                         int* patches = nullptr);

/// Holds the undeformed distance on a grid against one put together from single heights.
std::string check_distance(const detection::BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C);

}  // namespace treadmark::app
