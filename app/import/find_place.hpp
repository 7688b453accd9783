// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "treadmark/app/import/read_clouds.hpp"
#include "treadmark/app/import/step_clock.hpp"
#include "treadmark/model/shape/surface_spec.hpp"
#include "treadmark/scans/line/find_line.hpp"
#include "treadmark/scans/placement/place.hpp"

namespace treadmark::app {

/// A scan whose wheel or rail has been found.
struct PlacedScan {
  Body body = Body::rail;
  std::vector<Vec3> points;  ///< [m], in the cloud's frame; passes aligned; of a bent rail straightened along its line:
                             ///< the frame that is called the cloud's everywhere after that
  std::vector<std::uint16_t> passes;
  std::vector<std::uint8_t> keep;  ///< 0 = stray
  scans::Placement placement;
  std::vector<SurfaceDoubt> doubts;         ///< about it, which go with the surface
  std::vector<Vec2> nominal;                ///< (y, z) of the nominal profile; empty: none
  std::optional<SurfaceSpec> nominal_spec;  ///< without a radius
  std::optional<scans::FoundLine> line;     ///< of a rail, in the cloud's own frame

  double metres = 1.0;  ///< of a unit of the files
  /// What laid the points where they are, once they were in metres, in its order: for the rest of a scan of which these
  /// are a sample.
  std::vector<std::function<void(std::span<Vec3> points, std::span<const std::uint16_t> passes)>> laid_by;

  bool straightened() const { return line && line->bent; }
};

/// The frame of the surface in the cloud's own, before it was straightened, at x = 0 of the surface.
Pose frame_in_cloud(const PlacedScan& scan);

/// The place of a point of the cloud's own frame in that of the points.
Vec3 straightened(const PlacedScan& scan, const Vec3& point);

/// Puts the line of a rail, if it was found, into the report: places by x of the surface, whose frame is settled.
void fill_line(const PlacedScan& scan, const io::ImportSettings& settings, io::ImportReport& report);

/// Body by the settings or the outputs. Errors: Error(configuration) if neither tells.
Body body_of(const ImportRequest& request);

/// The nominal profile by the settings: sets nominal and nominal_spec. Errors: those of the readers.
void read_nominal(const ImportRequest& request, PlacedScan& scan);

/// Stray points, unit, frame, passes. Adds all that to the report.
PlacedScan find_place(Clouds clouds, const ImportRequest& request, io::ImportReport& report, StepClock& clock);

}  // namespace treadmark::app
