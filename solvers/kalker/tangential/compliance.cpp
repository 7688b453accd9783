// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/tangential/compliance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"

namespace treadmark::kalker {

namespace {

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

}  // namespace

Compliance::Compliance(const ComplianceKey& key) : key_(key), transform_(key.nx, key.ny) {
  tabulate();
  const int px = transform_.padded_nx(), py = transform_.padded_ny();
  // What is even and odd in both directions: all of a symmetric kernel, and a fair stand-in for others in the
  // preconditioner.
  const ComplianceKernel even = [this](int dix, int diy) -> ComplianceBlock {
    if (symmetric()) {
      const Entry e = at(dix, diy);
      return {e.xx, e.xy, e.yy};
    }
    const Entry a = wide_at(dix, diy), b = wide_at(-dix, diy), c = wide_at(dix, -diy), d = wide_at(-dix, -diy);
    return {0.25 * (a.xx + b.xx + c.xx + d.xx), 0.125 * (a.xy - b.xy - c.xy + d.xy + a.yx - b.yx - c.yx + d.yx),
            0.25 * (a.yy + b.yy + c.yy + d.yy)};
  };
  if (symmetric()) {
    symbol_ = ring_symbol(even, RealFft2d(px, py, key.ny));
  } else {
    for (double Entry::*member : {&Entry::xx, &Entry::xy, &Entry::yx, &Entry::yy})
      spectra_.push_back(transform_.kernel_spectrum([&](int dix, int diy) { return at(dix, diy).*member; }));
  }
  inverse_.emplace(key.nx, key.ny, even);
  step_.resize(static_cast<std::size_t>(px / 2 + 1));
  for (std::size_t k = 0; k < step_.size(); ++k)
    step_[k] = 1.0 - std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k) / px);
  for (const std::complex<double>& step : step_) step_back_.push_back(std::conj(step));
  spectrum_x_.resize(transform_.spectrum_size());
  spectrum_y_.resize(transform_.spectrum_size());
}

void Compliance::tabulate() {
  const int tx = transform_.padded_nx() / 2 + 1, ty = transform_.padded_ny() / 2 + 1;
  const double g = key_.shear_modulus;
  const auto entry = [&](int ix, int iy) -> Entry {
    const double x = ix * key_.dx, y = iy * key_.dy;
    if (key_.kernel != nullptr) {
      const InfluenceBlock b = key_.kernel->at(x, y);
      return {b.xx / g, b.xy / g, b.yx / g, b.yy / g};
    }
    const UncoupledCoefficients c = influence(x, y, key_.dx, key_.dy, key_.poisson);
    return {c.xx / g, c.xy / g, c.xy / g, c.yy / g};
  };
  const int first_x = symmetric() ? 0 : 1 - tx, first_y = symmetric() ? 0 : 1 - ty;
  const auto width = static_cast<std::size_t>(tx - first_x), size = width * static_cast<std::size_t>(ty - first_y);
  const auto entry_of = [&](std::size_t i) {
    return entry(first_x + static_cast<int>(i % width), first_y + static_cast<int>(i / width));
  };
  if (key_.kernel == nullptr) {
    fill_by_blocks(table_, size, entry_of);
  } else {
    for (std::size_t i = 0; i < size; ++i) table_.push_back(entry_of(i));
  }
  Entry& own = table_[static_cast<std::size_t>(-first_y) * width + static_cast<std::size_t>(-first_x)];
  own.xx += key_.layer;
  own.yy += key_.layer;
}

Compliance::Entry Compliance::wide_at(int dix, int diy) const {
  const int tx = transform_.padded_nx() / 2 + 1, ty = transform_.padded_ny() / 2 + 1;
  return table_[product(diy + ty - 1, 2 * tx - 1) + static_cast<std::size_t>(dix + tx - 1)];
}

Compliance::Entry Compliance::at(int dix, int diy) const {
  if (!symmetric()) return wide_at(dix, diy);
  const int tx = transform_.padded_nx() / 2 + 1;
  Entry e = table_[product(std::abs(diy), tx) + static_cast<std::size_t>(std::abs(dix))];
  if ((dix < 0) != (diy < 0)) {
    e.xy = -e.xy;
    e.yx = -e.yx;
  }
  return e;
}

template <class Multiply>
void Compliance::multiply(Transport transport, const Multiply& at) {
  const std::size_t width = step_.size();
  if (transport == Transport::none) {
    for_blocks(spectrum_x_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) at(k, spectrum_x_[k], spectrum_y_[k]);
    });
    return;
  }
  const double sign = transport == Transport::forward ? 1.0 : -1.0;
  const auto multiply_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin * width; row < end * width; row += width)
      for (std::size_t kx = 0; kx < width; ++kx) {
        const std::size_t k = row + kx;
        at(k, spectrum_x_[k], spectrum_y_[k]);
        const double c = step_[kx].real(), s = sign * step_[kx].imag();
        const std::complex<double> sx = spectrum_x_[k], sy = spectrum_y_[k];
        spectrum_x_[k] = {sx.real() * c - sx.imag() * s, sx.real() * s + sx.imag() * c};
        spectrum_y_[k] = {sy.real() * c - sy.imag() * s, sy.real() * s + sy.imag() * c};
      }
  };
  for_blocks(spectrum_x_.size() / width, multiply_rows, width);
}

void Compliance::apply(Transport transport, std::span<const double> px, std::span<const double> py,
                       std::span<double> ux, std::span<double> uy, const RowInclination* rows) {
  if (rows) return apply_turned(*rows, transport, px, py, ux, uy);
  transform_.forward(px, spectrum_x_);
  transform_.forward(py, spectrum_y_);
  if (symmetric()) {
    multiply(transport, [this](std::size_t k, std::complex<double>& x, std::complex<double>& y) {
      const Block& b = symbol_[k];
      const std::complex<double> ux_k = b.xx * x + b.xy * y;
      y = b.xy * x + b.yy * y;
      x = ux_k;
    });
  } else {
    multiply(transport, [this](std::size_t k, std::complex<double>& x, std::complex<double>& y) {
      const std::complex<double> ux_k = spectra_[0][k] * x + spectra_[1][k] * y;
      y = spectra_[2][k] * x + spectra_[3][k] * y;
      x = ux_k;
    });
  }
  transform_.inverse(spectrum_x_, ux);
  transform_.inverse(spectrum_y_, uy);
}

InfluenceBlock Compliance::half_space_at(int dix, int diy) {
  if (!half_space_) half_space_.emplace(key_.nx + 1, key_.ny, key_.dx, key_.dy, key_.kernel);
  InfluenceBlock block = divided(half_space_->at(dix, diy), key_.shear_modulus);
  if (dix == 0 && diy == 0) {
    block.xx += key_.layer;
    block.yy += key_.layer;
  }
  return block;
}

Compliance::Entry Compliance::at(int dix, int loaded_row, int observed_row, const RowInclination& rows) {
  const InfluenceBlock block =
      corrected_for_angle(half_space_at(dix, observed_row - loaded_row),
                          AngleFactors(rows.difference(loaded_row, observed_row)), rows.correction());
  return {block.xx, block.xy, block.yx, block.yy};
}

/// Rolling goes along rows, so that the difference between an element and the one ahead commutes with what is done to
/// rows.
void Compliance::apply_turned(const RowInclination& rows, Transport transport, std::span<const double> px,
                              std::span<const double> py, std::span<double> ux, std::span<double> uy) {
  if (!turned_)
    turned_.emplace(
        transform_, [this](int dix, int diy) { return half_space_at(dix, diy); },
        key_.kernel && key_.kernel->coupled());
  std::span<const std::complex<double>> along_rows;
  if (transport == Transport::forward) along_rows = step_;
  if (transport == Transport::backward) along_rows = step_back_;
  turned_->apply(rows, {.x = px, .y = py, .n = {}}, {.x = ux, .y = uy, .n = {}}, along_rows);
}

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
  const auto width = static_cast<std::size_t>(nx);
  fill_by_blocks(half, half.size(), [&](std::size_t i) -> ComplianceBlock {
    const int ix = static_cast<int>(i % width), iy = static_cast<int>(i / width);
    ComplianceBlock b = kernel(wrapped(ix, nx), iy);
    if (2 * ix == nx || 2 * iy == ny) b.xy = 0.0;
    const double weight = iy == 0 || 2 * iy == ny ? scale : 2.0 * scale;
    return {weight * b.xx, weight * b.xy, weight * b.yy};
  });
  for (double ComplianceBlock::*member : {&ComplianceBlock::xx, &ComplianceBlock::xy, &ComplianceBlock::yy}) {
    clear(std::span(field));
    for (std::size_t i = 0; i < half.size(); ++i) field[i] = half[i].*member;
    fft.forward(field, spectrum);
    for_blocks(symbol.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) symbol[k].*member = spectrum[k].real();
    });
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
  const auto width = static_cast<std::size_t>(fft_.nx()), nx = static_cast<std::size_t>(nx_);
  const auto load_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t iy = begin; iy < end; ++iy) {
      double* row = ring_.data() + iy * width;
      std::copy_n(field.data() + iy * nx, nx, row);
      std::fill(row + nx, row + width, 0.0);
    }
  };
  for_blocks(static_cast<std::size_t>(ny_), load_rows, width);
  fft_.forward(ring_, spectrum);
}

void InverseCompliance::unload(Spectrum& spectrum, std::span<double> field) {
  fft_.inverse(spectrum, ring_);
  const auto width = static_cast<std::size_t>(fft_.nx()), nx = static_cast<std::size_t>(nx_);
  const auto unload_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t iy = begin; iy < end; ++iy) std::copy_n(ring_.data() + iy * width, nx, field.data() + iy * nx);
  };
  for_blocks(static_cast<std::size_t>(ny_), unload_rows, width);
}

void InverseCompliance::apply(std::span<const double> ux, std::span<const double> uy, std::span<double> px,
                              std::span<double> py) {
  load(ux, spectrum_x_);
  load(uy, spectrum_y_);
  for_blocks(symbol_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::complex<double> x = spectrum_x_[k], y = spectrum_y_[k];
      const ComplianceBlock& b = symbol_[k];
      spectrum_x_[k] = b.xx * x + b.xy * y;
      spectrum_y_[k] = b.xy * x + b.yy * y;
    }
  });
  unload(spectrum_x_, px);
  unload(spectrum_y_, py);
}

}  // namespace treadmark::kalker
