// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/compliance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "treadmark/solvers/kalker/halfspace/influence.hpp"

namespace treadmark::kalker {

namespace {

/// Smallest eigenvalue kept in the approximate inverse, relative to the mean of the two.
constexpr double kEigenvalueFloor = 1e-3;

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

/// Index distance on a ring, with the sign of the way that is shorter.
int wrapped(int d, int period) { return 2 * d > period ? d - period : d; }

Compliance::Block inverse(Compliance::Block b) {
  const double mean = 0.5 * (b.xx + b.yy), half = 0.5 * (b.xx - b.yy);
  const double radius = std::hypot(half, b.xy);
  // A truncated kernel may have a symbol that is not quite positive.
  const double floor = kEigenvalueFloor * std::max(std::abs(mean), radius);
  const double low = std::max(mean - radius, floor), high = std::max(mean + radius, floor);
  const double m = 0.5 * (1.0 / low + 1.0 / high);
  const double d = radius > 0.0 ? 0.5 * (1.0 / high - 1.0 / low) / radius : 0.0;
  return {m + d * half, d * b.xy, m - d * half};
}

}  // namespace

Compliance::Compliance(const ComplianceKey& key) : key_(key), transform_(key.nx, key.ny) {
  const int px = transform_.padded_nx(), py = transform_.padded_ny();
  const int tx = px / 2 + 1, ty = py / 2 + 1;
  const double g = key.shear_modulus;
  table_.resize(product(tx, ty));
  for (int iy = 0; iy < ty; ++iy)
    for (int ix = 0; ix < tx; ++ix) {
      const auto coefficient = [&](Component c) {
        return influence(c, ix * key.dx, iy * key.dy, key.dx, key.dy, key.poisson) / g;
      };
      table_[product(iy, tx) + static_cast<std::size_t>(ix)] = {coefficient(Component::xx), coefficient(Component::xy),
                                                                coefficient(Component::yy)};
    }
  table_[0].xx += key.layer;
  table_[0].yy += key.layer;

  // Point-symmetric kernels have real transforms; the odd one must vanish half-way round.
  const RealFft2d fft(px, py);
  AlignedVector<double> field(fft.real_size());
  Spectrum spectrum(fft.spectrum_size());
  symbol_.resize(fft.spectrum_size());
  const double scale = 1.0 / (static_cast<double>(px) * py);
  const auto fill = [&](double Block::*member, bool odd) {
    for (int iy = 0; iy < py; ++iy)
      for (int ix = 0; ix < px; ++ix) {
        const bool seam = odd && (2 * ix == px || 2 * iy == py);
        const int jx = wrapped(ix, px), jy = wrapped(iy, py);
        const double sign = odd && (jx < 0) != (jy < 0) ? -1.0 : 1.0;
        const Block& b = table_[product(std::abs(jy), tx) + static_cast<std::size_t>(std::abs(jx))];
        field[product(iy, px) + static_cast<std::size_t>(ix)] = seam ? 0.0 : sign * scale * b.*member;
      }
    fft.forward(field, spectrum);
    for (std::size_t k = 0; k < symbol_.size(); ++k) symbol_[k].*member = spectrum[k].real();
  };
  fill(&Block::xx, false);
  fill(&Block::xy, true);
  fill(&Block::yy, false);
  inverse_symbol_.resize(symbol_.size());
  for (std::size_t k = 0; k < symbol_.size(); ++k) {
    const Block b = inverse(symbol_[k]);
    const double s = scale * scale;
    inverse_symbol_[k] = {s * b.xx, s * b.xy, s * b.yy};
  }
  step_.resize(static_cast<std::size_t>(px / 2 + 1));
  for (std::size_t k = 0; k < step_.size(); ++k)
    step_[k] = 1.0 - std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k) / px);
  spectrum_x_.resize(fft.spectrum_size());
  spectrum_y_.resize(fft.spectrum_size());
}

Compliance::Block Compliance::at(int dix, int diy) const {
  const int tx = transform_.padded_nx() / 2 + 1;
  Block b = table_[product(std::abs(diy), tx) + static_cast<std::size_t>(std::abs(dix))];
  if ((dix < 0) != (diy < 0)) b.xy = -b.xy;
  return b;
}

void Compliance::apply(Transport transport, std::span<const double> px, std::span<const double> py,
                       std::span<double> ux, std::span<double> uy) {
  transform_product(px, py, ux, uy, symbol_, transport);
}

void Compliance::apply_inverse(std::span<const double> ux, std::span<const double> uy, std::span<double> px,
                               std::span<double> py) {
  transform_product(ux, uy, px, py, inverse_symbol_, Transport::none);
}

void Compliance::transform_product(std::span<const double> ax, std::span<const double> ay, std::span<double> bx,
                                   std::span<double> by, std::span<const Block> symbol, Transport transport) {
  transform_.forward(ax, spectrum_x_);
  transform_.forward(ay, spectrum_y_);
  if (transport == Transport::none) {
    for (std::size_t k = 0; k < symbol.size(); ++k) {
      const std::complex<double> x = spectrum_x_[k], y = spectrum_y_[k];
      const Block& b = symbol[k];
      spectrum_x_[k] = b.xx * x + b.xy * y;
      spectrum_y_[k] = b.xy * x + b.yy * y;
    }
  } else {
    const double sign = transport == Transport::forward ? 1.0 : -1.0;
    for (std::size_t row = 0; row < symbol.size(); row += step_.size())
      for (std::size_t kx = 0; kx < step_.size(); ++kx) {
        const std::size_t k = row + kx;
        const Block& b = symbol[k];
        const double c = step_[kx].real(), s = sign * step_[kx].imag();
        const std::complex<double> x = spectrum_x_[k], y = spectrum_y_[k];
        const std::complex<double> sx = b.xx * x + b.xy * y, sy = b.xy * x + b.yy * y;
        spectrum_x_[k] = {sx.real() * c - sx.imag() * s, sx.real() * s + sx.imag() * c};
        spectrum_y_[k] = {sy.real() * c - sy.imag() * s, sy.real() * s + sy.imag() * c};
      }
  }
  transform_.inverse(spectrum_x_, bx);
  transform_.inverse(spectrum_y_, by);
}

}  // namespace treadmark::kalker
