// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/sheet_field.hpp"

#include <algorithm>
#include <utility>

#include "treadmark/backends/offset/block_cache.hpp"
#include "treadmark/backends/offset/coefficients.hpp"
#include "treadmark/backends/offset/range_pyramid.hpp"

namespace treadmark::offset {

namespace {

/// Integers up to 2^30, rounded down, without a call.
inline int round_down(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i);
}

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

template <int kDegree>
class SheetField final : public displacement::OffsetField {
 public:
  explicit SheetField(std::shared_ptr<const SparseOffsets> offsets)
      : offsets_(std::move(offsets)),
        own_(kDegree == 1 ? SheetGrid{} : spline_coefficients(*offsets_, kDegree, smallest())),
        frame_(offsets_->frame),
        ranges_(grid(), frame_, kDegree) {}

  displacement::OffsetJet jet(double u, double y) const override {
    BlockCache cache(grid());
    const double s = frame_.along(u), t = frame_.across(y);
    displacement::OffsetJet j;
    if (!within(s, t)) return j;
    const Weights<kDegree> a(s), b(t);
    double a2[kDegree + 1], b2[kDegree + 1];
    a.second(s, a2);
    b.second(t, b2);
    for (int i = 0; i <= kDegree; ++i) {
      double row = 0.0, row1 = 0.0, row2 = 0.0;
      for (int k = 0; k <= kDegree; ++k) {
        const double c = cache.value(frame_.wrapped(a.first + i), b.first + k);
        row += b.w[k] * c, row1 += b.w1[k] * c, row2 += b2[k] * c;
      }
      j.value += a.w[i] * row, j.d_u += a.w1[i] * row, j.d_y += a.w[i] * row1;
      j.d_uu += a2[i] * row, j.d_uy += a.w1[i] * row1, j.d_yy += a.w[i] * row2;
    }
    const double per_u = 1.0 / frame_.du, per_y = 1.0 / frame_.dy;
    return {j.value, j.d_u * per_u, j.d_y * per_y, j.d_uu * per_u * per_u, j.d_uy * per_u * per_y, j.d_yy * per_y * per_y};
  }

  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override {
    BlockCache cache(grid());
    const double per_u = 1.0 / frame_.du, per_y = 1.0 / frame_.dy;
    const double low = frame_.branch_begin(), high = low + frame_.period();
    for (std::size_t n = 0; n < u.size(); ++n) {
      double v = 0.0, v_u = 0.0, v_y = 0.0;
      double s = (u[n] - frame_.u0) * per_u;
      if (frame_.body == Body::wheel && !(s >= low && s < high)) s = frame_.along(u[n]);  // another branch
      point(s, (y[n] - frame_.y0) * per_y, cache, v, v_u, v_y);
      value[n] = v;
      if (!d_u.empty()) d_u[n] = v_u * per_u;
      if (!d_y.empty()) d_y[n] = v_y * per_y;
    }
  }

  displacement::OffsetRange range(const Rectangle& uy) const override { return ranges_.range(uy); }

  std::size_t memory_bytes() const override {
    return sizeof(*this) + offsets_->grid.memory_bytes() + (kDegree == 1 ? 0 : own_.memory_bytes()) + ranges_.memory_bytes();
  }

 private:
  static constexpr float kFinest = 1e-13f;  ///< [m]
  float smallest() const { return std::max(kFinest, static_cast<float>(1e-3 * offsets_->tolerance)); }
  const SheetGrid& grid() const { return kDegree == 1 ? offsets_->grid : own_; }
  static bool within(double s, double t) {
    constexpr double kFar = 1 << 30;
    return std::fabs(s) < kFar && std::fabs(t) < kFar;
  }

  void point(double s, double t, BlockCache& cache, double& value, double& d_s, double& d_t) const {
    if (!within(s, t)) return;
    const Weights<kDegree> a(s), b(t);
    const int i = a.first, j = b.first;
    const float* rows[kDegree + 1];
    float gathered[(kDegree + 1) * (kDegree + 1)];
    if (!find_rows(i, j, cache, rows, gathered)) return;
    for (int k = 0; k <= kDegree; ++k) {
      double row = 0.0, row1 = 0.0;
      for (int l = 0; l <= kDegree; ++l) {
        const auto c = static_cast<double>(rows[k][l]);
        row += b.w[l] * c, row1 += b.w1[l] * c;
      }
      value += a.w[k] * row;
      d_s += a.w1[k] * row;
      d_t += a.w[k] * row1;
    }
  }

  /// Where the coefficients (i + k, j ...) lie; those of two blocks side by side are gathered. False: all of them are 0.
  bool find_rows(int i, int j, BlockCache& cache, const float** rows, float* gathered) const {
    static constexpr float kZeros[kDegree + 1] = {};
    const int bj = j >> 6, from = j & 63;
    const bool beside = from + kDegree >= kBlockJ, inside = frame_.turn == 0 || (i >= 0 && i + kDegree < frame_.turn);
    bool any = false;
    for (int k = 0; k <= kDegree; ++k) {
      const int row = inside ? i + k : frame_.wrapped(i + k), offset = (row & 7) << 6;
      const float* left = cache.get(row >> 3, bj);
      any = any || left != nullptr;
      if (!beside) {
        rows[k] = left == nullptr ? kZeros : left + (offset | from);
        continue;
      }
      const float* right = cache.get(row >> 3, bj + 1);
      any = any || right != nullptr;
      rows[k] = gathered;
      for (int l = 0; l <= kDegree; ++l) {
        const float* block = from + l < kBlockJ ? left : right;
        *gathered++ = block == nullptr ? 0.0f : block[offset | ((from + l) & 63)];
      }
    }
    return any;
  }

  std::shared_ptr<const SparseOffsets> offsets_;
  SheetGrid own_;  ///< coefficients; of degree 1 they are the offsets themselves
  SheetFrame frame_;
  RangePyramid ranges_;
};

}  // namespace

std::shared_ptr<const displacement::OffsetField> make_sheet_field(std::shared_ptr<const SparseOffsets> offsets,
                                                                  Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::bilinear: return std::make_shared<SheetField<1>>(std::move(offsets));
    case Interpolation::quadratic: return std::make_shared<SheetField<2>>(std::move(offsets));
    case Interpolation::bicubic: break;
  }
  return std::make_shared<SheetField<3>>(std::move(offsets));
}

}  // namespace treadmark::offset
