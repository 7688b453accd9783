// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <span>

#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

/// Value for an index offset "observation minus source", |dix| < nx, |diy| < ny.
using OffsetKernel = std::function<double(int dix, int diy)>;

using Spectrum = AlignedVector<std::complex<double>>;

/// spectrum[k] *= factor[k]; equal sizes.
void multiply(std::span<std::complex<double>> spectrum, std::span<const std::complex<double>> factor);

/// sum[k] += weight * field[k] * factor[k]; equal sizes.
void add_product(std::span<std::complex<double>> sum, std::span<const std::complex<double>> field,
                 std::span<const std::complex<double>> factor, double weight = 1.0);

/// A periodic ring hardly larger than a box of nx columns and ny rows, its active ones: on it coefficients of influence
/// have an inverse that makes a preconditioner. Wider rings do not save iterations.
RealFft2d ring_about(int nx, int ny);

/// Transform of a kernel that is the same at opposite offsets in both directions (hence real), on the ring of elements
/// of `fft`, divided by their number, in the lines of `fft`. Offsets beyond the active rows count as zero. The kernel
/// is called on any thread.
std::vector<double> even_symbol(const RealFft2d& fft, const OffsetKernel& kernel);

/// field -> symbol * field for fields of ny rows of nx values, zero up to the size of `fft`, which has ny active rows.
/// Input and output may be the same.
void multiply_by_symbol(const RealFft2d& fft, std::span<const double> symbol, int nx, std::span<const double> field,
                        std::span<double> result);

/// Reads rows of a field of nx values a row, filled up with zeros; writes what is left of them.
RealFft2d::LoadRows rows_of(std::span<const double> field, int nx, int padded_nx);
RealFft2d::StoreRows rows_to(std::span<double> field, int nx, int padded_nx);

/// Zero-padded transforms of fields with ny rows of nx values, for convolutions with kernels of index offsets.
/// u = K p reads: forward(p, s); multiply s by kernel_spectrum(K); inverse(s, u). Sums of several kernels and fields
/// are formed between the transforms. Const members may be called from any number of threads.
class ToeplitzTransform {
 public:
  ToeplitzTransform(int nx, int ny);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t size() const { return static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_); }
  std::size_t spectrum_size() const { return fft_.spectrum_size(); }

  /// Spectrum of a kernel, scaled so that a product with a field's spectrum needs no further factor.
  Spectrum kernel_spectrum(const OffsetKernel& kernel) const;
  /// The spectrum in the lines of fft().
  Spectrum in_lines(Spectrum spectrum) const;
  /// field -> kernel * field. Sizes nx * ny; input and output may be the same.
  void convolve(std::span<const std::complex<double>> kernel_spectrum, std::span<const double> field,
                std::span<double> result) const;
  /// The same by an even_symbol of fft().
  void convolve(std::span<const double> symbol, std::span<const double> field, std::span<double> result) const {
    multiply_by_symbol(fft_, symbol, nx_, field, result);
  }
  void forward(std::span<const double> field, std::span<std::complex<double>> spectrum) const;
  /// spectrum is overwritten.
  void inverse(std::span<std::complex<double>> spectrum, std::span<double> field) const;
  /// Transforms along the rows only, ny rows of padded_nx/2+1 values, so that rows may be multiplied by factors (one a
  /// row) before and after a convolution. The inverse overwrites its rows.
  std::size_t rows_size() const { return fft_.rows_size(); }
  void forward_rows(std::span<const double> field, std::span<std::complex<double>> rows) const;
  void inverse_rows(std::span<std::complex<double>> rows, std::span<double> field) const;
  /// spectrum = that of the rows times their factors.
  void forward_columns(std::span<const std::complex<double>> rows, std::span<const double> factor,
                       std::span<std::complex<double>> spectrum) const;
  /// rows += those of the spectrum times their factors; spectrum is overwritten.
  void add_inverse_columns(std::span<std::complex<double>> spectrum, std::span<const double> factor,
                           std::span<std::complex<double>> rows) const;

  /// Size of the padded periodic field (the spectrum has padded_ny rows of padded_nx/2+1 values).
  const RealFft2d& fft() const { return fft_; }
  int padded_nx() const { return fft_.nx(); }
  int padded_ny() const { return fft_.ny(); }

 private:
  Spectrum whole_spectrum(std::span<const double> padded) const;
  void pad(std::span<const double> field, std::span<double> real) const;
  void crop(std::span<const double> real, std::span<double> field) const;

  int nx_, ny_;
  RealFft2d fft_;
};

/// u_I = sum_J kernel(I - J) p_J over fields with ny rows of nx values: by Fourier transform, or directly when small.
/// Const members may be called from any number of threads.
class ToeplitzOperator {
 public:
  ToeplitzOperator(int nx, int ny, const OffsetKernel& kernel);

  /// Sizes nx * ny; p and u must not overlap. Errors: Error(configuration) for other sizes.
  void apply(std::span<const double> p, std::span<double> u) const;
  double at(int dix, int diy) const;

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t size() const { return static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_); }

 private:
  void apply_directly(std::span<const double> p, std::span<double> u) const;

  int nx_, ny_;
  std::vector<double> table_;  ///< (2 nx - 1) x (2 ny - 1) values
  std::optional<ToeplitzTransform> transform_;
  Spectrum spectrum_;
};

}  // namespace treadmark::kalker
