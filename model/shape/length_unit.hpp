// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace treadmark {

/// Units that coordinates in files of other programs come in.
enum class LengthUnit { metre, millimetre, micrometre, inch };

inline constexpr std::array<LengthUnit, 4> kLengthUnits{LengthUnit::metre, LengthUnit::millimetre,
                                                        LengthUnit::micrometre, LengthUnit::inch};

/// Metres in one of the unit.
constexpr double metres_per(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return 1.0;
    case LengthUnit::millimetre:
      return 1e-3;
    case LengthUnit::micrometre:
      return 1e-6;
    case LengthUnit::inch:
      return 25.4e-3;
  }
  return 1.0;
}

/// "m", "mm", "um", "in".
constexpr std::string_view symbol(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return "m";
    case LengthUnit::millimetre:
      return "mm";
    case LengthUnit::micrometre:
      return "um";
    case LengthUnit::inch:
      return "in";
  }
  return "m";
}

/// The unit of this symbol; none for another text.
constexpr std::optional<LengthUnit> length_unit(std::string_view symbol_or_nothing) {
  for (const LengthUnit unit : kLengthUnits)
    if (symbol(unit) == symbol_or_nothing) return unit;
  return std::nullopt;
}

}  // namespace treadmark
