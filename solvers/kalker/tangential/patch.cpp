// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/patch.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

Patch make_patch(const Grid2& grid, Transport transport, const std::vector<ElementState>& state) {
  Patch patch;
  patch.grid = grid;
  patch.transport = transport;
  int x_low = grid.nx, x_high = -1, y_low = grid.ny, y_high = -1;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix)
      if (state[grid.index(ix, iy)] != ElementState::exterior) {
        x_low = std::min(x_low, ix);
        x_high = std::max(x_high, ix);
        y_low = std::min(y_low, iy);
        y_high = std::max(y_high, iy);
      }
  if (x_high < 0) return patch;
  patch.box_x = x_low;
  patch.box_y = y_low;
  patch.box_nx = roomy_columns(x_high - x_low + 2);
  patch.box_ny = y_high == y_low ? 1 : roomy_rows(y_high - y_low + 1);
  const int step = transport == Transport::backward ? 1 : -1;
  for (int iy = y_low; iy <= y_high; ++iy) {
    bool connected = false;
    for (int ix = step < 0 ? x_high : x_low; ix >= x_low && ix <= x_high; ix += step) {
      const bool contact = state[grid.index(ix, iy)] != ElementState::exterior;
      if (contact) {
        patch.ahead.push_back(connected ? patch.size() - 1 : -1);
        patch.column.push_back(ix);
        patch.row.push_back(iy);
        patch.cell.push_back(static_cast<std::size_t>(ix - x_low) +
                             static_cast<std::size_t>(patch.box_nx) * static_cast<std::size_t>(iy - y_low));
      }
      connected = contact;
    }
  }
  return patch;
}

PatchOperator::PatchOperator(const Patch& patch, Compliance& compliance, std::optional<RowInclination> rows)
    : patch_(patch), compliance_(compliance), rows_(std::move(rows)) {
  in_x_.assign(compliance.size(), 0.0);
  in_y_ = out_x_ = out_y_ = inverse_x_ = inverse_y_ = in_x_;
  const Compliance::Entry own = compliance.at(0, 0),
                          ahead = compliance.at(patch.transport == Transport::backward ? -1 : 1, 0);
  diagonal_ = 0.5 * (own.xx + own.yy);
  if (patch.transport != Transport::none) diagonal_ -= 0.5 * (ahead.xx + ahead.yy);
}

void PatchOperator::scatter(std::span<const double> field) {
  const std::size_t n = patch_.cell.size();
  for_blocks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      in_x_[patch_.cell[i]] = field[i];
      in_y_[patch_.cell[i]] = field[n + i];
    }
  });
}

void PatchOperator::gather(std::span<const double> x, std::span<const double> y, std::span<double> field) const {
  const std::size_t n = patch_.cell.size();
  for_blocks(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      field[i] = x[patch_.cell[i]];
      field[n + i] = y[patch_.cell[i]];
    }
  });
}

void PatchOperator::multiply(Transport transport, std::span<const double> p) {
  // The same tractions are asked for again when an iteration ends: bits are compared, so that nothing changes by this.
  if (transport == last_transport_ && p.size() == last_.size() &&
      std::memcmp(p.data(), last_.data(), p.size_bytes()) == 0)
    return;
  scatter(p);
  compliance_.apply(transport, in_x_, in_y_, out_x_, out_y_, rows());
  fill_by_blocks(last_, p.size(), [&](std::size_t k) { return p[k]; });
  last_transport_ = transport;
}

void PatchOperator::apply(Transport transport, std::span<const double> p, std::span<double> s) {
  multiply(transport, p);
  gather(out_x_, out_y_, s);
}

void PatchOperator::displacement_of_box(std::span<const double> p, std::span<double> ux, std::span<double> uy) {
  multiply(Transport::none, p);
  ranges::copy(out_x_, ux.begin());
  ranges::copy(out_y_, uy.begin());
}

void PatchOperator::inverse_displacement(std::span<const double> u, std::span<double> p) {
  scatter(u);
  compliance_.inverse().apply(in_x_, in_y_, inverse_x_, inverse_y_);
  gather(inverse_x_, inverse_y_, p);
}

}  // namespace treadmark::kalker
