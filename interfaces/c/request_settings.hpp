// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/measure/measure_files.hpp"

// What programs ask of `treadmark geometry` and `treadmark measure`: "key=value" with the names of their options, with
// low lines and units in the names ("gauge_mm=1435"). A key with a point is one of the case file that was named.

namespace treadmark::c {

/// A key and the factor from its number to SI; 1 for texts, too.
struct RequestKey {
  std::string name;
  double si = 1.0;
};

/// A wheelset on its track, and gauges at which its conicity is wanted, too [m].
struct GeometryAsked {
  app::GeometryRequest request;
  std::vector<double> gauges;
};

const std::vector<RequestKey>& geometry_keys();
const std::vector<RequestKey>& measure_keys();

/// Errors: Error(configuration) for keys that there are not, values that make no sense, and what does not go together.
GeometryAsked geometry_asked(std::span<const std::string> settings);
/// The same, and the errors of app::read_limits.
app::MeasureRequest measure_asked(Body body, std::span<const std::string> settings);

/// The answers; the sweep where gauges were asked for. Errors: those of app::run_geometry.
struct GeometryAnswer {
  app::GeometryResult result;
  std::optional<app::GaugeSweep> sweep;

  std::string json() const;
};
GeometryAnswer answer_geometry(const GeometryAsked& asked);

}  // namespace treadmark::c
