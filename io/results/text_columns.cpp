// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/text_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace treadmark::io {
namespace {

constexpr int kWidth = 21;
constexpr double kLargestWhole = 1e9;

std::string column(double value) {
  if (std::isnan(value)) return fmt::format("{:>{}}", "NaN", kWidth);
  if (std::abs(value) < kLargestWhole && value == std::trunc(value))
    return fmt::format("{:>{}d}", static_cast<long long>(value), kWidth);
  return fmt::format("{:>{}.12E}", value, kWidth);
}

}  // namespace

std::string column_head(std::span<const std::string_view> names) {
  std::string line = "%";
  int width = kWidth - 1;
  for (const std::string_view name : names) {
    line += fmt::format("{:>{}}", name, width);
    width = kWidth;
  }
  return line + "\n";
}

std::string column_line(std::span<const double> values, std::size_t count) {
  std::string line;
  for (const double value : values) line += column(value);
  for (std::size_t k = values.size(); k < count; ++k) line += column(0.0);
  return line + "\n";
}

}  // namespace treadmark::io
