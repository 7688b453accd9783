// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app::report {

/// A quantity of the elements of a patch as reports and pictures show it.
struct FieldInfo {
  enum class Kind { sequential, diverging, state };
  std::string_view name, label, unit;
  Kind kind;
  /// Values in the shown unit, one an element, NaN = none; empty where the patch does not have the quantity. Not for
  /// states.
  std::vector<double> (*values)(const io::PatchResult& patch);
};

/// All quantities, the more important first.
std::span<const FieldInfo> field_catalogue();

/// The quantity of this name, nullptr = there is none.
const FieldInfo* find_field(std::string_view name);

}  // namespace treadmark::app::report
