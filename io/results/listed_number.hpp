// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/results/quantities.hpp"

namespace treadmark::io {

/// A number that tables of many results have of each: of the case ("wheelset.z_mm", "npatch"), of the patch with the
/// greatest normal force ("pmax_MPa"), or of one patch, counted from the field side ("patch_2.pmax_MPa").
struct ListedNumber {
  std::string name;     ///< as in JSON
  std::string si_name;  ///< without the unit
  std::string meaning;
  const Quantity<CaseResult>* of_case = nullptr;
  const Quantity<PatchResult>* of_patch = nullptr;  ///< neither: the number of patches
  int patch = 0;                                    ///< from 1; 0: the one with the greatest normal force

  std::string_view unit() const;                ///< SI; "1" = none
  double si(const CaseResult& result) const;    ///< NaN where it is not known
  double in_file(double si, bool shift) const;  ///< in the unit of its name; shift: of a case in shift
};

enum class Names { in_file, si };
/// The number of this name. Errors: Error(configuration) that names the nearest.
ListedNumber listed_number(std::string_view name, Names names = Names::in_file);

/// What tables have unless they are asked for others; of a patch by itself those that it can have.
std::vector<ListedNumber> usual_numbers(bool wheel_on_rail);

}  // namespace treadmark::io
