// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <limits>

#include "treadmark/core/pose.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/points/line_blocks.hpp"
#include "treadmark/io/points/number.hpp"

namespace treadmark::io::points {

/// The number in a field, which may be NaN or infinite. Error(input_data) at the field for anything else.
inline double number_in(const LineBlocks& lines, const Field& field, bool decimal_comma = false) {
  double value = 0.0;
  if (parse_number(field.text, decimal_comma, value)) return value;
  const bool comma = !decimal_comma && field.text.find(',') != std::string_view::npos;
  lines.fail("a number is expected, this is " + profiles::printable(field.text), field.column,
             comma ? "write decimal points, or separate numbers with decimal commas by ';'" : "");
}

/// A number of elements. Error(input_data) at the field for anything but a whole number up to 1e12.
inline std::uint64_t count_in(const LineBlocks& lines, const Field& field) {
  double value = 0.0;
  if (!parse_number(field.text, false, value) || !is_whole(value) || value < 0.0 || value > 1e12)
    lines.fail("a number of elements is expected, this is " + profiles::printable(field.text), field.column);
  return static_cast<std::uint64_t>(value);
}

/// The three numbers behind a key, as the sink reads numbers. what: the message where they are fewer.
template <class Sink>
Vec3 three_in(const LineBlocks& lines, FieldScanner& fields, const Field& key, const char* what) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) {
    Field field;
    if (!fields.next(field)) Sink::too_few(lines, key, what);
    p[k] = Sink::number(lines, field);
  }
  return p;
}

}  // namespace treadmark::io::points
