// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "treadmark/model/shape/length_unit.hpp"

namespace treadmark::io::points {

/// The unit that a word names: a symbol ("mm", "um") or a name in English, British or American, any case.
std::optional<LengthUnit> unit_of_word(std::string_view word);

/// The unit that a comment states: "unit: mm", "units are in inches", "[mm]", "coordinates in metres", or a phrase that
/// is the name of a unit and nothing more ("millimetres"). Other mentions of a unit ("5 mm spacing", "calibrated in m",
/// "speed unit: m/s") count for nothing.
std::optional<LengthUnit> unit_in_words(std::string_view text);

/// A unit that a file states and that is none of LengthUnit.
struct UnknownUnit {
  std::string word;
  bool of_length = false;    ///< one of length for certain: "mil", "cm", "0.01 mm"
  double millimetres = 0.0;  ///< in one of it; 0: nobody knows
};
/// Of a word that stands where a unit does ("mil", what brackets hold); nothing for units that are known.
std::optional<UnknownUnit> unknown_unit_of_word(std::string_view word);
/// What a comment says behind the word unit ("unit: mil"), where no known unit is stated.
std::optional<UnknownUnit> unknown_unit_in_words(std::string_view text);

/// The unit in the name of a column: "X [mm]", "x(mm)", "x_mm", "x mm". The name is cut to what stands before it.
std::optional<LengthUnit> take_unit(std::string_view& name);

/// Of the name of a column, a unit of length that is none of LengthUnit: "z [0.01 mm]", "z_cm".
std::optional<UnknownUnit> unknown_unit_of_name(std::string_view name);

/// Collects what several places of a file say; where they differ, the file says nothing.
class UnitFinder {
 public:
  void add(std::optional<LengthUnit> unit) {
    if (!unit) return;
    if (unit_ && *unit_ != *unit) differ_ = true;
    unit_ = unit;
  }
  void look_at(std::string_view comment) {
    add(unit_in_words(comment));
    if (!unknown_) unknown_ = unknown_unit_in_words(comment);
  }
  std::optional<LengthUnit> unit() const { return differ_ ? std::nullopt : unit_; }
  bool differ() const { return differ_; }
  /// What comments state instead of a unit that is known.
  const std::optional<UnknownUnit>& unknown() const { return unknown_; }

 private:
  std::optional<LengthUnit> unit_;
  std::optional<UnknownUnit> unknown_;
  bool differ_ = false;
};

}  // namespace treadmark::io::points
