// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/rail_head.hpp"

#include <cmath>

namespace treadmark {
namespace {

std::optional<std::size_t> top_of(std::span<const double> z, std::size_t first, std::size_t last) {
  std::optional<std::size_t> top;
  for (std::size_t i = first; i <= last; ++i)
    if (!std::isnan(z[i]) && (!top || z[i] < z[*top])) top = i;
  return top;
}

}  // namespace

std::optional<RailHead> head_of_rail(std::span<const double> y, std::span<const double> z, double depth, bool innermost,
                                     const std::function<double(std::size_t)>& height) {
  if (z.empty()) return std::nullopt;
  RailHead head;
  for (std::optional<std::size_t> top = top_of(z, 0, z.size() - 1); top; top = top_of(z, head.first, head.last)) {
    head.top = *top;
    head.z_top = height ? height(*top) : z[*top];
    const auto is_high = [&](double z_here) { return z_here - head.z_top <= depth; };
    double widest = -1.0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (!is_high(z[i])) continue;
      const std::size_t first = i;
      std::size_t last = i;
      for (; i + 1 < z.size() && (is_high(z[i + 1]) || std::isnan(z[i + 1])); ++i)
        if (!std::isnan(z[i + 1])) last = i + 1;
      const double width = std::fabs(y[last] - y[first]);
      if (widest >= 0.0 && (innermost || width < widest)) continue;
      widest = width, head.first = first, head.last = last;
    }
    if (widest < 0.0) return std::nullopt;
    if (innermost || (head.first <= head.top && head.top <= head.last)) return head;
  }
  return std::nullopt;
}

}  // namespace treadmark
