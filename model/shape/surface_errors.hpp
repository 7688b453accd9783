// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark {

/// Errors that a measured surface may have, as draws across it at stations along it. Positive where the surface lies
/// too far out of the material, so that a gap would be larger by as much without them. Immutable once made.
struct SurfaceErrors {
  std::vector<double> y, z;                ///< places across, in the order of a profile's points [m]; at least two
  std::vector<double> u;                   ///< of each draw: x of a rail [m], angle of a wheel [rad]
  std::vector<std::vector<double>> draws;  ///< at the places [m]
};

/// Arc lengths of the places from the first one [m].
std::vector<double> arc_lengths(const SurfaceErrors& errors);

/// Numbers of the draws whose stations are nearest to one, nearest first; period: 2 pi of a wheel, 0 of a rail.
std::vector<std::size_t> nearest_draws(const SurfaceErrors& errors, double u, std::size_t most, double period);

/// Root mean square, and the largest without sign [m].
struct ErrorSize {
  double rms = 0.0, largest = 0.0;
};
ErrorSize size_of(const SurfaceErrors& errors);

/// What becomes of stations where the coordinates of a file change: those of slices stay; those of points in space go
/// along a rail with them, or are angles round a wheel, whose z across is then a radius.
enum class Stations { kept, along, round };

/// As the coordinates of a file are multiplied by a factor, and y or z mirrored.
SurfaceErrors changed(SurfaceErrors errors, double factor, bool mirror_y, bool mirror_z, Stations stations);

/// How the lines begin that tell files of surfaces, as comments, what is not known of them.
inline constexpr std::string_view kSurfaceErrors = "surface-errors";

/// Lines for people and machines, of at most 200 characters; draws to 0.01 um.
std::vector<std::string> to_lines(const SurfaceErrors& errors);

/// From lines without signs of comments; those that begin otherwise do not count. Null without any that do. Errors:
/// Error(input_data) without a place for lines that are damaged.
std::shared_ptr<const SurfaceErrors> errors_of_lines(std::span<const std::string> lines);

}  // namespace treadmark
