// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
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
  std::vector<float> intensities;          ///< or empty, as PointCloud's
  std::map<std::uint16_t, Vec3> stations;  ///< as PointCloud's [m], in the cloud's own frame
  std::vector<std::uint8_t> keep;          ///< 0 = stray
  scans::Placement placement;
  std::vector<SurfaceDoubt> doubts;         ///< about it, which go with the surface
  std::vector<Vec2> nominal;                ///< (y, z) of the nominal profile; empty: none
  std::optional<SurfaceSpec> nominal_spec;  ///< without a radius
  std::optional<scans::FoundLine> line;     ///< of a rail, in the cloud's own frame

  double metres = 1.0;      ///< of a unit of the files
  double pass_error = 0.0;  ///< of heights, by how well passes agree [m]
  /// What laid the points where they are, once they were in metres, in its order: for the rest of a scan of which these
  /// are a sample.
  std::vector<std::function<void(std::span<Vec3> points, std::span<const std::uint16_t> passes)>> laid_by;

  bool straightened() const { return line && line->bent; }
};

/// The frame of the surface in the cloud's own, before it was straightened; of a rail at a place x along it [m].
Pose frame_in_cloud(const PlacedScan& scan, double x = 0.0);

/// The place of a point of the cloud's own frame in that of the points.
Vec3 straightened(const PlacedScan& scan, const Vec3& point);

/// Puts the line of a rail, if it was found, into the report: places by x of the surface, whose frame is settled.
void fill_line(const PlacedScan& scan, const io::ImportSettings& settings, io::ImportReport& report);

/// Body by the settings or the outputs. Errors: Error(configuration) if neither tells.
Body body_of(const ImportRequest& request);

/// The nominal profile by the settings: sets nominal and nominal_spec. Errors: those of the readers.
void read_nominal(const ImportRequest& request, PlacedScan& scan);

/// The rails of a track as scans of their own, the left one first: that is to the left where x of the track runs as
/// placement.forward does, or as the axis of the scan that is nearest to it. Each forward is the direction, in the
/// scan's frame, in which the rail has its gauge side to the left. Tells in the report what is doubtful along the
/// track. Errors: those of the search for a line; Error(input_data) where there is no second rail.
struct SeparateRails {
  std::array<Clouds, 2> clouds;
  std::array<Vec3, 2> forward;
};
SeparateRails separate_rails(Clouds both, const io::ImportSettings& settings, io::ImportReport& report);

/// Stray points, unit, frame, passes. Adds all that to the report.
PlacedScan find_place(Clouds clouds, const ImportRequest& request, io::ImportReport& report, StepClock& clock);

}  // namespace treadmark::app
