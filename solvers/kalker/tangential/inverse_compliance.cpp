// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/inverse_compliance.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::kalker {

namespace {

/// Smallest eigenvalue of a block that is inverted, relative to the largest.
constexpr double kEigenvalueFloor = 1e-3;

std::size_t ring_size(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

/// Index distance on a ring, with the sign of the shorter way.
int wrapped(int d, int period) { return 2 * d > period ? d - period : d; }

ComplianceBlock inverse(const ComplianceBlock& b) {
  const double mean = 0.5 * (b.xx + b.yy), half = 0.5 * (b.xx - b.yy);
  const double radius = std::hypot(half, b.xy);
  // A truncated kernel may have a symbol that is not quite positive.
  const double floor = kEigenvalueFloor * (std::abs(mean) + radius);
  const double low = std::max(mean - radius, floor), high = std::max(mean + radius, floor);
  const double m = 0.5 * (1.0 / low + 1.0 / high);
  const double d = radius > 0.0 ? 0.5 * (1.0 / high - 1.0 / low) / radius : 0.0;
  return {m + d * half, d * b.xy, m - d * half};
}

/// Elements of the ring: hardly more than of the box, because wider rings do not save iterations.
int ring_size(int n) { return good_fft_size(n + 2); }

}  // namespace

std::vector<ComplianceBlock> ring_symbol(const ComplianceKernel& kernel, const RealFft2d& fft) {
  const int nx = fft.nx(), ny = fft.ny();
  const int last = std::min(fft.active_rows() - 1, ny / 2);
  AlignedVector<double> field(fft.real_size());
  Spectrum spectrum(fft.spectrum_size());
  std::vector<ComplianceBlock> half(ring_size(nx, last + 1)), symbol(fft.spectrum_size());
  // One half-plane: the other one has the complex conjugate transform. Rows on the line between them count half.
  const double scale = 1.0 / (static_cast<double>(nx) * ny);
  for (int iy = 0; iy <= last; ++iy)
    for (int ix = 0; ix < nx; ++ix) {
      ComplianceBlock b = kernel(wrapped(ix, nx), iy);
      if (2 * ix == nx || 2 * iy == ny) b.xy = 0.0;
      const double weight = iy == 0 || 2 * iy == ny ? scale : 2.0 * scale;
      half[ring_size(iy, nx) + static_cast<std::size_t>(ix)] = {weight * b.xx, weight * b.xy, weight * b.yy};
    }
  for (double ComplianceBlock::*member : {&ComplianceBlock::xx, &ComplianceBlock::xy, &ComplianceBlock::yy}) {
    std::fill(field.begin(), field.end(), 0.0);
    for (std::size_t i = 0; i < half.size(); ++i) field[i] = half[i].*member;
    fft.forward(field, spectrum);
    for (std::size_t k = 0; k < symbol.size(); ++k) symbol[k].*member = spectrum[k].real();
  }
  return symbol;
}

InverseCompliance::InverseCompliance(int nx, int ny, const ComplianceKernel& kernel)
    : nx_(nx), ny_(ny), fft_(ring_size(nx), ny == 1 ? 1 : ring_size(ny), ny) {
  symbol_ = ring_symbol(kernel, fft_);
  const double scale = 1.0 / (static_cast<double>(fft_.nx()) * fft_.ny());
  for (ComplianceBlock& b : symbol_) {
    b = inverse(b);
    b = {scale * scale * b.xx, scale * scale * b.xy, scale * scale * b.yy};
  }
  ring_.resize(fft_.real_size());
  spectrum_x_.resize(fft_.spectrum_size());
  spectrum_y_.resize(fft_.spectrum_size());
}

void InverseCompliance::load(std::span<const double> field, Spectrum& spectrum) {
  for (int iy = 0; iy < ny_; ++iy) {
    double* row = ring_.data() + ring_size(iy, fft_.nx());
    const double* source = field.data() + ring_size(iy, nx_);
    std::copy(source, source + nx_, row);
    std::fill(row + nx_, row + fft_.nx(), 0.0);
  }
  fft_.forward(ring_, spectrum);
}

void InverseCompliance::unload(Spectrum& spectrum, std::span<double> field) {
  fft_.inverse(spectrum, ring_);
  for (int iy = 0; iy < ny_; ++iy) {
    const double* row = ring_.data() + ring_size(iy, fft_.nx());
    std::copy(row, row + nx_, field.data() + ring_size(iy, nx_));
  }
}

void InverseCompliance::apply(std::span<const double> ux, std::span<const double> uy, std::span<double> px,
                              std::span<double> py) {
  load(ux, spectrum_x_);
  load(uy, spectrum_y_);
  for (std::size_t k = 0; k < symbol_.size(); ++k) {
    const std::complex<double> x = spectrum_x_[k], y = spectrum_y_[k];
    const ComplianceBlock& b = symbol_[k];
    spectrum_x_[k] = b.xx * x + b.xy * y;
    spectrum_y_[k] = b.xy * x + b.yy * y;
  }
  unload(spectrum_x_, px);
  unload(spectrum_y_, py);
}

}  // namespace treadmark::kalker
