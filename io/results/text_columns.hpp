// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace treadmark::io {

/// Columns of text as numerical tools load them: names behind a percent sign, numbers with 13 significant digits, whole
/// numbers without a fraction, columns of equal width.

/// "% NAME NAME ...", names over their columns.
std::string column_head(std::span<const std::string_view> names);

/// One line of numbers, filled up with zeros to `count` columns where there are fewer values.
std::string column_line(std::span<const double> values, std::size_t count = 0);

}  // namespace treadmark::io
