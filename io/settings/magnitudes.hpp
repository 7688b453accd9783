// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

namespace treadmark::io {

/// Numbers beyond these have no meaning in the unit that the name of a key ends with, and nothing is promised of the
/// sums, squares and quotients that they would become. Limits of a key itself are narrower.
struct Magnitudes {
  std::string_view ending;  ///< of the key; empty: all others
  double greatest = 0.0;    ///< magnitude, in the unit of the key
  double least = 0.0;       ///< of keys that must be positive
};

const Magnitudes& magnitudes_of(std::string_view path);

/// All of them as a Markdown table, for the documentation.
std::string magnitude_table();

}  // namespace treadmark::io
