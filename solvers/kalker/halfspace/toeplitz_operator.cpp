// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"

#include <algorithm>
#include <numbers>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

namespace {

/// Below this number of elements a direct sum is cheaper than transforms.
constexpr int kDirectSize = 64;

int padded(int n) { return good_fft_size(2 * n - 1); }
int padded_rows(int n) { return n == 1 ? 1 : fast_columns(padded(n)); }

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

void check_size(std::size_t given, std::size_t wanted) {
  if (given != wanted)
    throw Error(ErrorKind::configuration, "a convolution of " + std::to_string(wanted) + " elements was given " +
                                              std::to_string(given) + " values");
}

void check_grid(int nx, int ny) {
  if (nx < 1 || ny < 1) throw Error(ErrorKind::configuration, "a convolution needs at least one element");
}

/// Padded field of the calling thread; kept, because allocation would cost as much as a small transform.
std::span<double> padded_field(std::size_t size) {
  thread_local AlignedVector<double> field;
  if (field.size() < size) field.resize(size);
  return {field.data(), size};
}

std::span<std::complex<double>> spectrum_field(std::size_t size) {
  thread_local Spectrum spectrum;
  if (spectrum.size() < size) spectrum.resize(size);
  return {spectrum.data(), size};
}

}  // namespace

void multiply(std::span<std::complex<double>> spectrum, std::span<const std::complex<double>> factor) {
  check_size(factor.size(), spectrum.size());
  // On plain numbers: operator* of std::complex checks for infinities, and whole complex values are copied slowly.
  double* a = reinterpret_cast<double*>(spectrum.data());
  const double* b = reinterpret_cast<const double*>(factor.data());
  for_blocks(spectrum.size(), [=](std::size_t begin, std::size_t end) {
    double* __restrict to = a;
    const double* __restrict by = b;
    for (std::size_t k = 2 * begin; k < 2 * end; k += 2) {
      const double real = to[k] * by[k] - to[k + 1] * by[k + 1], imaginary = to[k] * by[k + 1] + to[k + 1] * by[k];
      to[k] = real;
      to[k + 1] = imaginary;
    }
  });
}

void add_product(std::span<std::complex<double>> sum, std::span<const std::complex<double>> field,
                 std::span<const std::complex<double>> factor, double weight) {
  check_size(field.size(), sum.size());
  check_size(factor.size(), sum.size());
  double* to = reinterpret_cast<double*>(sum.data());
  const double* of = reinterpret_cast<const double*>(field.data());
  const double* by = reinterpret_cast<const double*>(factor.data());
  for_blocks(sum.size(), [=](std::size_t begin, std::size_t end) {
    double* __restrict s = to;
    const double* __restrict a = of;
    const double* __restrict b = by;
    for (std::size_t k = 2 * begin; k < 2 * end; k += 2) {
      s[k] += weight * (a[k] * b[k] - a[k + 1] * b[k + 1]);
      s[k + 1] += weight * (a[k] * b[k + 1] + a[k + 1] * b[k]);
    }
  });
}

RealFft2d::LoadRows rows_of(std::span<const double> field, int nx, int padded_nx) {
  return [from = field.data(), nx, padded_nx](int first, int count, double* rows) {
    for (int iy = first; iy < first + count; ++iy, rows += padded_nx)
      std::fill(std::copy_n(from + product(iy, nx), nx, rows), rows + padded_nx, 0.0);
  };
}

RealFft2d::StoreRows rows_to(std::span<double> field, int nx, int padded_nx) {
  return [to = field.data(), nx, padded_nx](int first, int count, const double* rows) {
    for (int iy = first; iy < first + count; ++iy, rows += padded_nx) std::copy_n(rows, nx, to + product(iy, nx));
  };
}

RealFft2d ring_about(int nx, int ny) {
  constexpr int kApart = 2;  // elements between the box and its image
  return {good_fft_size(nx + kApart), ny == 1 ? 1 : good_fft_size(ny + kApart), ny};
}

std::vector<double> even_symbol(const RealFft2d& fft, const OffsetKernel& kernel) {
  const int nx = fft.nx(), ny = fft.ny();
  // One half-plane: the other one has the complex conjugate transform. Rows on the line between them count half.
  const double scale = 1.0 / (static_cast<double>(nx) * ny);
  const int last = std::min(fft.active_rows() - 1, ny / 2);
  const auto half_plane = [&](int first, int count, double* rows) {
    for (int iy = first; iy < first + count; ++iy, rows += nx) {
      if (iy > last) {
        std::fill(rows, rows + nx, 0.0);
        continue;
      }
      const double weight = iy == 0 || 2 * iy == ny ? scale : 2.0 * scale;
      for (int ix = 0; ix < nx; ++ix) rows[ix] = weight * kernel(2 * ix > nx ? ix - nx : ix, iy);
    }
  };
  std::vector<double> symbol(fft.spectrum_size());
  const auto length = static_cast<std::size_t>(fft.line_length());
  fft.lines_of(std::ref(half_plane), [&](int line, std::complex<double>* const* values) {
    double* to = symbol.data() + static_cast<std::size_t>(line) * length;
    for (std::size_t k = 0; k < length; ++k) to[k] = values[0][k].real();
  });
  return symbol;
}

void multiply_by_symbol(const RealFft2d& fft, std::span<const double> symbol, int nx, std::span<const double> field,
                        std::span<double> result) {
  const std::size_t size = product(nx, fft.active_rows());
  check_size(field.size(), size);
  check_size(result.size(), size);
  check_size(symbol.size(), fft.spectrum_size());
  const auto length = static_cast<std::size_t>(fft.line_length());
  const auto factor = [=](int line, std::complex<double>* const* values) {
    const double* by = symbol.data() + static_cast<std::size_t>(line) * length;
    double* to = reinterpret_cast<double*>(values[0]);
    for (std::size_t k = 0; k < length; ++k) {
      to[2 * k] *= by[k];
      to[2 * k + 1] *= by[k];
    }
  };
  const RealFft2d::LoadRows load = rows_of(field, nx, fft.nx());
  const RealFft2d::StoreRows store = rows_to(result, nx, fft.nx());
  fft.multiply({&load, 1}, std::ref(factor), {&store, 1});
}

ToeplitzTransform::ToeplitzTransform(int nx, int ny)
    : nx_((check_grid(nx, ny), nx)), ny_(ny), fft_(padded(nx), padded_rows(ny), ny) {}

/// Transform of a field that fills the padded size: the transform of few active rows is used for one band of rows after
/// the other, because making another plan would cost more.
Spectrum ToeplitzTransform::whole_spectrum(std::span<const double> padded) const {
  const int px = padded_nx(), py = padded_ny();
  const auto width = static_cast<std::size_t>(px / 2 + 1);
  Spectrum sum(spectrum_size()), band(spectrum_size());
  AlignedVector<double> rows(fft_.real_size());
  for (int first = 0; first < py; first += ny_) {
    const auto source = padded.begin() + static_cast<std::ptrdiff_t>(product(first, px));
    const std::size_t count = std::min(rows.size(), product(py - first, px));
    std::fill(std::copy(source, source + static_cast<std::ptrdiff_t>(count), rows.begin()), rows.end(), 0.0);
    fft_.forward(rows, band);
    const auto add_rows = [&](std::size_t begin, std::size_t end) {
      for (std::size_t ky = begin; ky < end; ++ky) {
        const std::size_t turns = ky * static_cast<std::size_t>(first) % static_cast<std::size_t>(py);
        const std::complex<double> shift = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(turns) / py);
        for (std::size_t k = ky * width; k < (ky + 1) * width; ++k) sum[k] += shift * band[k];
      }
    };
    for_blocks(static_cast<std::size_t>(py), add_rows, width);
  }
  return sum;
}

Spectrum ToeplitzTransform::kernel_spectrum(const OffsetKernel& kernel) const {
  const int px = padded_nx(), py = padded_ny();
  AlignedVector<double> field(product(px, py));
  const double scale = 1.0 / (static_cast<double>(px) * py);
  for (int diy = 1 - ny_; diy < ny_; ++diy, check_cancelled())
    for (int dix = 1 - nx_; dix < nx_; ++dix)
      field[product((diy + py) % py, px) + static_cast<std::size_t>((dix + px) % px)] = scale * kernel(dix, diy);
  return whole_spectrum(field);
}

Spectrum ToeplitzTransform::in_lines(Spectrum spectrum) const {
  if (!fft_.lines_are_columns()) return spectrum;
  Spectrum lines(spectrum.size());
  const auto width = static_cast<std::size_t>(fft_.lines());
  for (int ky = 0; ky < padded_ny(); ++ky)
    for (int kx = 0; kx < fft_.lines(); ++kx)
      lines[fft_.place(kx, ky)] = spectrum[static_cast<std::size_t>(ky) * width + static_cast<std::size_t>(kx)];
  return lines;
}

void ToeplitzTransform::convolve(std::span<const std::complex<double>> kernel_spectrum, std::span<const double> field,
                                 std::span<double> result) const {
  check_size(kernel_spectrum.size(), spectrum_size());
  const std::span<std::complex<double>> spectrum = spectrum_field(spectrum_size());
  forward(field, spectrum);
  multiply(spectrum, kernel_spectrum);
  inverse(spectrum, result);
}

void ToeplitzTransform::pad(std::span<const double> field, std::span<double> real) const {
  check_size(field.size(), size());
  const auto px = static_cast<std::size_t>(padded_nx()), nx = static_cast<std::size_t>(nx_);
  const auto pad_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t iy = begin; iy < end; ++iy) {
      double* row = real.data() + iy * px;
      std::copy_n(field.data() + iy * nx, nx, row);
      std::fill(row + nx, row + px, 0.0);
    }
  };
  for_blocks(static_cast<std::size_t>(ny_), pad_rows, px);
}

void ToeplitzTransform::crop(std::span<const double> real, std::span<double> field) const {
  check_size(field.size(), size());
  const auto px = static_cast<std::size_t>(padded_nx()), nx = static_cast<std::size_t>(nx_);
  const auto crop_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t iy = begin; iy < end; ++iy) std::copy_n(real.data() + iy * px, nx, field.data() + iy * nx);
  };
  for_blocks(static_cast<std::size_t>(ny_), crop_rows, px);
}

void ToeplitzTransform::forward(std::span<const double> field, std::span<std::complex<double>> spectrum) const {
  const std::span<double> real = padded_field(fft_.real_size());
  pad(field, real);
  fft_.forward(real, spectrum);
}

void ToeplitzTransform::inverse(std::span<std::complex<double>> spectrum, std::span<double> field) const {
  const std::span<double> real = padded_field(fft_.real_size());
  fft_.inverse(spectrum, real);
  crop(real, field);
}

void ToeplitzTransform::forward_rows(std::span<const double> field, std::span<std::complex<double>> rows) const {
  const std::span<double> real = padded_field(fft_.real_size());
  pad(field, real);
  fft_.forward_rows(real, rows);
}

void ToeplitzTransform::inverse_rows(std::span<std::complex<double>> rows, std::span<double> field) const {
  const std::span<double> real = padded_field(fft_.real_size());
  fft_.inverse_rows(rows, real);
  crop(real, field);
}

void ToeplitzTransform::forward_columns(std::span<const std::complex<double>> rows, std::span<const double> factor,
                                        std::span<std::complex<double>> spectrum) const {
  check_size(factor.size(), static_cast<std::size_t>(ny_));
  check_size(rows.size(), rows_size());
  check_size(spectrum.size(), spectrum_size());
  const auto width = static_cast<std::size_t>(padded_nx() / 2 + 1);
  const auto multiply_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t iy = begin, k = begin * width; iy < end; ++iy)
      for (const std::size_t row_end = k + width; k < row_end; ++k) spectrum[k] = factor[iy] * rows[k];
  };
  for_blocks(factor.size(), multiply_rows, width);
  clear(spectrum.subspan(rows.size()));
  fft_.forward_columns(spectrum);
}

void ToeplitzTransform::add_inverse_columns(std::span<std::complex<double>> spectrum, std::span<const double> factor,
                                            std::span<std::complex<double>> rows) const {
  check_size(factor.size(), static_cast<std::size_t>(ny_));
  check_size(rows.size(), rows_size());
  fft_.inverse_columns(spectrum);
  const auto width = static_cast<std::size_t>(padded_nx() / 2 + 1);
  const auto add_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t iy = begin, k = begin * width; iy < end; ++iy)
      for (const std::size_t row_end = k + width; k < row_end; ++k) rows[k] += factor[iy] * spectrum[k];
  };
  for_blocks(factor.size(), add_rows, width);
}

ToeplitzOperator::ToeplitzOperator(int nx, int ny, const OffsetKernel& kernel) : nx_(nx), ny_(ny) {
  check_grid(nx, ny);
  table_.reserve(product(2 * nx - 1, 2 * ny - 1));
  for (int diy = 1 - ny; diy < ny; ++diy, check_cancelled())
    for (int dix = 1 - nx; dix < nx; ++dix) table_.push_back(kernel(dix, diy));
  if (size() <= kDirectSize) return;
  transform_.emplace(nx, ny);
  spectrum_ = transform_->kernel_spectrum([this](int dix, int diy) { return at(dix, diy); });
}

double ToeplitzOperator::at(int dix, int diy) const {
  return table_[product(diy + ny_ - 1, 2 * nx_ - 1) + static_cast<std::size_t>(dix + nx_ - 1)];
}

void ToeplitzOperator::apply(std::span<const double> p, std::span<double> u) const {
  check_size(p.size(), size());
  check_size(u.size(), size());
  if (!transform_) return apply_directly(p, u);
  transform_->convolve(spectrum_, p, u);
}

void ToeplitzOperator::apply_directly(std::span<const double> p, std::span<double> u) const {
  std::fill(u.begin(), u.end(), 0.0);
  for (int jy = 0; jy < ny_; ++jy)
    for (int jx = 0; jx < nx_; ++jx) {
      const double load = p[product(jy, nx_) + static_cast<std::size_t>(jx)];
      if (load == 0.0) continue;
      for (int iy = 0; iy < ny_; ++iy)
        for (int ix = 0; ix < nx_; ++ix)
          u[product(iy, nx_) + static_cast<std::size_t>(ix)] += at(ix - jx, iy - jy) * load;
    }
}

}  // namespace treadmark::kalker
