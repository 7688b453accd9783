// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>

namespace treadmark::displacement {

/// Arithmetic of DisplacedBand for many points, on raw numbers only, see core/kernel.hpp.

/// Axes of the natural directions in the plane: along and up of a rail (x, z of the surface frame), across both.
struct BandAxes {
  bool wheel;
  double along[3], up[3], across[3];
};

/// Points of one row. See DisplacedLine for F; e is the direction of the offset.
struct BandPoints {
  const double *t, *d, *d_u, *d_y;  ///< where the offset was asked, offset and its derivatives
  const double *sin, *cos, *per_r;  ///< of a wheel's theta
  const double *h, *hx, *hy;        ///< base
  double *step, *steepness;         ///< from t to the zero of F; |grad(t - h)|
  double *gx, *gy, *gz;             ///< gradient of F
  double *back_x, *back_y;          ///< d e: how far points are moved back
};

/// Points (x[i], t[i]) of one row: o + x ex + t et in the axle's plane (a: sine part, b: cosine part).
struct BandTurn {
  double oa, xa, ta, ob, xb, tb;
  double theta, sin, cos;  ///< near which most points lie
};

/// Where heights change smoothly from point to point.
enum Smooth : std::uint8_t {
  kAlongX = 1,  ///< from the neighbour before x to the one behind
  kAlongY = 2,
  kAround = 4,  ///< among all eight neighbours
};
/// Second differences that may be, where there is no slope.
struct BendLimits {
  double per_dx, per_dy, most_x, most_y;
};

struct BandKernel {
  /// F and its gradient; h, hx, hy belong to the point moved back, or (tangent) to the point itself.
  void (*solve_moved)(const BandAxes& axes, std::size_t n, const BandPoints& points);
  void (*solve_tangent)(const BandAxes& axes, std::size_t n, const BandPoints& points);
  /// theta and its sine, cosine, 1/r. False: too far from theta for its series, u is not good.
  bool (*turn)(const BandTurn& turn, std::size_t n, const double* x, const double* t, double* u, double* sin,
               double* cos, double* per_r);
  /// Polynomials of fourth order through 5 x 5 heights about each of n neighbouring points, rows[k] two rows before to
  /// two behind, at (sx, sy) steps from them: value and derivatives by steps.
  void (*interpolate)(std::size_t n, const double* const rows[5], const double* sx, const double* sy, double* h,
                      double* h_sx, double* h_sy);
  /// What such polynomials leave out, of values and of derivatives by sx and sy, at n points: from the |fifth
  /// differences| along x of five rows, and the two along y of n + 4 neighbouring columns.
  void (*missing)(std::size_t n, const double* const along[5], const double* const across[2], const double* sx,
                  const double* sy, double* value, double* by_sx, double* by_sy);
  /// |Fifth differences| of six arrays; 1e300 for NaN.
  void (*fifth)(std::size_t n, const double* const six[6], double* difference);
  /// kAlongX and kAlongY where second differences of a row with its neighbours (z[-1] to z[n]) are within the limits.
  void (*bends)(std::size_t n, const double* z, const double* before, const double* behind, const BendLimits& limits,
                std::uint8_t* bends);
  /// Smooth, from bends of a row and of those beside it (entries -1 to n).
  void (*smooth)(std::size_t n, const std::uint8_t* before, const std::uint8_t* row, const std::uint8_t* behind,
                 std::uint8_t* smooth);

  static const BandKernel generic;
  static const BandKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::displacement
