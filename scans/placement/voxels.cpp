// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/parallel.hpp"

namespace treadmark::scans {
namespace {

constexpr double kHalf = 1 << 20;
constexpr std::uint64_t kNone = ~std::uint64_t{0};

/// Sorts pairs by key, then index: least significant digits first, 11 bits at a time (Knuth 1998, 5.2.5).
void sort_by_key(std::vector<std::pair<std::uint64_t, std::uint32_t>>& entries) {
  constexpr int kBits = 11, kDigits = 6;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> other(entries.size());
  for (int digit = 0; digit < kDigits; ++digit) {
    const int shift = digit * kBits;
    std::vector<std::size_t> start((std::size_t{1} << kBits) + 1, 0);
    for (const auto& [key, index] : entries) ++start[((key >> shift) & ((1u << kBits) - 1)) + 1];
    if (std::find(start.begin(), start.end(), entries.size()) != start.end()) continue;  // all alike
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    for (const auto& entry : entries) other[start[(entry.first >> shift) & ((1u << kBits) - 1)]++] = entry;
    entries.swap(other);
  }
}

}  // namespace

Voxels::Voxels(std::span<const Vec3> points, const Vec3& origin, double size, std::span<const std::uint8_t> keep)
    : size_(size) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries;
  entries.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!keep.empty() && keep[i] == 0) continue;
    std::uint64_t key = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const double cell = std::floor((points[i][axis] - origin[axis]) / size) + kHalf;
      if (!(cell >= 1.0 && cell < 2.0 * kHalf - 1.0)) {
        key = kNone;
        break;
      }
      key = (key << 21) | static_cast<std::uint64_t>(cell);
    }
    if (key != kNone) entries.emplace_back(key, static_cast<std::uint32_t>(i));
  }
  sort_by_key(entries);
  order_.reserve(entries.size());
  for (const auto& [key, index] : entries) {
    if (keys_.empty() || keys_.back() != key) {
      keys_.push_back(key);
      begin_.push_back(static_cast<std::uint32_t>(order_.size()));
    }
    order_.push_back(index);
  }
  begin_.push_back(static_cast<std::uint32_t>(order_.size()));
}

std::size_t Voxels::first_not_below(std::uint64_t key) const {
  return static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin());
}

}  // namespace treadmark::scans
