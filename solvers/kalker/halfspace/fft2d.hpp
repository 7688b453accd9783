// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace treadmark::kalker {

class FftPlan;

/// Unnormalised discrete Fourier transform of real fields with ny rows of nx values: inverse(forward(x)) = nx * ny * x.
/// Only the first active_rows rows of the field exist; the others are taken as zero by forward and not computed by
/// inverse. Plans are shared by the whole process, which keeps those of the sizes asked for last. All members may be
/// called from any number of threads at the same time. Results do not depend on threads or alignment; arrays of
/// AlignedVector spare a copy.
class RealFft2d {
 public:
  /// nx must be even. Errors: Error(configuration) for odd or non-positive sizes, or active_rows outside 1..ny.
  RealFft2d(int nx, int ny);
  RealFft2d(int nx, int ny, int active_rows);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int active_rows() const { return active_rows_; }
  /// Sizes of the two arrays: active_rows rows of nx reals, ny rows of nx/2+1 complex numbers.
  std::size_t real_size() const { return static_cast<std::size_t>(nx_) * static_cast<std::size_t>(active_rows_); }
  std::size_t spectrum_size() const { return static_cast<std::size_t>(nx_ / 2 + 1) * static_cast<std::size_t>(ny_); }

  /// real may be overwritten.
  void forward(std::span<double> real, std::span<std::complex<double>> spectrum) const;
  /// spectrum is overwritten.
  void inverse(std::span<std::complex<double>> spectrum, std::span<double> real) const;

  /// The two halves of forward and inverse: along the active rows, each to nx/2+1 complex numbers and back, and along
  /// the columns, in place. What is multiplied row by row may stand between them. All arrays are overwritten and must
  /// begin at cache lines (AlignedVector).
  std::size_t rows_size() const {
    return static_cast<std::size_t>(nx_ / 2 + 1) * static_cast<std::size_t>(active_rows_);
  }
  void forward_rows(std::span<double> real, std::span<std::complex<double>> rows) const;
  void inverse_rows(std::span<std::complex<double>> rows, std::span<double> real) const;
  void forward_columns(std::span<std::complex<double>> spectrum) const;
  void inverse_columns(std::span<std::complex<double>> spectrum) const;

  /// Reads or writes `count` rows of nx numbers from row `first` on: called for parts of the active rows, on any
  /// thread.
  using LoadRows = std::function<void(int first, int count, double* rows)>;
  using StoreRows = std::function<void(int first, int count, const double* rows)>;
  /// A line of the spectrum, of each of the fields: called once for each, on any thread.
  using Line = std::function<void(int line, std::complex<double>* const* values)>;

  /// Lines in which whole spectra pass by: columns (one a kx, of ny numbers), few at a time, so that the whole never
  /// exists; of a single row that row.
  bool lines_are_columns() const { return ny_ > 1; }
  int lines() const { return lines_are_columns() ? nx_ / 2 + 1 : ny_; }
  int line_length() const { return lines_are_columns() ? ny_ : nx_ / 2 + 1; }
  /// Place of a number in an array of all lines.
  std::size_t place(int kx, int ky) const {
    return static_cast<std::size_t>(lines_are_columns() ? kx : ky) * static_cast<std::size_t>(line_length()) +
           static_cast<std::size_t>(lines_are_columns() ? ky : kx);
  }

  /// Fields, at most kMostFields, transformed, changed line by line and transformed back.
  static constexpr std::size_t kMostFields = 2;
  void multiply(std::span<const LoadRows> load, const Line& factor, std::span<const StoreRows> store) const;
  /// The spectrum of a field, line by line.
  void lines_of(const LoadRows& load, const Line& take) const;

 private:
  void multiply_rows(std::span<const LoadRows> load, const Line& factor, std::span<const StoreRows> store) const;
  void multiply_columns(std::span<const LoadRows> load, const Line& factor, std::span<const StoreRows> store) const;
  void rows_forward(const LoadRows& load, std::complex<double>* rows) const;
  void rows_inverse(std::complex<double>* rows, const StoreRows& store) const;

  int nx_, ny_, active_rows_;
  bool large_ = false;
  std::shared_ptr<const FftPlan> plan_;
};

/// How many plans the process keeps, and how many it keeps now. What is in use lives on without being kept.
/// Thread-safe.
inline constexpr std::size_t kMostFftPlans = 256;
std::size_t fft_plans();

/// A size >= n for which transforms are fast: the smallest even number without prime factors above 7, or a power of two
/// if that is at most a fifth larger.
int good_fft_size(int n);

/// A number of rows >= ny for which transforms along columns are fast: columns of 32, 64 or 128 values are one kernel
/// of FFTW each, several times faster than the lengths between them. Rows that are not active cost nothing else.
int fast_columns(int ny);

/// Columns and rows >= n of a box whose convolutions use most of the padded length, and of which there are few, so that
/// plans and coefficients of boxes of nearly the same size are met again.
int roomy_columns(int n);
int roomy_rows(int n);

}  // namespace treadmark::kalker
