// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/app/import/read_clouds.hpp"
#include "treadmark/scans/cleaning/noise_factors.hpp"

namespace treadmark::app {

struct PlacedScan;

/// read_clouds, without mixed points, and with scans laid on each other where the settings say so.
/// Errors: those of read_clouds and scans::register_scans; Error(configuration) for one scan alone or an unknown unit.
Clouds read_points(const ImportRequest& request, io::ImportReport& report, const Progress& progress);

/// Lets points count by the noise of their pass, of their angle to the beam and of their intensity, as far as these are
/// known and it differs; tells in the report. noise: with residuals.
void weigh_points(const PlacedScan& scan, scans::Projection& projection, const scans::NoiseSettings& settings,
                  scans::LocalNoise& noise, io::ImportReport& report);

}  // namespace treadmark::app
