// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>

#include "treadmark/core/pose.hpp"

namespace treadmark::app {

/// The frame of a rail that lies along a line of a track, at a place along it [m]: in the frame of the line's beginning
/// without cant, x along it, y to the right, z down; rolled by the cant (docs/layout.md). The line is that of the rail
/// itself. Safe to call from several threads.
using LineFrames = std::function<Pose(double)>;

struct LayoutLine {
  LineFrames frames;
  double length = 0.0;  ///< [m]; beyond it and before 0 the line goes on as it is there
};

/// The line of [layout] of a file. Errors: those of io::read_track_layout; Error(configuration) in a build without
/// vehicles.
LayoutLine layout_line(const std::filesystem::path& file);

/// The place along a line whose plane across it contains a point, next to `near` [m]; NaN where there is none.
double place_along(const LineFrames& line, const Vec3& point, double near);

}  // namespace treadmark::app
