// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/app/import/find_place.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/scans/fit/band_surface.hpp"

namespace treadmark::app {

/// One rail of a track as it was imported.
struct TrackSide {
  PlacedScan placed;  ///< its line and placement alone
  scans::Band band;
  scans::SplineField field;
  double s_min = 0.0, s_max = 0.0, u_zero = 0.0;  ///< as FittedBand's
  double x_min = 0.0, x_max = 0.0;                ///< where it is known along itself [m]
};

/// Gauge and cant of two rails, both with their gauge side to the left, along the right one. The gauge is the least
/// distance of the heads from the line that touches both from above to 14 mm below it (EN 13848-1); the cant how much
/// higher the left rail's touching point is than the right one's, which takes knowing where up is. up: in the cloud's
/// frame. Without places where they do not lie beside each other.
io::ImportReport::Track measure_track(const TrackSide& left, const TrackSide& right, const std::optional<Vec3>& up);

}  // namespace treadmark::app
