// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::io {

/// A number, vector or text that describes a part of a file, in SI units.
struct Attribute {
  using Value = std::variant<int, double, Vec3, Mat3, std::string, std::vector<std::string>>;
  std::string name;
  Value value;
};

}  // namespace treadmark::io
