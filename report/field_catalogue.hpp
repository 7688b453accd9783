// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "treadmark/io/results/field_table.hpp"

namespace treadmark::report {

/// A quantity of the elements of a patch as reports and pictures show it.
struct FieldInfo : io::ShownField {
  std::string_view name;
  const io::FieldColumn* column = nullptr;  ///< of the files; nullptr: states
  const io::FieldColumn* other = nullptr;   ///< not nullptr: the quantity is the length of both
  bool of_shifts = false;                   ///< shown in the unit that the column has in a shift

  /// Values in the shown unit, one an element, NaN = none; empty where the patch does not have the quantity. Not for
  /// states.
  std::vector<double> values(const io::PatchResult& patch) const;
};

/// All quantities, the more important first.
std::span<const FieldInfo> field_catalogue();

/// The quantity of this name, nullptr = there is none.
const FieldInfo* find_field(std::string_view name);

}  // namespace treadmark::report
