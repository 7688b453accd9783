// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/import/read_clouds.hpp"
#include "treadmark/app/import/step_clock.hpp"
#include "treadmark/model/shape/surface_spec.hpp"
#include "treadmark/scans/placement/place.hpp"

namespace treadmark::app {

/// A scan whose wheel or rail has been found.
struct PlacedScan {
  Body body = Body::rail;
  std::vector<Vec3> points;  ///< [m], in the cloud's frame; passes aligned
  std::vector<std::uint16_t> passes;
  std::vector<std::uint8_t> keep;  ///< 0 = stray
  scans::Placement placement;
  std::vector<SurfaceDoubt> doubts;         ///< about it, which go with the surface
  std::vector<Vec2> nominal;                ///< (y, z) of the nominal profile; empty: none
  std::optional<SurfaceSpec> nominal_spec;  ///< without a radius
};

/// Body by the settings or the outputs. Errors: Error(configuration) if neither tells.
Body body_of(const ImportRequest& request);

/// The nominal profile by the settings: sets nominal and nominal_spec. Errors: those of the readers.
void read_nominal(const ImportRequest& request, PlacedScan& scan);

/// Stray points, unit, frame, passes. Adds all that to the report.
PlacedScan find_place(Clouds clouds, const ImportRequest& request, io::ImportReport& report, StepClock& clock);

}  // namespace treadmark::app
