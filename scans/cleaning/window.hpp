// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::scans {

/// The surroundings of a cell: places that run from -1 to 1 and heights [m], padded so that lanes need no ends.
struct Window {
  static constexpr int kMost = 224, kLanes = 8, kTerms = 6, kMoments = 15;

  int count = 0;
  float x[kMost], y[kMost], d[kMost];
  float size[kMost];  ///< of the residuals
};

/// How residuals weigh: all alike, by their absolute value, by Tukey's biweight.
enum class WindowWeights { even, absolute, biweight };

/// Arithmetic over the points of a window, about the quadratic c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2.
struct WindowKernel {
  /// Sums over the points of weight x^i y^j for i + j <= 4 (j by j: moments[0 ... 4] of y^0) and of weight d times the
  /// terms of the quadratic. scale: the residual up to which absolute values weigh 1; the one from which the biweight
  /// is 0.
  void (*sums)(const Window& window, const double* c, WindowWeights weights, double scale, double* moments,
               double* products);
  /// Writes the sizes of the residuals and tells that of rank count / 2 and the greatest one.
  void (*sizes)(Window& window, const double* c, float* middle, float* greatest);

  static const WindowKernel generic;
  static const WindowKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::scans
