// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark {

/// What an import left open about where a surface lies ("no_flange": the flange of a wheel was not scanned): whoever
/// uses the surface is told of it.
struct SurfaceDoubt {
  std::string name, text;

  friend bool operator==(const SurfaceDoubt&, const SurfaceDoubt&) = default;
};

/// How the lines begin that tell files of surfaces, as comments, what is doubted.
inline constexpr std::string_view kSurfaceDoubt = "surface-doubt";

/// Lines for people and machines, of at most 200 characters; none without doubts. Thread-safe, as what follows.
std::vector<std::string> to_lines(std::span<const SurfaceDoubt> doubts);

/// The names alone, for a head of few characters; empty without doubts.
std::string names_line(std::span<const SurfaceDoubt> doubts);

/// From lines of either kind, without signs of comments; those that begin otherwise do not count. What is no printable
/// character of ASCII is a question mark.
std::vector<SurfaceDoubt> doubts_of_lines(std::span<const std::string> lines);

/// Those that are not there yet.
void add_doubts(std::vector<SurfaceDoubt>& to, std::span<const SurfaceDoubt> from);

/// "wheel surface FILE: no_flange: the flange was not scanned ...".
std::string in_words(const SurfaceDoubt& doubt, std::string_view body, const std::string& file);

}  // namespace treadmark
