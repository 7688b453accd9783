// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::app {

/// What commands say about a wheel or rail that they name by a file.
struct NamedSurface {
  std::optional<Body> body;            ///< needed where the file does not tell: cases, triangles, two-column profiles
  double nominal_radius = 0.0;         ///< of a wheel [m]; 0 = the case's, or that of an offset file
  double scale_to_mm = 1.0;            ///< of triangle and profile files
  std::vector<std::string> overrides;  ///< of a case
};

/// The body of a name of the profile library; nothing for files that are there, and for other names. Errors: those of
/// library_body.
std::optional<Body> library_body_of(const std::filesystem::path& file);

/// The profile of the library that a name was probably meant to be; empty where none is near.
std::string nearest_library_name(const std::string& name);

/// Errors: always, MissingFile of this kind, which names the file or the profile of the library that was probably
/// meant.
[[noreturn]] void refuse_missing_surface(const std::filesystem::path& file, ErrorKind kind);

/// Keys are those of cases. Errors: Error(configuration) for changes of keys ("key.path=value") of a file that is none.
void refuse_overrides(const std::string& file, std::span<const std::string> overrides);

/// Errors: Error(configuration) for a nominal radius [m] that no wheel has, as one in another unit.
void require_wheel_radius(double radius);

/// Reads any geometry: profile, slices, triangles, offsets, a name of the profile library, or the wheel or rail of the
/// first case of a case file.
/// Errors: those of readers and backends; Error(configuration) if the body is not known or something said does not fit
/// the file.
NaturalSurface named_surface(const std::filesystem::path& file, const NamedSurface& said);

using Range = std::optional<std::pair<double, double>>;

/// The part of a surface that is asked for: along the track [m] or round the wheel [rad]; all of it without a range.
/// Errors: Error(configuration) for the other body's range, or one that runs backwards.
Region part_of(Body body, const Range& range_x, const Range& range_theta);

}  // namespace treadmark::app
