// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

namespace treadmark {

/// How names of representations look in case files, on the command line and in the registry, as a regular expression.
inline constexpr const char* kBackendPattern = "^[a-z][a-z0-9_-]*$";
inline constexpr const char* kBackendLike = "\"mesh-flat\": small letters, digits, - and _";

/// Whether the text looks like such a name; which of them exist is for the registry to say.
constexpr bool is_backend_name(std::string_view text) {
  return !text.empty() && text.front() >= 'a' && text.front() <= 'z' &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string_view::npos;
}

}  // namespace treadmark
