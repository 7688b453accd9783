// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>

namespace treadmark::kalker {

/// (x, y) -> block (x, y) at n places of spectra, on raw numbers only, see core/kernel.hpp. A block is three numbers
/// (xx, xy, yy); real and imaginary parts alternate in x, y and the factors that turn both afterwards. All kernels give
/// the same bits: those for AVX2 are compiled without multiply-adds.
struct SpectrumKernel {
  void (*plain)(std::size_t n, const double* blocks, double* x, double* y);
  /// One factor for all places.
  void (*turned)(std::size_t n, const double* blocks, double* x, double* y, double real, double imaginary);
  /// A factor for each place.
  void (*turned_each)(std::size_t n, const double* blocks, double* x, double* y, const double* factors);

  static const SpectrumKernel generic;
  static const SpectrumKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::kalker
