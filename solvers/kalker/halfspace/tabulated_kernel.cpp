// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/tabulated_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::kalker {

namespace {

bool differ(double a, double b) {
  constexpr double kTolerance = 1e-6;
  return !(std::abs(a - b) <= kTolerance * std::abs(b));
}

void check(const NumericalInfluence* table, const InfluenceKernel* outside, double dx, double dy) {
  if (!table || !outside) throw Error(ErrorKind::configuration, "there is no table with coefficients of influence");
  if (table->nx < 1 || table->ny < 1 || table->nx % 2 == 0 || table->ny % 2 == 0 ||
      table->values.size() != static_cast<std::size_t>(table->nx) * static_cast<std::size_t>(table->ny))
    throw Error(ErrorKind::configuration,
                "a table of " + std::to_string(table->values.size()) + " coefficients of influence for " +
                    std::to_string(table->nx) + " x " + std::to_string(table->ny) + " offsets",
                {}, "the numbers of offsets are odd, and each has its coefficients");
  if (differ(table->dx, dx) || differ(table->dy, dy))
    throw Error(ErrorKind::configuration,
                "coefficients of influence for elements of " + std::to_string(table->dx * 1e3) + " mm x " +
                    std::to_string(table->dy * 1e3) + " mm do not fit elements of " + std::to_string(dx * 1e3) +
                    " mm x " + std::to_string(dy * 1e3) + " mm",
                {}, "use the grid that the coefficients were computed for");
  for (const auto& values : table->values)
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
      throw Error(ErrorKind::configuration, "a table of coefficients of influence has entries that are not finite");
}

InfluenceBlock block_of(const std::array<double, 9>& v) {
  return {.xx = v[4], .xy = v[5], .xn = v[3], .yx = v[7], .yy = v[8], .yn = v[6], .nx = v[1], .ny = v[2], .nn = v[0]};
}

std::array<double, 9> values_of(const InfluenceBlock& b) {
  return {b.nn, b.nx, b.ny, b.xn, b.xx, b.xy, b.yn, b.yx, b.yy};
}

InfluenceBlock between(const InfluenceBlock& a, const InfluenceBlock& b, double share) {
  std::array<double, 9> mixed = values_of(a);
  const std::array<double, 9> other = values_of(b);
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] = std::lerp(mixed[i], other[i], share);
  return block_of(mixed);
}

/// The interval of a row of count offsets in which a position lies, and how far; values at the ends may be off by
/// rounding.
struct Interval {
  Interval(double position, int count)
      : inside(position >= -kRounding && position <= count - 1 + kRounding),
        index(std::clamp(to_whole<int>(position, 0.0, static_cast<double>(count)), 0, std::max(count - 2, 0))),
        next(std::min(index + 1, count - 1)),
        share(std::clamp(position - index, 0.0, 1.0)) {}
  static constexpr double kRounding = 1e-6;
  bool inside;
  int index, next;
  double share;
};

bool is_mirror_image(const InfluenceBlock& a, const InfluenceBlock& b, bool in_x, bool in_y) {
  return values_of(a) == values_of(mirrored(b, in_x, in_y));
}

}  // namespace

TabulatedKernel::TabulatedKernel(std::shared_ptr<const NumericalInfluence> table,
                                 std::shared_ptr<const InfluenceKernel> outside, double dx, double dy)
    : nx_((check(table.get(), outside.get(), dx, dy), table->nx)),
      ny_(table->ny),
      dx_(dx),
      dy_(dy),
      outside_(std::move(outside)) {
  blocks_.reserve(table->values.size());
  for (const auto& values : table->values) blocks_.push_back(block_of(values));
  coupled_ = outside_->coupled() || std::any_of(blocks_.begin(), blocks_.end(), [](const InfluenceBlock& b) {
               return b.xn != 0.0 || b.yn != 0.0 || b.nx != 0.0 || b.ny != 0.0;
             });
  symmetric_ = outside_->symmetric();
  const auto block = [&](int ix, int iy) { return blocks_[static_cast<std::size_t>(iy * nx_ + ix)]; };
  for (int iy = 0; iy < ny_ && symmetric_; ++iy)
    for (int ix = 0; ix < nx_ && symmetric_; ++ix) {
      const InfluenceBlock here = block(ix, iy);
      symmetric_ = here.xy == here.yx && is_mirror_image(here, block(nx_ - 1 - ix, iy), true, false) &&
                   is_mirror_image(here, block(ix, ny_ - 1 - iy), false, true);
    }
}

InfluenceBlock TabulatedKernel::at(double X, double Y) const {
  const Interval x(X / dx_ + 0.5 * (nx_ - 1), nx_), y(Y / dy_ + 0.5 * (ny_ - 1), ny_);
  if (!x.inside || !y.inside) return outside_->at(X, Y);
  const auto row = [&](int iy) {
    const auto first = static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_);
    return between(blocks_[first + static_cast<std::size_t>(x.index)],
                   blocks_[first + static_cast<std::size_t>(x.next)], x.share);
  };
  return between(row(y.index), row(y.next), y.share);
}

}  // namespace treadmark::kalker
