// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>

#include "treadmark/core/surface.hpp"

namespace treadmark::mesh {

/// Writes what is wanted of a point.
struct Results {
  const HeightsOut& out;
  bool slopes;

  explicit Results(const HeightsOut& o) : out(o), slopes(!o.dzdx.empty() || !o.dzdy.empty()) {}

  void put(std::size_t i, double z, double dzdx, double dzdy) const {
    if (!out.z.empty()) out.z[i] = z;
    if (!out.dzdx.empty()) out.dzdx[i] = dzdx;
    if (!out.dzdy.empty()) out.dzdy[i] = dzdy;
  }
  void miss(std::size_t i) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    put(i, kNaN, kNaN, kNaN);
  }
};

}  // namespace treadmark::mesh
