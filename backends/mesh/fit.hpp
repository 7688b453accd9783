// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::mesh {

/// The surroundings of four vertices and the cubics through them, each in its lane. Rows of zeros count for nothing.
struct FitBlock {
  static constexpr int kLanesOfFit = 4, kMostRows = 32, kTerms = 9;

  int rows = 0;                              ///< of the vertex with most neighbours
  double count[kLanesOfFit];                 ///< neighbours of each
  double normal[3][kLanesOfFit];             ///< of the tangent planes
  double axis_u[3][kLanesOfFit];             ///< any axis in the plane; comes back along the longest spread
  double axis_v[3][kLanesOfFit];             ///< comes back: normal x axis_u
  double from[kMostRows][3][kLanesOfFit];    ///< neighbours, from the vertex [m]
  double cubic[kTerms][kLanesOfFit];         ///< comes back: as in VertexFit
  double least_singular_value[kLanesOfFit];  ///< comes back: no more than that of the columns at unit length
};

struct FitKernel {
  /// Weighted least squares as in vertex_fit.cpp, without pivots. What the points do not determine comes back with a
  /// small singular value, or one that is not a number.
  void (*cubics)(FitBlock& block);

  static const FitKernel generic;
  static const FitKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::mesh
