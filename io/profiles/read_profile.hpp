// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/model/profile.hpp"

namespace treadmark::io {

/// Formats of lateral profiles.
enum class ProfileFormat {
  simpack,     ///< .prr (rail), .prw (wheel): header, processing data and points in sections
  miniprof,    ///< .ban (rail), .whl (wheel): lines Key=value, then columns
  two_column,  ///< any other extension: y z
};

/// The format that the extension stands for, upper or lower case.
ProfileFormat profile_format(const std::filesystem::path& file);

/// Reads and cleans one profile: near points, zig-zags, shifts, bounds, mirroring, scale, order of the points. The
/// result is in metres, a rail with increasing and a wheel with decreasing y.
///
/// options.mirror_z = 0 leaves a Simpack file to its own flag and judges other files by their shape; a mirror option of
/// 1 together with the flag in a Simpack file means no mirroring. options.zigzag_threshold counts as 45 degrees at
/// least, options.max_omit >= 1 lets the clean-up remove any number of points. Kinks stay for the spline to handle.
/// Points nearer than 1e-4 mm to their predecessor are dropped (Simpack: its own distance, in its own unit).
///
/// Throws Error(input_data) for a missing or broken file, placed at the text at fault, a missing file at
/// referenced_from; for points that form no profile (fewer than 2, length outside 5..500 mm, wrong direction, crossing
/// itself); Error(configuration) for options without meaning and for an extension of the other body.
/// Thread-safe. The file's own unit is undone first, then options.scale leads to mm.
Profile read_profile(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                     const SourcePosition& referenced_from = {});

/// The same from text in memory; `file` is only used for messages and the name of the profile.
Profile parse_profile(std::string_view text, const std::string& file, ProfileFormat format, Body body,
                      const ProfileOptions& options);

/// Whether options.mirror_z = 0 would turn the file over, judged by the shape of its section; none: a format that says
/// itself. Throws as read_profile for a missing or broken file.
std::optional<bool> looks_upside_down(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                                      const SourcePosition& referenced_from = {});

}  // namespace treadmark::io
