// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>

#include "treadmark/core/pose.hpp"

namespace treadmark::detection {

/// A place on a mesh of rows x columns corners: facet (k, j) and where in it.
struct FacetPlace {
  int k = 0, j = 0;
  double u = 0.0, v = 0.0;  ///< from corner (k, j) to (k + 1, j) and to (k, j + 1)
};

/// Where on a mesh of bilinear facets (x, y) lies: Newton's method, facet by facet, from indices (a, b) that need not
/// be whole and that are replaced by those found. corner(k, j) gives a corner. Returns false where there are no facets,
/// or none near.
template <class Corner>
bool find_facet(Corner&& corner, int rows, int columns, double x, double y, double& a, double& b, FacetPlace& place) {
  constexpr int kMaxSteps = 40;
  for (int step = 0; step < kMaxSteps; ++step) {
    const int k = std::clamp(static_cast<int>(std::floor(a)), 0, rows - 2);
    const int j = std::clamp(static_cast<int>(std::floor(b)), 0, columns - 2);
    const double u = a - k, v = b - j;
    // Copies: corners may be made, and moved, by asking for others.
    const Vec3 p00 = corner(k, j), p01 = corner(k, j + 1), p10 = corner(k + 1, j), p11 = corner(k + 1, j + 1);
    const Vec3 along = p10 - p00, twist = (p11 - p01) - along, du = along + v * twist, across = p01 - p00,
               dv = across + u * twist;
    const double rx = x - (p00.x() + u * along.x() + v * dv.x()), ry = y - (p00.y() + u * along.y() + v * dv.y());
    const double inverse = 1.0 / (du.x() * dv.y() - du.y() * dv.x());
    const double da = (rx * dv.y() - ry * dv.x()) * inverse, db = (ry * du.x() - rx * du.y()) * inverse;
    if (!std::isfinite(da) || !std::isfinite(db)) return false;
    // The rest of the way is twist * da * db.
    constexpr double kClose = 1e-11;  // [m]
    constexpr double kRim = 1e-7;     // of a facet
    if (std::abs(da * db) * (std::abs(twist.x()) + std::abs(twist.y())) < kClose) {
      const double u_end = u + da, v_end = v + db;
      if (u_end > -kRim && u_end < 1 + kRim && v_end > -kRim && v_end < 1 + kRim) {
        place = {k, j, u_end, v_end};
        a = k + u_end, b = j + v_end;
        return true;
      }
      if (std::abs(da) < kRim && std::abs(db) < kRim) return false;
    }
    a = std::clamp(a + da, -0.5, rows - 0.5);
    b = std::clamp(b + db, -0.5, columns - 0.5);
  }
  return false;
}

}  // namespace treadmark::detection
