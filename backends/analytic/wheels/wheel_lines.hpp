// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/backends/analytic/wheels/wheel_ray.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// Heights of a wheel over many points of one plane. Four lines at a time go through a kernel, started from what was
/// found before them; those whose result is not proven the outermost hit are left to WheelRay.
class WheelLines {
 public:
  WheelLines(const WheelBody& body, const Pose& X_SP, const HeightsOut& out);

  /// Rows or columns [begin, end) of a grid.
  void march(const Grid2& grid, bool along_x, int begin, int end) const;
  /// Points [begin, end) of a list.
  void follow(std::span<const Vec2> points, std::size_t begin, std::size_t end) const;

 private:
  struct Four;
  /// Casts lanes [0, count) of four, whose origins and guesses are set. found: their bits.
  unsigned cast(Four& four, int count, WheelRay& ray) const;
  void write(std::size_t i, bool found, const Four& four, int k) const;
  Vec2 slopes(const WheelHit& hit) const;

  const WheelBody& body_;
  const Pose& X_;
  const HeightsOut& out_;
  Vec3 n_;
  bool slopes_;
  unsigned (*kernel_)(const WheelLanesInput&, WheelLanesHits&);
};

}  // namespace treadmark::analytic
