// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/coefficients.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::offset {

namespace {

/// Impulse response of the inverse of the samples (b1, b0, b1) of a B-spline, on [-kSpread, kSpread].
std::vector<double> inverse_filter(int degree) {
  const double b1 = degree == 2 ? 1.0 / 8.0 : 1.0 / 6.0;
  const double z = degree == 2 ? 2.0 * std::sqrt(2.0) - 3.0 : std::sqrt(3.0) - 2.0;
  std::vector<double> h(2 * kSpread + 1);
  for (int k = -kSpread; k <= kSpread; ++k)
    h[static_cast<std::size_t>(k + kSpread)] = -z / (1.0 - z * z) / b1 * std::pow(z, std::abs(k));
  return h;
}

using Wide = std::array<double, kBlockI * kBlockJ>;

/// Blocks that voxels at most kSpread before or behind a block belong to.
std::set<std::int32_t> neighbours(std::int32_t bi, const SheetFrame& frame) {
  std::set<std::int32_t> result;
  for (int i = bi * kBlockI - kSpread; i < (bi + 1) * kBlockI + kSpread; ++i) result.insert(frame.wrapped(i) >> 3);
  return result;
}

/// One strip of blocks with the same bj: filtered along j, then along i.
class Strip {
 public:
  Strip(const SparseOffsets& offsets, std::int32_t bj, const std::vector<double>& h)
      : offsets_(offsets), bj_(bj), h_(h) {}

  void across(std::int32_t bi) {
    const float* from[3];
    for (int k = 0; k < 3; ++k) from[k] = offsets_.grid.block({bi, bj_ + k - 1});
    if (from[0] == nullptr && from[1] == nullptr && from[2] == nullptr) return;
    Wide& to = wide_[bi];
    double row[3 * kBlockJ];
    for (int i = 0; i < kBlockI; ++i) {
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < kBlockJ; ++j) row[k * kBlockJ + j] = from[k] == nullptr ? 0.0 : from[k][i * kBlockJ + j];
      for (int j = 0; j < kBlockJ; ++j) {
        double sum = 0.0;
        for (int m = -kSpread; m <= kSpread; ++m)
          sum += h_[static_cast<std::size_t>(m + kSpread)] * row[kBlockJ + j + m];
        to[static_cast<std::size_t>(i * kBlockJ + j)] = sum;
      }
    }
  }

  std::vector<std::pair<BlockKey, Block>> along() const {
    std::set<std::int32_t> wanted;
    for (const auto& [bi, values] : wide_) wanted.merge(neighbours(bi, offsets_.frame));
    std::vector<std::pair<BlockKey, Block>> result;
    for (const std::int32_t bi : wanted) {
      Block block{};
      for (int i = 0; i < kBlockI; ++i) {
        if (offsets_.frame.turn > 0 && bi * kBlockI + i >= offsets_.frame.turn) continue;
        double sum[kBlockJ] = {};
        for (int m = -kSpread; m <= kSpread; ++m) {
          const int at = offsets_.frame.wrapped(bi * kBlockI + i + m);
          const auto found = wide_.find(at >> 3);
          if (found == wide_.end()) continue;
          const double* from = found->second.data() + (at & 7) * kBlockJ;
          const double weight = h_[static_cast<std::size_t>(m + kSpread)];
          for (int j = 0; j < kBlockJ; ++j) sum[j] += weight * from[j];
        }
        for (int j = 0; j < kBlockJ; ++j) block[static_cast<std::size_t>(i * kBlockJ + j)] = static_cast<float>(sum[j]);
      }
      result.push_back({{bi, bj_}, block});
    }
    return result;
  }

 private:
  const SparseOffsets& offsets_;
  std::int32_t bj_;
  const std::vector<double>& h_;
  std::map<std::int32_t, Wide> wide_;
};

}  // namespace

float smallest_coefficient(const SparseOffsets& offsets) {
  constexpr float kFinest = 1e-13f;  // [m]
  return std::max(kFinest, static_cast<float>(1e-3 * offsets.tolerance));
}

SheetGrid spline_coefficients(const SparseOffsets& offsets, int degree, float smallest) {
  const std::vector<double> h = inverse_filter(degree);
  std::map<std::int32_t, std::set<std::int32_t>> strips;
  for (const SheetGrid::Entry& b : offsets.grid.blocks())
    for (std::int32_t bj = b.key.bj - 1; bj <= b.key.bj + 1; ++bj) strips[bj].insert(b.key.bi);

  const std::vector<std::pair<std::int32_t, std::set<std::int32_t>>> list(strips.begin(), strips.end());
  std::vector<std::vector<std::pair<BlockKey, Block>>> done(list.size());
  parallel_for(list.size(), [&](std::size_t k) {
    Strip strip(offsets, list[k].first, h);
    for (const std::int32_t bi : list[k].second) strip.across(bi);
    done[k] = strip.along();
  });
  SheetGrid result;
  for (auto& strip : done) {
    check_cancelled();
    for (const auto& [key, block] : strip) result.insert(key, block, smallest);
    strip.clear();
    strip.shrink_to_fit();
  }
  return result;
}

}  // namespace treadmark::offset
