// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::spline {

// Heights of regular patches (see nurbs_leaf.hpp) on the points of a grid, four patches or points at a time, on plain
// arrays. Whatever a kernel cannot settle it reports, and scalar code does it again.

/// A polynomial patch by its corners (i along u, j along v): at each p, p_u, p_v and p_uv, twelve numbers.
struct PatchCorners {
  const double* corner[2][2];
  double size_u, size_v;  ///< of the patch in its parameters
};

/// The frame of the plane and which of several hits counts.
struct ViewArrays {
  double to_plane[9], origin[3];  ///< p_P = to_plane (p_S - origin), row by row
  double side;                    ///< +1: the greatest height is outermost, -1: the least
  bool half;                      ///< only heights from lowest[0] + lowest[1] x + lowest[2] y upwards count
  double lowest[3];
};

/// Points of a tile of a grid: x = x0 + (ix0 + i) dx, z[i + stride * j]. Fields hold the outermost hits so far, or NaN;
/// those of the slopes may be null, both together.
struct TileArrays {
  double x0, y0, dx, dy;
  int ix0, iy0, nx, ny;
  long stride;
  double *z, *dzdx, *dzdy;
};

/// A regular patch by the powers of s and t (index = 4 i + j), with A of nurbs_leaf.hpp scaled so that A (p - middle)
/// is a first guess.
struct alignas(32) PatchPowers {
  double x[16], y[16], z[16], w[16];
  double a[4], middle[2];
  double bend[6];   ///< of s and t by their squares and product: a better guess
  double reach[4];  ///< least and greatest A (p - middle), s first, of lines that meet it
  double range[4];  ///< of control points: x from, to, y from, to
  bool rational;
};

struct NurbsKernel {
  /// Adds the hits of patches. left[k] = 1 for those that are not regular or have a point that did not settle, else 0.
  void (*hit_corners)(const ViewArrays& view, const PatchCorners* patches, int count, const TileArrays& tile,
                      char* left);
  /// The same for one patch; false: a point did not settle.
  bool (*hit)(const ViewArrays& view, const PatchPowers& patch, const TileArrays& tile);

  static const NurbsKernel generic;
  static const NurbsKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::spline
