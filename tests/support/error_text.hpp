// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::testing {

/// What an action that must fail says: "kind: file: message"; empty if it does not fail.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    const char* kind = error.kind() == ErrorKind::input_data      ? "input data"
                       : error.kind() == ErrorKind::configuration ? "configuration"
                                                                  : "numerical";
    return std::string(kind) + ": " + error.where().to_string() + ": " + error.message();
  }
  return {};
}

}  // namespace treadmark::testing
