// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "treadmark/scans/virtual/draws.hpp"
#include "treadmark/scans/virtual/first_look.hpp"

namespace treadmark::scans::scanner {

/// Elliptic parts of the surface without points.
class Holes {
 public:
  Holes() = default;
  /// Covers a share of the area of the part; the last hole is made to fit.
  /// Errors: Error(configuration) if that takes too many holes of this size.
  Holes(const FirstLook& part, Body body, double share, double size, std::uint64_t seed);

  bool contains(const Vec3& position_S) const;
  std::size_t size() const { return holes_.size(); }

 private:
  struct Hole {
    Vec3 middle = Vec3::Zero(), axis_1 = Vec3::Zero(), axis_2 = Vec3::Zero();  ///< axes divided by their lengths
    Vec3 normal = Vec3::Zero();
    double depth = 0.0;   ///< holds within so much of the tangent plane
    double radius = 0.0;  ///< of the ball round it all

    bool contains(const Vec3& p) const;
  };
  using Cells = std::unordered_map<std::uint64_t, std::vector<std::uint32_t>>;
  Hole draw(const Patch& patch, Body body, double size, double largest_area, Draws& draws) const;
  std::uint64_t cell(const Vec3& p) const;
  std::vector<std::uint64_t> cells(const Hole& hole) const;

  double cell_size_ = 1.0;
  std::vector<Hole> holes_;
  Cells holes_near_;  ///< by cell, all that reach into it
};

}  // namespace treadmark::scans::scanner
