// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <random>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/displacement/band_kernel.hpp"
#include "treadmark/backends/displacement/base_patch.hpp"
#include "treadmark/backends/displacement/displaced_line.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/tests/backends/displacement/fields.hpp"

namespace treadmark::testing {
namespace {

using displacement::BaseHeights;
using displacement::BasePatch;

constexpr double kR = 0.46;
constexpr double kPi = std::numbers::pi;

/// The base without what lies between two values of its u: misses in the middle of a grid.
class Gap : public Surface {
 public:
  Gap(std::shared_ptr<const Surface> base, double low, double high) : base_(std::move(base)), low_(low), high_(high) {}
  std::string_view backend() const override { return "gap"; }
  Facing facing() const override { return base_->facing(); }
  Box3 bounds() const override { return base_->bounds(); }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  void do_heights(const PlaneGrid& p, const HeightsOut& out) const override {
    std::vector<Vec2> points;
    for (int iy = 0; iy < p.grid.ny; ++iy)
      for (int ix = 0; ix < p.grid.nx; ++ix) points.push_back({p.grid.x(ix), p.grid.y(iy)});
    do_heights_at(p.X_SP, points, out);
  }
  void do_heights_at(const Pose& X, std::span<const Vec2> points, const HeightsOut& out) const override {
    std::vector<double> z(points.size());
    base_->heights_at(X, points, {z, out.dzdx, out.dzdy});
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double x = X.apply({points[i].x(), points[i].y(), z[i]}).x();
      if (x > low_ && x < high_)
        for (const auto array : {std::span<double>(z), out.dzdx, out.dzdy})
          if (!array.empty()) array[i] = std::nan("");
    }
    if (!out.z.empty()) std::copy(z.begin(), z.end(), out.z.begin());
  }
  void do_locate(const Pose&, std::span<const Vec2>, std::span<SurfacePoint>) const override {}
  HeightBounds do_height_bounds(const Pose& X, const Rectangle& r) const override { return base_->height_bounds(X, r); }

  std::shared_ptr<const Surface> base_;
  double low_, high_;
};

/// Grids against the careful search, line by line.
int expect_as_searched(const std::shared_ptr<const Surface>& base, const displacement::OffsetField& field, double most,
                       Body body, const Pose& X, const Grid2& g) {
  const std::shared_ptr<const displacement::OffsetField> shared(&field, [](const auto*) {});
  const auto surface = displacement::make_displaced_surface(base, shared, body, "x");
  const Fields f = evaluate(*surface, X, g);
  std::vector<Vec2> points;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) points.push_back({g.x(ix), g.y(iy)});
  std::vector<double> list(points.size());
  surface->heights_at(X, points, {list, {}, {}});
  const displacement::View view{*base, field, body, X};
  int hits = 0;
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const double searched = displacement::DisplacedLine(view, points[i].x(), points[i].y()).search(most);
    const double steep = 1.0 + f.dzdx[i] * f.dzdx[i] + f.dzdy[i] * f.dzdy[i];
    EXPECT_TRUE(same(f.z[i], searched, 1e-12 * (std::isnan(steep) ? 1.0 : steep)))
        << f.z[i] << " and " << searched << " at " << points[i].transpose();
    EXPECT_TRUE(same(list[i], searched, 1e-12 * (std::isnan(steep) ? 1.0 : steep)))
        << list[i] << " and " << searched << " at " << points[i].transpose();
    hits += !std::isnan(searched);
  }
  return hits;
}

TEST(FastWay, IsTheCarefulWay) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, kR);
  const auto rail = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  // sharp: 0.4 mm deep over 3 mm; the wheel's lies across the seam
  const BumpField dent(0.4e-3, 0.001, 0.004, 3e-3, 3e-3, false), seam(-0.4e-3, kPi, 0.004, 4e-3 / kR, 3e-3, true);
  const BumpField wide(-0.7e-3, kPi, 0.004, 0.06 / kR, 0.05, true);
  int hits = 0;
  for (const auto& [roll, yaw, pitch] : {std::array{0.05, 0.03, 0.02}, {0.0, 0.3, 0.0}, {-0.3, 0.0, 0.1}}) {
    const Grid2 g{-0.0031, -0.0012, 2e-4, 2.1e-4, 34, 45};
    hits += expect_as_searched(rail, dent, 0.4e-3, Body::rail, pose({0.0, 0.002, 0.0}, roll, yaw, pitch), g);
    Pose X;
    X.rotation = rotation_y(kPi) * rotation({roll, yaw, pitch});
    X.origin = Vec3(0.0, 0.002, -kR);
    hits += expect_as_searched(wheel, seam, 0.4e-3, Body::wheel, X, g);
    hits += expect_as_searched(wheel, wide, 0.7e-3, Body::wheel, X, g);
  }
  EXPECT_GT(hits, 1500);
}

TEST(FastWay, IsTheCarefulWayAtHolesOfTheBase) {
  const auto holed = std::make_shared<Gap>(analytic::make_standard_surface({"60E1"}, Body::rail, 0.0), 0.4e-3, 1.1e-3);
  const BumpField dent(0.4e-3, 0.001, 0.004, 0.02, 0.02, false);
  const Grid2 g{-0.0031, -0.0012, 2e-4, 2.1e-4, 34, 25};
  EXPECT_GT(expect_as_searched(holed, dent, 0.4e-3, Body::rail, pose({0.0, 0.002, 0.0}, 0.05, 0.03, 0.02), g), 80);
}

/// Planes so fine and so inclined that a point is moved back over many of their nodes: what the base is like counts
/// where it is moved to, on both sides of a hole.
TEST(FastWay, IsTheCarefulWayWhereItMovesOverManyNodes) {
  const auto rail = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  const auto holed = std::make_shared<Gap>(rail, 0.4e-3, 1.1e-3);
  const BumpField dent(0.4e-3, 0.001, 0.0, 0.02, 0.02, false), bead(-0.4e-3, 0.001, 0.0, 0.02, 0.02, false);
  int hits = 0;
  for (const double step : {8e-6, 2e-5, 5e-5})
    for (const auto& [roll, yaw, pitch] : {std::array{0.0, 0.0, 0.3}, {0.2, 0.1, -0.3}, {-0.3, 0.0, 0.1}})
      for (const auto* field : {&dent, &bead})
        for (const double edge : {0.4e-3, 1.1e-3}) {
          const Grid2 g{-20.3 * step, -12.1 * step, step, 1.05 * step, 41, 25};
          hits += expect_as_searched(holed, *field, 0.4e-3, Body::rail, pose({edge, 0.0, 0.0}, roll, yaw, pitch), g);
        }
  EXPECT_GT(hits, 1000);
}

TEST(FastWay, InterpolatesTheBaseOnlyWhereItIsAsGoodAsAsking) {
  const auto rail = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, kR);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-0.8, 0.8);
  long good = 0, all = 0;
  for (const bool is_wheel : {true, false})
    for (const Pose& X : is_wheel ? wheel_planes(kR) : rail_planes())
      for (const double step : {0.1e-3, 0.2e-3, 1e-3}) {
        const Grid2 g{-0.5 * 40 * step, -0.5 * 60 * step, step, 1.1 * step, 40, 60};
        const Surface& base = is_wheel ? *wheel : *rail;
        std::vector<double> z(g.size());
        const BaseHeights heights(base, {X, g}, {z, {}, {}});
        BasePatch patch(heights, g, true);
        ASSERT_TRUE(patch.look(0, g.nx, 0, g.ny));
        double sx[64], sy[64], h[64], hx[64], hy[64];
        bool known[64];
        for (int iy = 0; iy < g.ny; ++iy) {
          std::vector<Vec2> points;
          for (int ix = 0; ix < g.nx; ++ix) {
            sx[ix] = unit(random), sy[ix] = unit(random);
            points.push_back({g.x(ix) + sx[ix] * g.dx, g.y(iy) + sy[ix] * g.dy});
          }
          patch.row(iy, sx, sy, h, hx, hy, known);
          std::vector<double> e(points.size()), ex(points.size()), ey(points.size());
          base.heights_at(X, points, {e, ex, ey});
          for (std::size_t k = 0; k < points.size(); ++k, ++all) {
            if (!known[k]) continue;
            ++good;
            const double steep = 1.0 + ex[k] * ex[k] + ey[k] * ey[k];
            ASSERT_NEAR(h[k], e[k], 1e-12 * steep)
                << points[k].transpose() << " step " << step << " plane from " << X.origin.transpose();
            ASSERT_NEAR(hx[k], ex[k], 3e-8 * steep * steep);
            ASSERT_NEAR(hy[k], ey[k], 3e-8 * steep * steep);
          }
        }
      }
  EXPECT_GT(good, all / 4);
  EXPECT_LT(good, all);
}

TEST(FastWay, BothKernelsAgree) {
  const displacement::BandKernel* fast = avx2_kernel<displacement::BandKernel>();
  if (fast == nullptr) GTEST_SKIP() << "this machine runs one kernel only";
  const displacement::BandKernel& slow = displacement::BandKernel::generic;
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr std::size_t kMany = 61;
  using Row = std::array<double, kMany>;
  const auto some = [&](double size, double middle = 0.0) {
    Row r;
    for (double& v : r) v = middle + size * unit(random);
    return r;
  };
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 R = rotation({unit(random), unit(random), unit(random)});
    for (const bool wheel : {true, false}) {
      displacement::BandAxes axes{wheel, {}, {}, {}};
      for (int k = 0; k < 3; ++k) axes.along[k] = R(0, k), axes.across[k] = R(1, k), axes.up[k] = R(2, k);
      Row theta = some(0.3), s, c;
      for (std::size_t i = 0; i < kMany; ++i) s[i] = std::sin(theta[i]), c[i] = std::cos(theta[i]);
      const Row t = some(0.1), d = some(1e-3), d_u = some(1e-2), d_y = some(0.1), per_r = some(0.1, 2.2), h = some(0.1),
                hx = some(1.0), hy = some(1.0);
      Row out[2][7];
      for (int k = 0; k < 2; ++k) {
        Row* o = out[k];
        const displacement::BandPoints p{t.data(),     d.data(),    d_u.data(),  d_y.data(),  s.data(),    c.data(),
                                         per_r.data(), h.data(),    hx.data(),   hy.data(),   o[0].data(), o[1].data(),
                                         o[2].data(),  o[3].data(), o[4].data(), o[5].data(), o[6].data()};
        const displacement::BandKernel& kernel = k == 0 ? slow : *fast;
        (trial % 2 == 0 ? kernel.solve_moved : kernel.solve_tangent)(axes, kMany, p);
      }
      for (int k = 0; k < 7; ++k)
        for (std::size_t i = 0; i < kMany; ++i)
          ASSERT_NEAR(out[0][k][i], out[1][k][i], 1e-13 * (1.0 + std::fabs(out[0][k][i])));
    }
    std::array<std::array<double, kMany + 4>, 6> z;
    for (auto& row : z)
      for (double& v : row) v = unit(random);
    const double *rows[5], *six[6];
    for (std::size_t k = 0; k < 5; ++k) rows[k] = z[k].data() + 2;
    for (std::size_t k = 0; k < 6; ++k) six[k] = z[k].data();
    const Row sx = some(1.0), sy = some(1.0);
    Row a[4], b[4];
    slow.interpolate(kMany, rows, sx.data(), sy.data(), a[0].data(), a[1].data(), a[2].data());
    fast->interpolate(kMany, rows, sx.data(), sy.data(), b[0].data(), b[1].data(), b[2].data());
    const double *along[5], *across[2] = {z[5].data(), z[4].data()};
    for (std::size_t k = 0; k < 5; ++k) along[k] = z[k].data();
    Row m[3], m_fast[3];
    slow.missing(kMany, along, across, sx.data(), sy.data(), m[0].data(), m[1].data(), m[2].data());
    fast->missing(kMany, along, across, sx.data(), sy.data(), m_fast[0].data(), m_fast[1].data(), m_fast[2].data());
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < kMany; ++i) ASSERT_NEAR(m[k][i], m_fast[k][i], 1e-13) << k;
    z[3][17] = std::nan("");
    slow.fifth(kMany, six, a[3].data());
    fast->fifth(kMany, six, b[3].data());
    EXPECT_EQ(a[3][17], 1e300);
    EXPECT_EQ(b[3][17], 1e300);
    for (int k = 0; k < 4; ++k)
      for (std::size_t i = 0; i < kMany; ++i) ASSERT_NEAR(a[k][i], b[k][i], 1e-13 * (1.0 + 30.0 * (k == 3))) << k;
  }
}

}  // namespace
}  // namespace treadmark::testing
