// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Points sorted into cubes of one size; only cubes that hold points are kept, in the order of their keys.
class Voxels {
 public:
  /// origin, size: any unit. Points more than 2^20 cubes away from the origin are left out, as are those that are not
  /// kept (keep: one flag a point, or empty).
  Voxels(std::span<const Vec3> points, const Vec3& origin, double size, std::span<const std::uint8_t> keep = {});

  double size() const { return size_; }
  std::size_t count() const { return keys_.size(); }
  /// Indices of the points of a cube, ascending.
  std::span<const std::uint32_t> points_of(std::size_t voxel) const {
    return {order_.data() + begin_[voxel], order_.data() + begin_[voxel + 1]};
  }
  /// Calls visit(other) for the cubes that exist among the 27 around and at one.
  template <class Visit>
  void neighbours(std::size_t voxel, const Visit& visit) const {
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy) {
        // three cubes in a row along x have successive keys
        const std::int64_t middle = static_cast<std::int64_t>(keys_[voxel]) + dy * kRow + dz * kLayer;
        for (std::size_t k = first_not_below(static_cast<std::uint64_t>(middle - 1));
             k < keys_.size() && keys_[k] <= static_cast<std::uint64_t>(middle + 1); ++k)
          visit(k);
      }
  }

 private:
  static constexpr std::int64_t kRow = std::int64_t{1} << 21, kLayer = std::int64_t{1} << 42;
  std::size_t first_not_below(std::uint64_t key) const;

  double size_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> begin_, order_;
};

}  // namespace treadmark::scans
