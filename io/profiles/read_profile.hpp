// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/profiles/profile_source.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io {

/// Formats of lateral profiles.
enum class ProfileFormat {
  simpack,     ///< .prr (rail), .prw (wheel): header, processing data and points in sections
  miniprof,    ///< .ban (rail), .whl (wheel), .mpt: header of text, of lines Key=value or of sections, then columns
  gensys,      ///< .wheel: y z, y to the middle of the track, z down
  two_column,  ///< any other extension: columns with or without names; what begins like Simpack or MiniProf is read so
};

/// The format that the extension stands for, upper or lower case.
ProfileFormat profile_format(const std::filesystem::path& file);

/// The file behind a name that may end in '#2' for the second profile in it.
std::filesystem::path profile_file(const std::filesystem::path& name);

/// The body that the extension stands for, upper or lower case; nothing where it says nothing.
std::optional<Body> profile_body(const std::filesystem::path& file);

/// A profile, what its file says besides, and what reading changed.
struct SourcedProfile {
  Profile profile;
  ProfileSource source;
  std::optional<Profile> whole = {};  ///< of the outline of a rail, of which profile is the head: with its web and
                                      ///< foot, not smoothed
};

/// Reads and cleans one profile: near points, zig-zags, shifts, bounds, mirroring, scale, order of the points. The
/// result is in metres, a rail with increasing and a wheel with decreasing y.
///
/// options.mirror_z = 0 leaves a Simpack file to its own flag and judges other files by their shape; a mirror option of
/// 1 together with the flag in a Simpack file means no mirroring. options.zigzag_threshold counts as 45 degrees at
/// least, options.max_omit >= 1 lets the clean-up remove any number of points. Kinks stay for the spline to handle.
/// Points nearer than 1e-4 mm to their predecessor are dropped (Simpack: its own distance, in its own unit), drop-outs
/// too (0 0 beside the profile, -9999 and the like). A unit that the file states counts where options.scale is 1. Text
/// may be UTF-8 or UTF-16. A name that ends in '#2' is the second profile of a file.
///
/// Throws Error(input_data) for a missing or broken file, placed at the text at fault, a missing file at
/// referenced_from; for points that form no profile (fewer than 2, length outside 5..500 mm, wrong direction, crossing
/// itself, with spikes, two profiles in one file, a column that counts as y); Error(configuration) for options without
/// meaning and for an extension of the other body. Thread-safe. The file's own unit is undone first, then options.scale
/// leads to mm.
Profile read_profile(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                     const SourcePosition& referenced_from = {});

/// The same, with what the file says besides.
SourcedProfile read_sourced_profile(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                                    const SourcePosition& referenced_from = {});

/// The same from text in memory; `file` is only used for messages and the name of the profile.
Profile parse_profile(std::string_view text, const std::string& file, ProfileFormat format, Body body,
                      const ProfileOptions& options);

/// Whether options.mirror_z = 0 would mirror z, judged by the shape of its section; none: a format that says
/// itself. Throws as read_profile for a missing or broken file.
std::optional<bool> looks_upside_down(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                                      const SourcePosition& referenced_from = {});

}  // namespace treadmark::io
