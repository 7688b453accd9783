// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/frequencies.hpp"

#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

std::vector<double> frequencies(double from, double to, int count) {
  if (!(from > 0.0) || !(to > from) || count < 2)
    throw Error(ErrorKind::configuration,
                fmt::format("{} frequencies from {:g} to {:g} Hz make no range", count, from, to));
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) all.push_back(from * std::pow(to / from, i / (count - 1.0)));
  all.back() = to;
  return all;
}

}  // namespace treadmark::vehicle
