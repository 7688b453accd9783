// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <vector>

#include "treadmark/core/platform/bit_cast.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::io::scans {

/// Finds points that are there already, bit by bit. Holds numbers of points only (open addressing); the points lie
/// elsewhere.
class VertexSet {
 public:
  /// Whether the point is not among `points` yet; then its number is points.size(), where the caller has to put it.
  bool insert(const Vec3& point, const std::vector<Vec3>& points) {
    if (10 * (count_ + 1) > 7 * slots_.size()) grow(points);
    std::size_t at = home(point);
    for (; slots_[at] != kFree; at = (at + 1) & (slots_.size() - 1))
      if (same(points[slots_[at]], point)) return false;
    slots_[at] = static_cast<std::uint32_t>(points.size());
    ++count_;
    return true;
  }

  static constexpr std::size_t kMost = 4'000'000'000;

 private:
  static constexpr std::uint32_t kFree = 0xffffffff;

  static bool same(const Vec3& a, const Vec3& b) {
    for (int k = 0; k < 3; ++k)
      if (bit_cast<std::uint64_t>(a[k]) != bit_cast<std::uint64_t>(b[k])) return false;
    return true;
  }

  std::size_t home(const Vec3& point) const {
    std::uint64_t h = 0x9e3779b97f4a7c15;
    for (int k = 0; k < 3; ++k) {
      h = (h ^ bit_cast<std::uint64_t>(point[k])) * 0xff51afd7ed558ccd;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h) & (slots_.size() - 1);
  }

  void grow(const std::vector<Vec3>& points) {
    constexpr std::size_t kFirst = 1024;
    const std::size_t size = slots_.empty() ? kFirst : 2 * slots_.size();
    slots_ = {};  // the points hold all that is needed to build it again
    slots_.assign(size, kFree);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::size_t at = home(points[i]);
      while (slots_[at] != kFree) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<std::uint32_t> slots_;
  std::size_t count_ = 0;
};

}  // namespace treadmark::io::scans
