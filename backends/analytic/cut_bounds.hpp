// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/backends/analytic/cutter.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// Conservative height bounds of what cutters leave of a base, from those of the base and mean-value bounds of the gap
/// over boxes (rectangle times an interval of heights).
class CutBounds {
 public:
  CutBounds(std::span<const Cutter> cutters, const Pose& X_SP, const Rectangle& rectangle_P);
  HeightBounds heights(const HeightBounds& base) const;

 private:
  struct Box {
    bool all_removed = false, none_removed = false;
  };
  Box box(double a, double b) const;
  Box box(const Cutter& cutter, double a, double b) const;
  bool find_bottom(double a, double b, double& bottom) const;

  std::span<const Cutter> cutters_;
  const Pose& X_;
  double x_, y_, half_x_, half_y_;
  double tolerance_;
};

}  // namespace treadmark::analytic
