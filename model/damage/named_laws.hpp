// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "treadmark/model/damage/fatigue.hpp"
#include "treadmark/model/damage/wear_law.hpp"

namespace treadmark {

/// A theory of wear (kWearTheories) or a measure of fatigue with the numbers that somebody published. SI.
struct NamedLaw {
  const char* name;                                ///< in files
  std::variant<WearLaw, FatigueSettings> numbers;  ///< complete
  const char *source, *validity;                   ///< author, year, table or figure; what the numbers are for
  bool verified = false;                           ///< the numbers have been compared with the source itself

  std::string_view kind() const;  ///< word of its theory or measure
  /// Whether its theory of wear is this one.
  bool is(WearTheory theory) const {
    const auto* wear = std::get_if<WearLaw>(&numbers);
    return wear != nullptr && wear->theory == theory;
  }
};

/// The one place of published numbers.
std::span<const NamedLaw> named_laws();
/// Null for a name that is none.
const NamedLaw* law_named(std::string_view name);

/// Names of the laws with numbers of one of these kinds.
template <class... Numbers>
std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const NamedLaw& law : named_laws())
    if ((std::holds_alternative<Numbers>(law.numbers) || ...)) names.emplace_back(law.name);
  return names;
}

}  // namespace treadmark
