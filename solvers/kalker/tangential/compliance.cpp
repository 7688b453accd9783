// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/compliance.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "treadmark/solvers/kalker/halfspace/influence.hpp"

namespace treadmark::kalker {

namespace {

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

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

  const ComplianceKernel kernel = [this](int dix, int diy) { return at(dix, diy); };
  symbol_ = ring_symbol(kernel, RealFft2d(px, py, key.ny));
  inverse_.emplace(key.nx, key.ny, kernel);
  step_.resize(static_cast<std::size_t>(px / 2 + 1));
  for (std::size_t k = 0; k < step_.size(); ++k)
    step_[k] = 1.0 - std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k) / px);
  spectrum_x_.resize(transform_.spectrum_size());
  spectrum_y_.resize(transform_.spectrum_size());
}

Compliance::Block Compliance::at(int dix, int diy) const {
  const int tx = transform_.padded_nx() / 2 + 1;
  Block b = table_[product(std::abs(diy), tx) + static_cast<std::size_t>(std::abs(dix))];
  if ((dix < 0) != (diy < 0)) b.xy = -b.xy;
  return b;
}

void Compliance::apply(Transport transport, std::span<const double> px, std::span<const double> py,
                       std::span<double> ux, std::span<double> uy) {
  transform_.forward(px, spectrum_x_);
  transform_.forward(py, spectrum_y_);
  if (transport == Transport::none) {
    for (std::size_t k = 0; k < symbol_.size(); ++k) {
      const std::complex<double> x = spectrum_x_[k], y = spectrum_y_[k];
      const Block& b = symbol_[k];
      spectrum_x_[k] = b.xx * x + b.xy * y;
      spectrum_y_[k] = b.xy * x + b.yy * y;
    }
  } else {
    const double sign = transport == Transport::forward ? 1.0 : -1.0;
    for (std::size_t row = 0; row < symbol_.size(); row += step_.size())
      for (std::size_t kx = 0; kx < step_.size(); ++kx) {
        const std::size_t k = row + kx;
        const Block& b = symbol_[k];
        const double c = step_[kx].real(), s = sign * step_[kx].imag();
        const std::complex<double> x = spectrum_x_[k], y = spectrum_y_[k];
        const std::complex<double> sx = b.xx * x + b.xy * y, sy = b.xy * x + b.yy * y;
        spectrum_x_[k] = {sx.real() * c - sx.imag() * s, sx.real() * s + sx.imag() * c};
        spectrum_y_[k] = {sy.real() * c - sy.imag() * s, sy.real() * s + sy.imag() * c};
      }
  }
  transform_.inverse(spectrum_x_, ux);
  transform_.inverse(spectrum_y_, uy);
}

}  // namespace treadmark::kalker
