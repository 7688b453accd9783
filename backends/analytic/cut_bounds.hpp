// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/analytic/cutter.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::analytic {

/// Conservative height bounds of what a cutter leaves of a base, from those of the base and mean-value bounds of the gap
/// over boxes (rectangle times an interval of heights).
class CutBounds {
 public:
  CutBounds(const Cutter& cutter, const Pose& X_SP, const Rectangle& rectangle_P);
  HeightBounds heights(const HeightBounds& base) const;

 private:
  struct Box {
    bool all_removed = false, none_removed = false;
  };
  Box box(double a, double b) const;
  bool find_bottom(double a, double b, double& bottom) const;

  const Cutter& cutter_;
  const Pose& X_;
  double x_, y_, half_x_, half_y_;
  double tolerance_;
};

}  // namespace treadmark::analytic
