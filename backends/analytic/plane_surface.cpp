// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::analytic {

namespace {

/// z = 0 in the surface frame; u = x, v = y.
class PlaneSurface final : public Surface {
 public:
  explicit PlaneSurface(Facing facing) : facing_(facing) {}

  std::string_view backend() const override { return "analytic"; }
  Facing facing() const override { return facing_; }
  Box3 bounds() const override { return {{-kInfinity, -kInfinity, 0.0}, {kInfinity, kInfinity, 0.0}}; }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  /// z(x, y) = c + a x + b y in the plane frame; NaN throughout if the normal lies in the surface.
  struct Height {
    double a, b, c;
    explicit Height(const Pose& X) {
      const double n = X.rotation(2, 2);
      const bool parallel = std::fabs(n) < 1e-12;
      a = parallel ? kNaN : -X.rotation(2, 0) / n;
      b = parallel ? kNaN : -X.rotation(2, 1) / n;
      c = parallel ? kNaN : -X.origin.z() / n;
    }
  };

  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override {
    const Height h(plane_grid.X_SP);
    const Grid2& g = plane_grid.grid;
    if (!out.z.empty())
      for (int iy = 0; iy < g.ny; ++iy)
        for (int ix = 0; ix < g.nx; ++ix) out.z[g.index(ix, iy)] = h.c + h.a * g.x(ix) + h.b * g.y(iy);
    std::fill(out.dzdx.begin(), out.dzdx.end(), h.a);
    std::fill(out.dzdy.begin(), out.dzdy.end(), h.b);
  }
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override {
    const Height h(X_SP);
    for (std::size_t i = 0; i < out.z.size(); ++i) out.z[i] = h.c + h.a * points_P[i].x() + h.b * points_P[i].y();
    std::fill(out.dzdx.begin(), out.dzdx.end(), h.a);
    std::fill(out.dzdy.begin(), out.dzdy.end(), h.b);
  }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override {
    const Height h(X_SP);
    std::fill(out.begin(), out.end(), SurfacePoint{});
    if (std::isnan(h.c)) return;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Vec2& p = points_P[i];
      out[i].status = LocateStatus::converged;
      out[i].position_S = X_SP.apply({p.x(), p.y(), h.c + h.a * p.x() + h.b * p.y()});
      out[i].position_S.z() = 0.0;
      out[i].u = out[i].position_S.x();
      out[i].v = out[i].position_S.y();
      out[i].normal_S = Vec3::UnitZ() * (facing_ == Facing::up ? -1.0 : 1.0);
    }
  }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& r) const override {
    const Height h(X_SP);
    if (std::isnan(h.c)) return {0.0, 0.0, true};
    const double middle = h.c + h.a * 0.5 * (r.x_min + r.x_max) + h.b * 0.5 * (r.y_min + r.y_max);
    const double half = 0.5 * (std::fabs(h.a) * (r.x_max - r.x_min) + std::fabs(h.b) * (r.y_max - r.y_min));
    const double rounding = 1e-14 * (1.0 + std::fabs(middle) + half);
    return {middle - half - rounding, middle + half + rounding, false};
  }

  Facing facing_;
};

}  // namespace

std::shared_ptr<const Surface> make_plane_surface(Facing facing) { return std::make_shared<PlaneSurface>(facing); }

}  // namespace treadmark::analytic
