// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/block_table.hpp"

#include <cstdlib>
#include <string>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

namespace {

std::shared_ptr<const InfluenceKernel> checked(std::shared_ptr<const InfluenceKernel> kernel, double dx, double dy) {
  if (!kernel) throw Error(ErrorKind::configuration, "influence of elements on each other needs a kernel");
  if (!(dx > 0.0 && dy > 0.0))
    throw Error(ErrorKind::configuration, "influence of elements on each other needs positive element sizes");
  return kernel;
}

}  // namespace

BlockTable::BlockTable(int nx, int ny, double dx, double dy, std::shared_ptr<const InfluenceKernel> kernel,
                       double shift_x, double shift_y)
    : nx_(nx),
      ny_(ny),
      dx_(dx),
      dy_(dy),
      shift_x_(shift_x),
      shift_y_(shift_y),
      kernel_(checked(std::move(kernel), dx, dy)),
      fold_x_(kernel_->symmetric() && shift_x == 0.0),
      fold_y_(kernel_->symmetric_in_y() && shift_y == 0.0) {}

void BlockTable::fill() {
  const int first_x = fold_x_ ? 0 : 1 - nx_, first_y = fold_y_ ? 0 : 1 - ny_;
  const auto columns = static_cast<std::size_t>(nx_ - first_x), rows = static_cast<std::size_t>(ny_ - first_y);
  blocks_.resize(columns * rows);
  for (std::size_t r = 0; r < rows; ++r)
    kernel_->row(first_x, dx_, shift_x_, (first_y + static_cast<int>(r)) * dy_ + shift_y_,
                 std::span(blocks_).subspan(r * columns, columns));
}

InfluenceBlock BlockTable::at(int dix, int diy) {
  if (std::abs(dix) >= nx_ || std::abs(diy) >= ny_)
    throw Error(ErrorKind::configuration,
                "no two elements of the box are " + std::to_string(dix) + ", " + std::to_string(diy) + " apart");
  if (blocks_.empty()) fill();
  const int columns = fold_x_ ? nx_ : 2 * nx_ - 1;
  const int column = fold_x_ ? std::abs(dix) : dix + nx_ - 1, row = fold_y_ ? std::abs(diy) : diy + ny_ - 1;
  const auto index =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  return mirrored(blocks_[index], fold_x_ && dix < 0, fold_y_ && diy < 0);
}

}  // namespace treadmark::kalker
