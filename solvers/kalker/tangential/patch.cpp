// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/patch.hpp"

#include <algorithm>
#include <utility>

namespace treadmark::kalker {

namespace {

/// Next size whose transforms use all of their length, so that contact areas of nearly the same size share coefficients.
int roomy(int n) { return good_fft_size(2 * n - 1) / 2; }

}  // namespace

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
  patch.box_nx = roomy(x_high - x_low + 2);
  patch.box_ny = y_high == y_low ? 1 : roomy(y_high - y_low + 1);
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
  in_y_ = in_x_;
  out_x_ = in_x_;
  out_y_ = in_x_;
  const Compliance::Entry own = compliance.at(0, 0), ahead = compliance.at(patch.transport == Transport::backward ? -1 : 1, 0);
  diagonal_ = 0.5 * (own.xx + own.yy);
  if (patch.transport != Transport::none) diagonal_ -= 0.5 * (ahead.xx + ahead.yy);
}

void PatchOperator::scatter(std::span<const double> field) {
  const std::size_t n = patch_.cell.size();
  for (std::size_t i = 0; i < n; ++i) {
    in_x_[patch_.cell[i]] = field[i];
    in_y_[patch_.cell[i]] = field[n + i];
  }
}

void PatchOperator::gather(std::span<double> field) const {
  const std::size_t n = patch_.cell.size();
  for (std::size_t i = 0; i < n; ++i) {
    field[i] = out_x_[patch_.cell[i]];
    field[n + i] = out_y_[patch_.cell[i]];
  }
}

void PatchOperator::apply(Transport transport, std::span<const double> p, std::span<double> s) {
  scatter(p);
  compliance_.apply(transport, in_x_, in_y_, out_x_, out_y_, rows());
  gather(s);
}

void PatchOperator::displacement_of_box(std::span<const double> p, std::span<double> ux, std::span<double> uy) {
  scatter(p);
  compliance_.apply(Transport::none, in_x_, in_y_, ux, uy, rows());
}

void PatchOperator::inverse_displacement(std::span<const double> u, std::span<double> p) {
  scatter(u);
  compliance_.inverse().apply(in_x_, in_y_, out_x_, out_y_);
  gather(p);
}

}  // namespace treadmark::kalker
