// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark {

/// Where errors of a measured surface come from besides the scatter of its points.
enum class ErrorSource : std::uint8_t { lateral, tilt, height, registration, smoothing, holes, scanner };
/// "lateral placement", "filled holes" ...
std::string_view name_of(ErrorSource source);

/// Errors that a measured surface may have: what scatter of its points leaves, as draws across it at stations along it,
/// and what they share, by sources. Positive where the surface lies too far out of the material, so that a gap would be
/// larger by as much without them. Immutable once made.
struct SurfaceErrors {
  std::vector<double> y, z;                ///< places across, in the order of a profile's points [m]; at least two
  std::vector<double> u;                   ///< of each draw: x of a rail [m], angle of a wheel [rad]
  std::vector<std::vector<double>> draws;  ///< at the places [m]

  /// By which all of the section may lie elsewhere in its own axes: one standard deviation of shifts across and along
  /// z, of a wheel along the radius, and of a roll about its origin that takes y towards z. They belong together.
  struct Motion {
    ErrorSource source = ErrorSource::lateral;
    double y = 0.0, z = 0.0, roll = 0.0;  ///< [m], [m], [rad]
  };
  /// Heights that may be off from place to place: standard deviations; places so far apart have errors of their own.
  struct Field {
    ErrorSource source = ErrorSource::smoothing;
    double length = 0.0;                     ///< [m]
    std::vector<std::vector<double>> sigma;  ///< at the places, of each draw's station or once for all of them [m]

    const std::vector<double>& at(std::size_t station) const { return sigma[sigma.size() == 1 ? 0 : station]; }
  };
  std::vector<Motion> motions;  ///< independent of each other and of all else, and so are fields
  std::vector<Field> fields;
};

/// Arc lengths of the places from the first one [m].
std::vector<double> arc_lengths(const SurfaceErrors& errors);

/// Numbers of the draws whose stations are nearest to one, nearest first; period: 2 pi of a wheel, 0 of a rail.
std::vector<std::size_t> nearest_draws(const SurfaceErrors& errors, double u, std::size_t most, double period);

/// Of the draws: root mean square, and the largest without sign [m].
struct ErrorSize {
  double rms = 0.0, largest = 0.0;
};
ErrorSize size_of(const SurfaceErrors& errors);

/// Standard deviation of heights along the section's normal at a place, by draws and fields near a station, and by
/// motions [m]. near: numbers of the draws that count, the nearest first; tilt: of the section there, dz/dy [rad].
double deviation_at(const SurfaceErrors& errors, std::size_t place, std::span<const std::size_t> near, double tilt);

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
