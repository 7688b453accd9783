// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/tangential/compliance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "treadmark/core/kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/solvers/kalker/tangential/spectrum_kernel.hpp"

namespace treadmark::kalker {

namespace {

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

double* numbers(std::complex<double>* z) { return reinterpret_cast<double*>(z); }
const double* numbers(const std::complex<double>* z) { return reinterpret_cast<const double*>(z); }
static_assert(sizeof(ComplianceBlock) == 3 * sizeof(double) && offsetof(ComplianceBlock, yy) == 2 * sizeof(double));

}  // namespace

Compliance::Compliance(const ComplianceKey& key, UncoupledTable* known) : key_(key), transform_(key.nx, key.ny) {
  tabulate(known);
  const int px = transform_.padded_nx();
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
    symbol_ = ring_symbol(even, transform_.fft());
  } else {
    for (double Entry::*member : {&Entry::xx, &Entry::xy, &Entry::yx, &Entry::yy})
      spectra_.push_back(
          transform_.in_lines(transform_.kernel_spectrum([&](int dix, int diy) { return at(dix, diy).*member; })));
  }
  inverse_.emplace(key.nx, key.ny, even);
  step_.resize(static_cast<std::size_t>(px) / 2 + 1);
  for (std::size_t k = 0; k < step_.size(); ++k)
    step_[k] = 1.0 - std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k) / px);
  for (const std::complex<double>& step : step_) step_back_.push_back(std::conj(step));
}

void Compliance::tabulate(UncoupledTable* known) {
  const int tx = transform_.padded_nx() / 2 + 1, ty = transform_.padded_ny() / 2 + 1;
  const double g = key_.shear_modulus;
  std::optional<BlockTable> blocks;
  std::optional<UncoupledTable> own_table;
  if (key_.kernel != nullptr)
    blocks.emplace(tx, ty, key_.dx, key_.dy, key_.kernel);
  else
    (known != nullptr ? *known : own_table.emplace(key_.dx, key_.dy, key_.poisson)).grow(tx, ty);
  const UncoupledTable* half_spaces = known != nullptr ? known : own_table ? &*own_table : nullptr;
  const auto entry = [&](int ix, int iy) -> Entry {
    if (blocks) {
      const InfluenceBlock b = blocks->at(ix, iy);
      return {b.xx / g, b.xy / g, b.yx / g, b.yy / g};
    }
    const UncoupledCoefficients& c = half_spaces->at(ix, iy);
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

void Compliance::apply(Transport transport, std::span<const double> px, std::span<const double> py,
                       std::span<double> ux, std::span<double> uy, const RowInclination* rows) {
  if (rows) return apply_turned(*rows, transport, px, py, ux, uy);
  const RealFft2d& fft = transform_.fft();
  const auto length = static_cast<std::size_t>(fft.line_length());
  const SpectrumKernel& kernel = fastest_kernel<SpectrumKernel>();
  const auto multiply_line = [&](int line, std::complex<double>* const* values) {
    const std::size_t begin = static_cast<std::size_t>(line) * length;
    std::complex<double>*x = values[0], *y = values[1];
    // one factor for a column, one for each number of a row
    const std::complex<double>* steps = transport == Transport::forward ? step_.data() : step_back_.data();
    const bool same = fft.lines_are_columns();
    if (!symmetric()) {
      for (std::size_t k = 0; k < length; ++k) {
        const std::complex<double> ux_k = spectra_[0][begin + k] * x[k] + spectra_[1][begin + k] * y[k];
        const std::complex<double> uy_k = spectra_[2][begin + k] * x[k] + spectra_[3][begin + k] * y[k];
        const std::complex<double> step =
            transport == Transport::none ? 1.0 : steps[same ? static_cast<std::size_t>(line) : k];
        x[k] = ux_k * step;
        y[k] = uy_k * step;
      }
      return;
    }
    const double* blocks = &symbol_[begin].xx;
    if (transport == Transport::none) return kernel.plain(length, blocks, numbers(x), numbers(y));
    if (!same) return kernel.turned_each(length, blocks, numbers(x), numbers(y), numbers(steps));
    const std::complex<double> step = steps[static_cast<std::size_t>(line)];
    kernel.turned(length, blocks, numbers(x), numbers(y), step.real(), step.imag());
  };
  const std::array load{rows_of(px, key_.nx, fft.nx()), rows_of(py, key_.nx, fft.nx())};
  const std::array store{rows_to(ux, key_.nx, fft.nx()), rows_to(uy, key_.nx, fft.nx())};
  fft.multiply(load, std::ref(multiply_line), store);
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

}  // namespace

std::vector<ComplianceBlock> ring_symbol(const ComplianceKernel& kernel, const RealFft2d& fft) {
  std::vector<ComplianceBlock> symbol(fft.spectrum_size());
  for (double ComplianceBlock::*member : {&ComplianceBlock::xx, &ComplianceBlock::xy, &ComplianceBlock::yy}) {
    const bool odd = member == &ComplianceBlock::xy;
    const std::vector<double> part = even_symbol(fft, [&](int dix, int diy) {
      return odd && (2 * std::abs(dix) == fft.nx() || 2 * diy == fft.ny()) ? 0.0 : kernel(dix, diy).*member;
    });
    for_each_element(part.size(), [&](std::size_t k) { symbol[k].*member = part[k]; });
  }
  return symbol;
}

InverseCompliance::InverseCompliance(int nx, int ny, const ComplianceKernel& kernel)
    : nx_(nx), fft_(ring_about(nx, ny)) {
  symbol_ = ring_symbol(kernel, fft_);
  const double scale = 1.0 / (static_cast<double>(fft_.nx()) * fft_.ny());
  for (ComplianceBlock& b : symbol_) {
    b = inverse(b);
    b = {scale * scale * b.xx, scale * scale * b.xy, scale * scale * b.yy};
  }
}

void InverseCompliance::apply(std::span<const double> ux, std::span<const double> uy, std::span<double> px,
                              std::span<double> py) {
  const auto length = static_cast<std::size_t>(fft_.line_length());
  const auto multiply_line = [&](int line, std::complex<double>* const* values) {
    fastest_kernel<SpectrumKernel>().plain(length, &symbol_[static_cast<std::size_t>(line) * length].xx,
                                           numbers(values[0]), numbers(values[1]));
  };
  const std::array load{rows_of(ux, nx_, fft_.nx()), rows_of(uy, nx_, fft_.nx())};
  const std::array store{rows_to(px, nx_, fft_.nx()), rows_to(py, nx_, fft_.nx())};
  fft_.multiply(load, std::ref(multiply_line), store);
}

}  // namespace treadmark::kalker
