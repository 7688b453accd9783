// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace treadmark::io {

/// What a column of a recording of a track may hold.
enum class Recorded {
  distance,
  metres,  ///< behind the kilometre that another column holds
  level,
  cross_level,
  cant,  ///< the cross level by the name of the design value
  alignment,
  gauge,
};

/// What the name of a column says.
struct RecordedColumn {
  Recorded what = Recorded::distance;
  int rail = 0;        ///< -1 left, 1 right, 0 track
  double unit = 0.0;   ///< factor to metres; 0: not said
  int band = 0;        ///< 1 to 3: D1 to D3 of EN 13848-1, 9: D0, 0: none
  int longest = 0;     ///< of wavelengths that are left [m]; 0: not said
  double nominal = 0;  ///< gauge that the name states, in its own unit; 0: none
};

/// The meaning of a name such as "LL_L [mm]", "Longitudinal level left", "Ausrichtung rechts (1/100 mm)"; nothing where
/// a word of it is unknown. Capitals, accents and signs between words make no difference.
std::optional<RecordedColumn> recorded_column(std::string_view name);

/// The factor to metres of "mm", "[mm]", "1/100 mm", "0.01 mm", "km", "ft"; 0 for anything else.
double recorded_unit(std::string_view text);

/// The nominal gauge [m] that a line such as "Nominal gauge: 1676 mm" states; 0 for any other.
double stated_gauge(std::string_view line);

/// Whether a name holds a word for something that a recording is read for.
bool names_something_recorded(std::string_view name);

/// The words that are known, as docs/layout.md shows them.
std::string recording_names_table();

}  // namespace treadmark::io
