// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <memory>

namespace treadmark::kalker {

/// One transform size of one FFT library; see RealFft2d for the contract. Immutable, callable from any thread.
/// Arrays begin at cache lines (AlignedVector).
class FftPlan {
 public:
  virtual ~FftPlan() = default;
  /// Along the active rows; real is overwritten.
  virtual void rows_forward(double* real, std::complex<double>* spectrum) const = 0;
  virtual void rows_inverse(std::complex<double>* spectrum, double* real) const = 0;
  /// Along the columns of all rows, in place.
  virtual void columns_forward(std::complex<double>* spectrum) const = 0;
  virtual void columns_inverse(std::complex<double>* spectrum) const = 0;
};

/// Defined by the library that is compiled in. Calls are serialised by the caller.
std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows);

}  // namespace treadmark::kalker
