// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/analytic/standard_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/backends/analytic/curve_pieces.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::analytic {

namespace {

constexpr double kThroatPowers[] = {-4.320221063e3,  -1.038384026e3,  -1.065501873e2,  -6.051367875,
                                    -2.054332446e-1, -4.169739389e-3, -4.687195829e-5, -2.252755540e-7};
constexpr double kTreadPowers[] = {0.0,
                                   -3.358537058e-2,
                                   1.565681624e-3,
                                   -2.810427944e-5,
                                   5.844240864e-8,
                                   -1.562379023e-8,
                                   5.309217349e-15,
                                   -5.957839843e-12,
                                   2.646656573e-13};

std::vector<double> listed(std::span<const double> powers) { return {powers.begin(), powers.end()}; }

}  // namespace

std::span<const double> s1002_throat_powers() { return kThroatPowers; }
std::span<const double> s1002_tread_powers() { return kTreadPowers; }

GraphCurve s1002_curve() {
  constexpr double kH = -62.764705882, kG = -49.662510381, kF = -39.764473993, kE = -38.426669071, kD = -35.0,
                   kC = -26.0, kB = 32.15796;
  GraphCurve curve;
  curve.append(circle_mm(-70.0, kH, -49.5, 9.519259302, 20.5, +1, kH));
  curve.append(circle_mm(kH, kG, -55.0, 16.0, 12.0, +1, -55.0));
  curve.append(circle_mm(kG, kF, -58.558326413, 8.834924130, 20.0, +1, kG));
  curve.append(line_mm(kF, kE, -93.576667419, -2.747477419));
  curve.append(circle_mm(kE, kD, -26.210665, 16.446, 13.0, -1, kD));
  curve.append(powers_mm(kD, kC, listed(kThroatPowers)));
  curve.append(powers_mm(kC, kB, listed(kTreadPowers)));
  curve.append(line_mm(kB, 60.0, 1.364323640, -0.066666667));
  return curve;
}

namespace {

/// Half widths where R300 and R80 end; R13 ends at the inclination of the 1:20 side (EN 13674-1).
ArcChain head_of_60(double half_300, double half_80) {
  constexpr double kR300 = 0.300, kR80 = 0.080, kR13 = 0.013, kR3 = 0.003;
  const double a300 = std::asin(half_300 / kR300);
  const double a80 = std::asin(std::sin(a300) + (half_80 - half_300) / kR80);
  const double side = std::atan(20.0);
  const double y13 = half_80 + kR13 * (std::sin(side) - std::sin(a80));
  const double z13 = kR300 * (1.0 - std::cos(a300)) + kR80 * (std::cos(a300) - std::cos(a80)) +
                     kR13 * (std::cos(a80) - std::cos(side));
  // The side meets the lower line of the head, 2.75:1 through 51 mm below the crown; the R3 fillet takes its tangent
  // length.
  const double corner_z = (0.051 - (y13 - z13 / 20.0) / 2.75) / (1.0 + 1.0 / (20.0 * 2.75));
  const double turn = std::numbers::pi - std::atan(1.0 / 2.75) - side;
  const double side_length = (corner_z - z13) / std::sin(side) - kR3 * std::tan(0.5 * turn);

  ArcChain chain;
  chain.start_angle = -side;
  chain.start_y = -(y13 + side_length * std::cos(side));
  chain.start_z = z13 + side_length * std::sin(side);
  chain.segments = {{side_length, 0.0},
                    {kR13 * (side - a80), 1.0 / kR13},
                    {kR80 * (a80 - a300), 1.0 / kR80},
                    {kR300 * 2.0 * a300, 1.0 / kR300},
                    {kR80 * (a80 - a300), 1.0 / kR80},
                    {kR13 * (side - a80), 1.0 / kR13},
                    {side_length, 0.0}};
  return chain;
}

}  // namespace

ArcChain rail_60e1_chain() { return head_of_60(10.228e-3, 26.0265e-3); }

ArcChain rail_uic60_chain() { return head_of_60(10.5e-3, 25.988e-3); }

namespace {

/// z = 0 in the surface frame; u = x, v = y.
class PlaneSurface final : public Surface, public Parametric {
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
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override {
    for (std::size_t i = 0; i < uv.size(); ++i) {
      const Vec3 flat = Vec3::Zero();
      out[i] = {{uv[i].x(), uv[i].y(), 0.0},       Vec3::UnitX(), Vec3::UnitY(), flat, flat, flat,
                facing_ == Facing::up ? -1.0 : 1.0};
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
