// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::mesh {
namespace {

/// Least and greatest z of the part of a triangle over the rectangle round (x, y); false if it lies beside.
[[maybe_unused]] bool clipped_heights(const double (&triangle)[9], double x, double y, double half_x, double half_y,
                                      double& low, double& high) {
  // one side after the other cuts off what lies beyond it (Sutherland & Hodgman 1974); each adds at most one corner
  double corners[8][3], kept[8][3];
  int count = 3;
  for (int k = 0; k < 3; ++k) {
    corners[k][0] = triangle[3 * k] - x;
    corners[k][1] = triangle[3 * k + 1] - y;
    corners[k][2] = triangle[3 * k + 2];
  }
  for (int cut = 0; cut < 4; ++cut) {
    const int axis = cut / 2;
    const double sign = cut % 2 == 0 ? 1.0 : -1.0, half = axis == 0 ? half_x : half_y;
    int n = 0;
    for (int k = 0; k < count; ++k) {
      const double *a = corners[k], *b = corners[k + 1 == count ? 0 : k + 1];
      const double beyond_a = sign * a[axis] - half, beyond_b = sign * b[axis] - half;
      if (beyond_a <= 0.0) {
        for (int i = 0; i < 3; ++i) kept[n][i] = a[i];
        ++n;
      }
      if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0)) {
        const double part = beyond_a / (beyond_a - beyond_b);
        for (int i = 0; i < 3; ++i) kept[n][i] = a[i] + (b[i] - a[i]) * part;
        ++n;
      }
    }
    count = n;
    for (int k = 0; k < count; ++k)
      for (int i = 0; i < 3; ++i) corners[k][i] = kept[k][i];
  }
  if (count == 0) return false;
  low = high = corners[0][2];
  for (int k = 1; k < count; ++k) {
    if (corners[k][2] < low) low = corners[k][2];
    if (corners[k][2] > high) high = corners[k][2];
  }
  return true;
}

}  // namespace
}  // namespace treadmark::mesh
