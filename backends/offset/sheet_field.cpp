// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/sheet_field.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/offset/block_directory.hpp"
#include "treadmark/backends/offset/coefficients.hpp"
#include "treadmark/backends/offset/range_pyramid.hpp"
#include "treadmark/backends/offset/sheet_kernel.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/surface_change.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::offset {

namespace {

/// Of numbers up to 2^30 in size, which near_enough has made sure of.
inline int round_down(double x) { return to_whole<int>(std::floor(x)); }

/// Weights of a B-spline of one degree, with derivatives by voxel.
template <int kDegree>
struct Weights {
  int first = 0;  ///< voxel of w[0]
  double w[kDegree + 1], w1[kDegree + 1];

  explicit Weights(double s) {
    if constexpr (kDegree == 1) {
      first = round_down(s);
      const double f = s - first;
      w[0] = 1.0 - f, w[1] = f;
      w1[0] = -1.0, w1[1] = 1.0;
    } else if constexpr (kDegree == 2) {
      const int near = round_down(s + 0.5);
      const double f = s - near, a = 0.5 - f, b = 0.5 + f;
      first = near - 1;
      w[0] = 0.5 * a * a, w[1] = 0.75 - f * f, w[2] = 0.5 * b * b;
      w1[0] = -a, w1[1] = -2.0 * f, w1[2] = b;
    } else {
      const int down = round_down(s);
      const double f = s - down, g = 1.0 - f;
      first = down - 1;
      w[0] = g * g * g / 6.0, w[3] = f * f * f / 6.0;
      w[1] = (4.0 + 3.0 * f * f * (f - 2.0)) / 6.0, w[2] = (4.0 + 3.0 * g * g * (g - 2.0)) / 6.0;
      w1[0] = -0.5 * g * g, w1[1] = f * (1.5 * f - 2.0), w1[2] = g * (2.0 - 1.5 * g), w1[3] = 0.5 * f * f;
    }
  }
  /// Second derivatives, at the same s.
  void second(double s, double* w2) const {
    if constexpr (kDegree == 1) {
      w2[0] = w2[1] = 0.0;
    } else if constexpr (kDegree == 2) {
      w2[0] = w2[2] = 1.0, w2[1] = -2.0;
    } else {
      const double f = s - std::floor(s);
      w2[0] = 1.0 - f, w2[1] = 3.0 * f - 2.0, w2[2] = 1.0 - 3.0 * f, w2[3] = f;
    }
  }
};

bool near_enough(double s, double t) {
  constexpr double kFar = 1 << 30;
  return std::fabs(s) < kFar && std::fabs(t) < kFar;
}

/// As names of parameters have numbers, which know no minus.
std::string in_a_name(int number) { return number < 0 ? 'm' + std::to_string(-number) : std::to_string(number); }

/// Of a B-spline, by voxel.
struct Jet {
  double h = 0.0, dh = 0.0, ddh = 0.0;
};

/// The field that has the coefficient 1 at a voxel and 0 elsewhere.
template <int kDegree>
class VoxelField final : public displacement::OffsetField {
 public:
  VoxelField(const SheetFrame& frame, int i, int j) : frame_(frame), i_(i), j_(j) {}

  displacement::OffsetJet jet(double u, double y) const override {
    const double s = frame_.along(u), t = frame_.across(y);
    if (!near_enough((u - frame_.u0) / frame_.du, t) || !near_enough(s, t)) return {};
    const Weights<kDegree> a(s), b(t);
    double a2[kDegree + 1], b2[kDegree + 1];
    a.second(s, a2);
    b.second(t, b2);
    Jet along, across;
    for (int k = 0; k <= kDegree; ++k) {
      if (frame_.wrapped(a.first + k) == i_) along.h += a.w[k], along.dh += a.w1[k], along.ddh += a2[k];
      if (b.first + k == j_) across = {b.w[k], b.w1[k], b2[k]};
    }
    const double per_u = 1.0 / frame_.du, per_y = 1.0 / frame_.dy;
    return {along.h * across.h,
            along.dh * across.h * per_u,
            along.h * across.dh * per_y,
            along.ddh * across.h * per_u * per_u,
            along.dh * across.dh * per_u * per_y,
            along.h * across.ddh * per_y * per_y};
  }
  displacement::OffsetRange range(const Rectangle& uy) const override {
    constexpr double kReach = 0.5 * (kDegree + 1);
    const double from = frame_.across(uy.y_min), to = frame_.across(uy.y_max);
    if (std::max(from, to) <= j_ - kReach || std::min(from, to) >= j_ + kReach) return {};
    return {0.0, 1.0, 1.0 / std::fabs(frame_.du), 1.0 / std::fabs(frame_.dy)};
  }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  SheetFrame frame_;
  int i_, j_;
};

template <int kDegree>
class SheetField final : public displacement::OffsetField, public std::enable_shared_from_this<SheetField<kDegree>> {
 public:
  explicit SheetField(std::shared_ptr<const SparseOffsets> offsets)
      : offsets_(std::move(offsets)),
        own_(kDegree == 1 || lent() ? SheetGrid{}
                                    : spline_coefficients(*offsets_, kDegree, smallest_coefficient(*offsets_))),
        directory_(grid()),
        frame_(offsets_->frame),
        ranges_(grid(), directory_, frame_, kDegree),
        view_(view()),
        kernel_(fastest_kernel<SheetKernel>().of_degree[kDegree]),
        constant_(alike_all_round()) {}
  SheetField(const SheetField&) = delete;  // the view points into it
  SheetField& operator=(const SheetField&) = delete;

  displacement::OffsetJet jet(double u, double y) const override {
    const double s = frame_.along(u), t = frame_.across(y);
    displacement::OffsetJet j;
    if (!near_enough((u - frame_.u0) / frame_.du, t) || !near_enough(s, t)) return j;  // so many turns say nothing
    const Weights<kDegree> a(s), b(t);
    double a2[kDegree + 1], b2[kDegree + 1];
    a.second(s, a2);
    b.second(t, b2);
    for (int i = 0; i <= kDegree; ++i) {
      double row = 0.0, row1 = 0.0, row2 = 0.0;
      for (int k = 0; k <= kDegree; ++k) {
        const double c = directory_.value(frame_.wrapped(a.first + i), b.first + k);
        row += b.w[k] * c, row1 += b.w1[k] * c, row2 += b2[k] * c;
      }
      j.value += a.w[i] * row, j.d_u += a.w1[i] * row, j.d_y += a.w[i] * row1;
      j.d_uu += a2[i] * row, j.d_uy += a.w1[i] * row1, j.d_yy += a.w[i] * row2;
    }
    const double per_u = 1.0 / frame_.du, per_y = 1.0 / frame_.dy;
    return {
        j.value, j.d_u * per_u, j.d_y * per_y, j.d_uu * per_u * per_u, j.d_uy * per_u * per_y, j.d_yy * per_y * per_y};
  }

  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override {
    kernel_(view_, u.size(), u.data(), y.data(), value.data(), d_u.empty() ? nullptr : d_u.data(),
            d_y.empty() ? nullptr : d_y.data());
  }

  displacement::OffsetRange range(const Rectangle& uy) const override { return ranges_.range(uy); }

  bool constant_along() const override { return constant_; }

  std::vector<ShapeParameter> parameters() const override {
    std::vector<ShapeParameter> all(parameter_count());
    const bool rail = frame_.body == Body::rail;
    const double r = offsets_->nominal_radius, step = step_over(std::min((rail ? 1.0 : r) * frame_.du, frame_.dy));
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto [i, j] = voxel(k);
      const double u = frame_.u0 + i * frame_.du, y = frame_.y0 + j * frame_.dy;
      const Vec3 place = rail ? Vec3(u, y, 0.0) : Vec3(r * std::sin(u), y, r * std::cos(u));
      all[k] = {"node_" + in_a_name(i) + '_' + in_a_name(j), "m", step, place};
    }
    return all;
  }
  std::size_t parameter_count() const override { return blocks().size() * kBlockI * kBlockJ; }
  std::shared_ptr<const OffsetField> changed(std::size_t parameter, double amount) const override {
    const auto [i, j] = voxel(parameter);
    return displacement::with_more(this->shared_from_this(), std::make_shared<VoxelField<kDegree>>(frame_, i, j),
                                   amount);
  }
  double by(std::size_t parameter, double u, double y) const override {
    const auto [i, j] = voxel(parameter);
    return VoxelField<kDegree>(frame_, i, j).jet(u, y).value;
  }
  void pull_back(double u, double y, double weight, std::span<double> sums) const override {
    const double s = frame_.along(u), t = frame_.across(y);
    if (!near_enough((u - frame_.u0) / frame_.du, t) || !near_enough(s, t)) return;
    const Weights<kDegree> a(s), b(t);
    const std::vector<BlockKey>& all = blocks();
    for (int m = 0; m <= kDegree; ++m)
      for (int n = 0; n <= kDegree; ++n) {
        const int i = frame_.wrapped(a.first + m), j = b.first + n;
        const BlockKey key{i >> 3, j >> 6};
        const auto block = ranges::lower_bound(all, key);
        if (block == all.end() || *block != key) continue;
        const auto first = static_cast<std::size_t>(block - all.begin()) * kBlockI * kBlockJ;
        sums[first + static_cast<std::size_t>(((i & 7) << 6) | (j & 63))] += weight * a.w[m] * b.w[n];
      }
  }

  std::size_t memory_bytes() const override {
    return sizeof(*this) + offsets_->grid.memory_bytes() + (kDegree == 1 ? 0 : grid().memory_bytes()) +
           directory_.memory_bytes() + ranges_.memory_bytes();
  }

 private:
  /// Those of the coefficients, in order: listed by the first who asks for parameters.
  const std::vector<BlockKey>& blocks() const {
    std::call_once(listed_, [this] {
      for (const SheetEntry& entry : grid().blocks()) blocks_.push_back(entry.key);
    });
    return blocks_;
  }
  /// Whose coefficient a parameter is.
  std::pair<int, int> voxel(std::size_t parameter) const {
    const BlockKey& block = blocks()[parameter / (kBlockI * kBlockJ)];
    const auto inside = static_cast<int>(parameter % (kBlockI * kBlockJ));
    return {block.bi * kBlockI + inside / kBlockJ, block.bj * kBlockJ + inside % kBlockJ};
  }
  /// Whether the coefficients came with the offsets.
  bool lent() const { return kDegree == 3 && offsets_->cubic; }
  const SheetGrid& grid() const { return kDegree == 1 ? offsets_->grid : lent() ? *offsets_->cubic : own_; }
  /// Whether all columns of a whole turn have the same values.
  bool alike_all_round() const {
    if (frame_.turn == 0) return false;
    std::map<std::int32_t, int> rows;  // of blocks, how many; what is 0 all over a block is not stored
    for (const SheetEntry& entry : offsets_->grid.blocks()) ++rows[entry.key.bj];
    const int all_round = (frame_.turn + kBlockI - 1) / kBlockI;
    for (const auto& [bj, blocks] : rows)
      if (blocks != all_round) return false;
    for (int i = 1; i < frame_.turn; ++i)
      for (const auto& [bj, blocks] : rows) {
        const float *first = offsets_->grid.block({0, bj}), *here = offsets_->grid.block({i >> 3, bj});
        if (first == nullptr || here == nullptr) return false;
        if (!std::equal(first, first + kBlockJ, here + (i & 7) * kBlockJ)) return false;
      }
    return true;
  }

  static const float* find(const void* owner, std::int32_t bi, std::int32_t bj) {
    return static_cast<const BlockDirectory*>(owner)->get(bi, bj);
  }
  SheetView view() const {
    const bool wheel = frame_.body == Body::wheel;
    return {frame_.u0,
            1.0 / frame_.du,
            frame_.y0,
            1.0 / frame_.dy,
            wheel ? frame_.branch_begin() : 0.0,
            wheel ? frame_.period() : 0.0,
            frame_.turn,
            directory_.table(),
            directory_.first().bi,
            directory_.bi_count(),
            directory_.first().bj,
            directory_.bj_count(),
            &find,
            &directory_};
  }

  std::shared_ptr<const SparseOffsets> offsets_;
  SheetGrid own_;  ///< coefficients, unless they are lent; of degree 1 they are the offsets themselves
  BlockDirectory directory_;
  SheetFrame frame_;
  RangePyramid ranges_;
  SheetView view_;
  SheetPoints kernel_;
  bool constant_;
  mutable std::once_flag listed_;
  mutable std::vector<BlockKey> blocks_;  ///< see blocks()
};

}  // namespace

std::shared_ptr<const displacement::OffsetField> make_sheet_field(std::shared_ptr<const SparseOffsets> offsets,
                                                                  Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::bilinear:
      return std::make_shared<SheetField<1>>(std::move(offsets));
    case Interpolation::quadratic:
      return std::make_shared<SheetField<2>>(std::move(offsets));
    case Interpolation::bicubic:
      break;
  }
  return std::make_shared<SheetField<3>>(std::move(offsets));
}

}  // namespace treadmark::offset
