// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/import/find_place.hpp"

namespace treadmark::app {

/// A gridded map of deviations from the nominal profile, as points that are in place already: one a value of the map.
/// Errors: those of the reader; Error(configuration) without a nominal profile, or without the radius of a wheel.
PlacedScan read_map(const ImportRequest& request, io::ImportReport& report);

}  // namespace treadmark::app
