// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace treadmark {

/// What a build may leave out, as told by the table in cmake/TreadmarkParts.cmake.
struct Part {
  std::string_view key;       ///< "openvdb": that functions below take
  std::string_view name;      ///< "OpenVDB": for people
  std::string_view option;    ///< of CMake, that puts it in
  std::string_view packages;  ///< of Debian; empty: it needs none
  bool built = false;         ///< whether this build has it
};

/// All of them, in the order of the table.
std::span<const Part> parts();

/// Whether this build has the part. Errors of this and the following: std::invalid_argument for a key that is none.
bool has_part(std::string_view key);

/// "this build leaves out the backend 'level-set' (OpenVDB)", where what is "the backend 'level-set'".
std::string left_out_message(std::string_view key, std::string_view what);
/// How it is put in: option and packages.
std::string left_out_advice(std::string_view key);

/// Both as Error(configuration).
[[noreturn]] void left_out(std::string_view key, std::string_view what);
/// The same unless this build has the part.
void require_part(std::string_view key, std::string_view what);

}  // namespace treadmark
