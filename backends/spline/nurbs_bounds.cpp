// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs_bounds.hpp"

#include "treadmark/backends/spline/nurbs_view.hpp"

namespace treadmark::spline {
namespace {

constexpr double kSlack = 1e-9;  // [m] borders, rounding
constexpr int kMaxHalvings = 12;

class HeightRange {
 public:
  HeightRange(const Pose& X_SP, const Rectangle& r, Facing facing)
      : half_(X_SP, facing), x_{r.x_min - kSlack, r.x_max + kSlack}, y_{r.y_min - kSlack, r.y_max + kSlack} {}

  void add(const BezierPatch& part, int halvings) {
    const ControlBox box(part);
    if (half_.away(box) || !box.x.overlaps(x_) || !box.y.overlaps(y_)) return;
    if (box.z.low >= range_.low && box.z.high <= range_.high) return;
    double along_u = 0.0, along_v = 0.0;  // lengths of the part
    if (halvings < kMaxHalvings && (box.x.width() > 2.0 * x_.width() + 1e-5 || box.y.width() > 2.0 * y_.width() + 1e-5)) {
      for (int k = 0; k < 4; ++k) {
        along_u = std::max(along_u, (part.point(3, k) - part.point(0, k)).norm());
        along_v = std::max(along_v, (part.point(k, 3) - part.point(k, 0)).norm());
      }
      for (const BezierPatch& half : part.halves(along_u > along_v)) add(half, halvings + 1);
      return;
    }
    range_.include(box.z);
  }
  const Interval& range() const { return range_; }

 private:
  FacingHalf half_;
  Interval x_, y_, range_ = Interval::none();
};

}  // namespace

Interval nurbs_heights_over(const NurbsNet& net, const Pose& X_SP, const Rectangle& r, Facing facing) {
  const Mat3 turn = X_SP.rotation.transpose(), spread = turn.cwiseAbs();
  const Vec3 shift = turn * X_SP.origin;
  if (FacingHalf(X_SP, facing).none) return Interval::none();
  HeightRange heights(X_SP, r, facing);
  net.visit(
      [&](const Vec3& centre, const Vec3& half) {
        const Vec3 c = turn * centre - shift, h = spread * half + Vec3::Constant(kSlack);
        return c.x() - h.x() <= r.x_max && c.x() + h.x() >= r.x_min && c.y() - h.y() <= r.y_max && c.y() + h.y() >= r.y_min;
      },
      [&](int iu, int iv, const Vec3&, const Vec3&) { heights.add(net.patch(iu, iv, X_SP), 0); });
  Interval range = heights.range();
  if (!range.empty()) range = {range.low - 1e-12, range.high + 1e-12};
  return range;
}

}  // namespace treadmark::spline
