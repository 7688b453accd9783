// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/cut_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::analytic {

CutBounds::CutBounds(std::span<const Cutter> cutters, const Pose& X_SP, const Rectangle& r)
    : cutters_(cutters),
      X_(X_SP),
      x_(0.5 * (r.x_min + r.x_max)),
      y_(0.5 * (r.y_min + r.y_max)),
      half_x_(0.5 * (r.x_max - r.x_min)),
      half_y_(0.5 * (r.y_max - r.y_min)),
      tolerance_(1e-7 + 0.01 * (half_x_ + half_y_)) {}

CutBounds::Box CutBounds::box(double a, double b) const {
  Box all{false, true};
  for (const Cutter& cutter : cutters_) {
    const Box one = box(cutter, a, b);
    all.all_removed |= one.all_removed;
    all.none_removed &= one.none_removed;
  }
  return all;
}

/// First moved across the rail within the section at the middle, then along it.
CutBounds::Box CutBounds::box(const Cutter& cutter, double a, double b) const {
  const Vec3 p = X_.apply({x_, y_, 0.5 * (a + b)});
  const double half[3] = {half_x_, half_y_, 0.5 * (b - a)};
  Cutter::Hint hint;
  const Cutter::Place at = cutter.place(p, hint);
  double x_half = 0.0, s_half = 0.0, yz_half = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double e_y = X_.rotation(1, k), e_z = X_.rotation(2, k);
    x_half += std::fabs(X_.rotation(0, k)) * half[k];
    s_half += std::fabs(at.cos * e_y + at.sin * e_z) * half[k];
    yz_half += std::hypot(e_y, e_z) * half[k];
  }
  const CutterPath& path = cutter.path();
  const double x_low = p.x() - x_half, x_high = p.x() + x_half;
  const CutterPath::Range y = path.range(CutterPath::kY, x_low, x_high), z = path.range(CutterPath::kZ, x_low, x_high);
  const double reach = std::hypot(at.s, at.q) + yz_half + (std::hypot(y.steepest, z.steepest)) * x_half;
  const double path_rate = path.range(CutterPath::kRoll, x_low, x_high).steepest * reach + std::hypot(y.steepest, z.steepest);
  s_half += path_rate * x_half;

  constexpr double kRounding = 1e-13;
  const double s_low = at.s - s_half - kRounding, s_high = at.s + s_half + kRounding;
  const bool within = x_low >= cutter.x_min() && x_high <= cutter.x_max() && s_low >= cutter.s_min() && s_high <= cutter.s_max();
  Box result;
  if (x_high < cutter.x_min() || x_low > cutter.x_max() || s_high < cutter.s_min() || s_low > cutter.s_max()) {
    result.none_removed = true;
    return result;
  }
  CurveRange h = cutter.section().range(s_low, s_high);
  if (!within) {  // beyond its ends the section goes on level
    h.dh_min = std::min(h.dh_min, 0.0);
    h.dh_max = std::max(h.dh_max, 0.0);
  }
  double change = (1.0 + std::max(std::fabs(h.dh_min), std::fabs(h.dh_max))) * path_rate * x_half + kRounding;
  for (int k = 0; k < 3; ++k) {
    const double e_y = X_.rotation(1, k), e_z = X_.rotation(2, k);
    const double s = at.cos * e_y + at.sin * e_z, q = at.cos * e_z - at.sin * e_y;
    change += std::max(std::fabs(h.dh_min * s - q), std::fabs(h.dh_max * s - q)) * half[k];
  }
  result.all_removed = within && at.gap() - change > 0.0;
  result.none_removed = at.gap() + change <= 0.0;
  return result;
}

bool CutBounds::find_bottom(double a, double b, double& bottom) const {
  if (box(a, b).all_removed) return false;
  if (b - a < tolerance_) {
    bottom = a;
    return true;
  }
  const double m = 0.5 * (a + b);
  return find_bottom(a, m, bottom) || find_bottom(m, b, bottom);
}

HeightBounds CutBounds::heights(const HeightBounds& base) const {
  if (base.empty) return base;
  // Above a height over which nothing is removed, every line has found its way out.
  HeightBounds result = base;
  double inside = base.z_max, step = tolerance_, above = base.z_max;
  constexpr int kDoublings = 60;
  int i = 0;
  while (!box(above, above).none_removed && i++ < kDoublings) {
    inside = above;
    above += step;
    step *= 2.0;
  }
  if (i > kDoublings) above = std::numeric_limits<double>::infinity();
  while (above - inside > tolerance_ && std::isfinite(above)) {
    const double m = 0.5 * (inside + above);
    (box(m, m).none_removed ? above : inside) = m;
  }
  result.z_max = above;
  constexpr double kRounding = 1e-12;
  if (std::isfinite(above) && find_bottom(base.z_min, above + kRounding, result.z_min)) return result;
  result.z_min = base.z_min;
  return result;
}

}  // namespace treadmark::analytic
