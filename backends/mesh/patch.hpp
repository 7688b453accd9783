// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/kernel_types.hpp"

namespace treadmark::mesh {

/// A smooth triangle made ready for the lines of a plane: everything that its points share. Numbers of its entries:
enum PatchEntry : int {
  kCornerPlaces = 0,  ///< x, y, z of the corners in the plane frame
  kFeet = 9,          ///< edge_feet
  kReach = 12,        ///< greatest distance from the facet along the lines [m]
  kInverseArea = 13,  ///< of twice the area in the plane, signed
  kFits = 14,         ///< of corner k at kFits + k * kFitEntries
  // places (u, v, w) of the next two corners in the frame of this fit, the direction of the lines, the cubic, and the
  // second and third derivatives along the lines: bend + bend_u u + bend_v v, twist
  kNextU = 0,
  kNextV,
  kNextW,
  kOtherU,
  kOtherV,
  kOtherW,
  kAlongU,
  kAlongV,
  kAlongW,
  kCubic,
  kBend = kCubic + 9,
  kBendU,
  kBendV,
  kTwist,
  kFitEntries,
  kPatchEntries = kFits + 3 * kFitEntries,
};

/// A VertexFit as it is kept, in a line of the cache. The third axis is normal x axis_u.
struct alignas(64) KeptFit {
  float normal[3], axis_u[3], cubic[9];
};

/// What prepare_patch needs of a triangle.
struct PatchSource {
  const KeptFit* fits[3];
  const double* corners[3];  ///< local [m]
  const double* places;      ///< the corners in the plane frame, x, y, z one after the other
  double bulge;              ///< [m] along the mean normal
};

/// Lines of one triangle, or of up to four triangles: heights, and slopes if wanted (else null). Those that need a
/// closer look (corners, grazing lines, surfaces beyond the reach) get NaN.
struct PatchKernel {
  void (*prepare)(const PlaneLines& lines, const PatchSource& source, double* patch);
  void (*points)(const double* patch, double side, const double* x, const double* y, int count, double* z, double* dzdx,
                 double* dzdy);
  /// patches: one after the other. x, y and the results have four entries.
  void (*mixed)(const double* patches, double side, const double* x, const double* y, double* z, double* dzdx,
                double* dzdy);
  /// The greatest distance between facet and surface along a direction from inside, sampled; not a number where the
  /// surface grazes or cannot be found. Of the source, places do not count, and its bulge is no limit if infinite.
  double (*bulge)(const PatchSource& source, const double* direction);

  static const PatchKernel generic;
  static const PatchKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::mesh
