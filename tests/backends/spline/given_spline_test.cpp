// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Surfaces given by their splines, against recursions of their own (de Boor 1978), and told again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/spline/given_spline.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/backends/spline/spline_gaps.hpp"
#include "treadmark/backends/spline/thb/thb_fit.hpp"
#include "treadmark/backends/spline/told_spline.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::spline {
namespace {

using ::testing::HasSubstr;
using testing::kRadius;
using treadmark::testing::error_of;

constexpr double kGivenRounding = 1e-14;  // [m] of sums of tens of products of lengths below 1 m
constexpr double kSame = 1e-12;           // [m] heights of one surface by different patches, see nurbs

/// A function of a basis by the recursion of Cox and de Boor.
double b_spline(const std::vector<double>& knots, int degree, std::size_t k, double x) {
  const auto p = static_cast<std::size_t>(degree);
  if (degree == 0) {
    const bool last = x == knots.back() && knots[k + 1] == knots.back() && knots[k] < knots[k + 1];
    return (knots[k] <= x && x < knots[k + 1]) || last ? 1.0 : 0.0;
  }
  double sum = 0.0;
  if (knots[k + p] > knots[k]) sum += (x - knots[k]) / (knots[k + p] - knots[k]) * b_spline(knots, degree - 1, k, x);
  if (knots[k + p + 1] > knots[k + 1])
    sum += (knots[k + p + 1] - x) / (knots[k + p + 1] - knots[k + 1]) * b_spline(knots, degree - 1, k + 1, x);
  return sum;
}

double tensor(const std::array<SplineKnots, 2>& basis, std::size_t i, std::size_t j, double s, double t) {
  return b_spline(basis[0].knots, basis[0].degree, i, s) * b_spline(basis[1].knots, basis[1].degree, j, t);
}

SplineKnots knots(int degree, const std::vector<double>& inner) {
  SplineKnots out{degree, std::vector<double>(static_cast<std::size_t>(degree) + 1, 0.0)};
  out.knots.insert(out.knots.end(), inner.begin(), inner.end());
  out.knots.insert(out.knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  return out;
}

/// Where a function stands.
double greville(const SplineKnots& k, std::size_t function) {
  double sum = 0.0;
  for (int i = 1; i <= k.degree; ++i) sum += k.knots[function + static_cast<std::size_t>(i)];
  return sum / k.degree;
}

/// A rail of 400 x 80 mm with a crown, waves on it.
Vec3 rail_point(double s, double t) {
  const double x = -0.2 + 0.4 * s, y = -0.04 + 0.08 * t;
  return {x, y, 3.0 * y * y + 1e-3 * std::sin(20.0 * x + 30.0 * y)};
}

SplineSurface tensor_rail(int degree_s, int degree_t) {
  SplineSurface out;
  out.name = "Geometry 3";
  out.levels.push_back({knots(degree_s, {0.2, 0.45, 0.5, 0.8}), knots(degree_t, {0.3, 0.6})});
  for (std::size_t j = 0; j < out.levels[0][1].functions(); ++j)
    for (std::size_t i = 0; i < out.levels[0][0].functions(); ++i)
      out.points.push_back(rail_point(greville(out.levels[0][0], i), greville(out.levels[0][1], j)));
  return out;
}

Vec3 by_recursion(const SplineSurface& s, double u, double v) {
  Vec3 sum = Vec3::Zero();
  double weights = 0.0;
  const std::size_t n = s.levels[0][0].functions();
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    const double b = tensor(s.levels[0], k % n, k / n, u, v) * (s.weights.empty() ? 1.0 : s.weights[k]);
    sum += b * s.points[k];
    weights += b;
  }
  return sum / weights;
}

std::vector<Vec2> places() {
  std::vector<Vec2> out;
  for (const double x : {-0.19, -0.1, -0.003, 0.05, 0.13, 0.199})
    for (const double y : {-0.039, -0.02, 0.001, 0.017, 0.0395}) out.emplace_back(x, y);
  return out;
}

/// Heights over the plane z = 0 of a rail; of a wheel over that at its lowest point.
std::vector<double> heights(const Surface& surface, double turned = 0.0) {
  const std::vector<Vec2> at = places();
  std::vector<double> z(at.size());
  HeightsOut out;
  out.z = z;
  surface.heights_at({Vec3::Zero(), rotation_y(turned)}, at, out);
  return z;
}

void expect_same(const Surface& a, const Surface& b, double tolerance, double turned = 0.0) {
  const std::vector<double> za = heights(a, turned), zb = heights(b, turned);
  std::size_t found = 0;
  for (std::size_t k = 0; k < za.size(); ++k) {
    ASSERT_EQ(std::isnan(za[k]), std::isnan(zb[k])) << k;
    if (std::isnan(za[k])) continue;
    ++found;
    EXPECT_NEAR(za[k], zb[k], tolerance) << k;
  }
  EXPECT_GT(found, za.size() / 2);
}

TEST(GivenSpline, ATensorSplineIsThatOfTheRecursion) {
  for (const auto& [ps, pt] : {std::pair{3, 3}, {2, 3}, {3, 1}, {1, 2}, {2, 2}}) {
    SplineSurface s = tensor_rail(ps, pt);
    for (const bool rational : {false, true}) {
      if (rational)
        for (std::size_t k = 0; k < s.points.size(); ++k)
          s.weights.push_back(1.0 + 0.3 * std::sin(static_cast<double>(k)));
      const GivenSpline given(s);
      const NurbsSurface surface(given.net(Body::rail), Body::rail);
      for (double u = 0.0; u <= 1.0; u += 1.0 / 16)
        for (double v = 0.0; v <= 1.0; v += 1.0 / 16) {
          const Vec3 p = by_recursion(s, u, v);
          EXPECT_LT((given.point(u, v) - p).norm(), kGivenRounding) << ps << pt << u << ' ' << v;
          // the same point of the patches
          std::vector<double> z(1);
          HeightsOut out;
          out.z = z;
          if (u == 0.0 || v == 0.0 || u == 1.0 || v == 1.0) continue;  // the very border may be missed
          const std::vector<Vec2> at{Vec2(p.x(), p.y())};
          surface.heights_at({}, at, out);
          EXPECT_NEAR(z[0], p.z(), kSame) << ps << pt << u << ' ' << v;
        }
    }
  }
}

TEST(GivenSpline, HigherDegreesAreMetWithinTenNanometres) {
  for (const auto& [ps, pt] : {std::pair{5, 4}, {4, 2}, {3, 7}})
    for (const bool rational : {false, true})
      for (const bool edge : {false, true}) {
        SplineSurface s = tensor_rail(ps, pt);
        if (edge) {  // a ridge along y = -0.004 and thereabouts
          auto& t = s.levels[0][1];
          t.knots.insert(std::find(t.knots.begin(), t.knots.end(), 0.3), static_cast<std::size_t>(pt) - 1, 0.3);
          s.points.clear();
          for (std::size_t j = 0; j < t.functions(); ++j)
            for (std::size_t i = 0; i < s.levels[0][0].functions(); ++i) {
              const double at = greville(t, j);
              s.points.push_back(rail_point(greville(s.levels[0][0], i), at) + Vec3(0, 0, 0.01 * std::abs(at - 0.3)));
            }
        }
        if (rational)
          for (std::size_t k = 0; k < s.points.size(); ++k)
            s.weights.push_back(1.0 + 0.1 * std::sin(static_cast<double>(k)));
        double off = -1.0;
        const NurbsNet net = GivenSpline(s).net(Body::rail, &off);
        EXPECT_EQ(net.by_corners(), !edge);
        EXPECT_GT(off, 0.0);
        EXPECT_LE(off, kCubicsWithin);
        const NurbsSurface surface(net, Body::rail);
        for (double u = 0.02; u < 1.0; u += 0.031)
          for (double v = 0.02; v < 1.0; v += 0.031) {
            const Vec3 p = by_recursion(s, u, v);
            std::vector<double> z(1);
            HeightsOut out;
            out.z = z;
            surface.heights_at({}, std::vector<Vec2>{Vec2(p.x(), p.y())}, out);
            EXPECT_NEAR(z[0], p.z(), 2.0 * kCubicsWithin) << ps << pt << rational << edge << u << ' ' << v;
          }
      }
}

TEST(GivenSpline, WeightsThatAreAllAlikeAreNone) {
  SplineSurface s = tensor_rail(3, 3);
  const auto plain = make_given_surface(s, Body::rail);
  s.weights.assign(s.points.size(), 3.0);
  EXPECT_TRUE(GivenSpline(s).net(Body::rail).by_corners());
  expect_same(*plain, *make_given_surface(s, Body::rail), kGivenRounding);
}

TEST(GivenSpline, ATubeIsSeenFromItsOuterSide) {
  // an ellipse of four quarters, turned either way
  for (const bool back : {false, true}) {
    SplineSurface s;
    s.levels.push_back({knots(1, {}), SplineKnots{2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}}});
    const Vec2 corners[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    for (std::size_t k = 0; k < 9; ++k)
      for (const double x : {-0.2, 0.2}) {
        const Vec2& c = corners[back ? 8 - k : k];
        s.points.emplace_back(x, 0.04 * c.x(), 0.02 * c.y());
        s.weights.push_back(k % 2 == 1 ? std::sqrt(0.5) : 1.0);
      }
    const auto tube = make_given_surface(s, Body::rail);
    std::vector<SurfacePoint> located(1);
    const std::vector<Vec2> at{Vec2(0.05, 0.01)};
    std::vector<double> z(1);
    HeightsOut out;
    out.z = z;
    tube->heights_at({}, at, out);
    EXPECT_NEAR(z[0], -0.02 * std::sqrt(1.0 - 1.0 / 16.0), 1e-12);
    tube->locate({}, at, located);
    EXPECT_LT(located[0].normal_S.z(), -0.9) << "out of the material";
  }
}

TEST(GivenSpline, AQuarterOfACylinderIsRound) {
  const double half = std::numbers::pi / 4.0, w = std::cos(half);
  SplineSurface s;
  s.name = "shell";
  s.levels.push_back({SplineKnots{2, {0, 0, 0, 1, 1, 1}}, SplineKnots{1, {0, 0, 1, 1}}});
  for (const double y : {-0.05, 0.05})
    for (const int i : {-1, 0, 1}) {
      s.points.emplace_back(kRadius * std::sin(i * half) * (i == 0 ? 1.0 : 1.0), y, i == 0 ? kRadius / w : kRadius * w);
      s.weights.push_back(i == 0 ? w : 1.0);
    }
  const auto wheel = make_given_surface(s, Body::wheel);
  EXPECT_EQ(wheel->backend(), "nurbs");
  const std::vector<Vec2> at = places();
  const std::vector<double> z = heights(*wheel);
  for (std::size_t k = 0; k < at.size(); ++k)
    EXPECT_NEAR(z[k], std::sqrt(kRadius * kRadius - at[k].x() * at[k].x()), kSame);
  // parameters lead back
  std::vector<SurfacePoint> located(1);
  const std::vector<Vec2> one{Vec2(0.1, 0.02)};
  wheel->locate({}, one, located);
  EXPECT_NEAR(located[0].u, std::asin(0.1 / kRadius), 1e-12);
  EXPECT_NEAR(located[0].curvature_1, 1.0 / kRadius, 1e-9);
  EXPECT_GT(located[0].normal_S.z(), 0.9);
}

TEST(GivenSpline, TheWayItsParametersRunDoesNotMatter) {
  const SplineSurface s = tensor_rail(3, 2);
  const auto given = make_given_surface(s, Body::rail);
  const std::size_t ns = s.levels[0][0].functions(), nt = s.levels[0][1].functions();
  const auto reversed = [](SplineKnots k) {
    std::reverse(k.knots.begin(), k.knots.end());
    for (double& x : k.knots) x = 1.0 - x;
    return k;
  };
  for (int kind = 0; kind < 8; ++kind) {
    const bool swapped = (kind & 1) != 0, back_s = (kind & 2) != 0, back_t = (kind & 4) != 0;
    SplineSurface turned = s;
    if (back_s) turned.levels[0][0] = reversed(s.levels[0][0]);
    if (back_t) turned.levels[0][1] = reversed(s.levels[0][1]);
    for (std::size_t j = 0; j < nt; ++j)
      for (std::size_t i = 0; i < ns; ++i)
        turned.points[swapped ? j + nt * i : i + ns * j] =
            s.points[(back_s ? ns - 1 - i : i) + ns * (back_t ? nt - 1 - j : j)];
    if (swapped) std::swap(turned.levels[0][0], turned.levels[0][1]);
    const auto surface = make_given_surface(turned, Body::rail);
    expect_same(*given, *surface, kSame);
    std::vector<SurfacePoint> a(1), b(1);
    const std::vector<Vec2> at{Vec2(0.03, 0.011)};
    given->locate({}, at, a);
    surface->locate({}, at, b);
    EXPECT_NEAR(a[0].u, b[0].u, 1e-12) << kind;
    EXPECT_NEAR(a[0].v, b[0].v, 1e-11) << kind;
    EXPECT_LT((a[0].normal_S - b[0].normal_S).norm(), 1e-9) << kind;
    EXPECT_LT(b[0].normal_S.z(), -0.5) << kind;
  }
}

TEST(GivenSpline, AngularDegreesFallBackToPatchesThatMeet) {
  // a roof: degree 1 across, its ridge in the middle
  SplineSurface s;
  s.levels.push_back({knots(1, {}), knots(1, {0.5})});
  for (const double y : {-0.04, 0.0, 0.04})
    for (const double x : {-0.2, 0.2}) s.points.emplace_back(x, y, 0.2 * std::abs(y));
  const auto roof = make_given_surface(s, Body::rail);
  const std::vector<double> z = heights(*roof);
  const std::vector<Vec2> at = places();
  for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(z[k], 0.2 * std::abs(at[k].y()), kSame);
}

// Hierarchies of two levels: everything known from knot insertion and the recursion.
struct TwoLevels {
  std::array<SplineKnots, 2> coarse, fine;
  std::array<int, 2> lower{}, upper{};  // of the box, in fine intervals

  explicit TwoLevels(int degree)
      : coarse{knots(degree, {0.2, 0.4, 0.6, 0.8}), knots(degree, {0.25, 0.5, 0.75})},
        fine{knots(degree, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}),
             knots(degree, {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875})},
        lower{0, 2},
        upper{8, 8} {}

  bool within(const std::array<SplineKnots, 2>& basis, std::size_t i, std::size_t j) const {
    const std::size_t f[2] = {i, j};
    const double steps[2] = {0.1, 0.125};
    for (std::size_t d = 0; d < 2; ++d) {
      const auto p = static_cast<std::size_t>(basis[d].degree);
      if (basis[d].knots[f[d]] < steps[d] * lower[d] - 1e-9) return false;
      if (basis[d].knots[f[d] + p + 1] > steps[d] * upper[d] + 1e-9) return false;
    }
    return true;
  }
  template <class Use>
  void each(const Use& use) const {  // use(level, i, j)
    for (int l = 0; l < 2; ++l) {
      const auto& basis = l == 0 ? coarse : fine;
      for (std::size_t j = 0; j < basis[1].functions(); ++j)
        for (std::size_t i = 0; i < basis[0].functions(); ++i)
          if (within(basis, i, j) == (l == 1)) use(l, i, j);
    }
  }
  SplineSurface surface() const {
    SplineSurface out;
    out.name = "Geometry 0";
    out.hierarchical = true;
    out.levels = {coarse, fine};
    out.boxes.push_back({1, lower, upper, 0});
    return out;
  }
  /// Coefficient of a fine function of the coarse spline by inserting all knots at once (Cohen, Lyche, Riesenfeld
  /// 1980): discrete B-splines, by their recursion.
  static double discrete(const SplineKnots& c, const SplineKnots& f, int degree, std::size_t k, std::size_t fine_k) {
    const auto p = static_cast<std::size_t>(degree);
    if (degree == 0) return c.knots[k] <= f.knots[fine_k] && f.knots[fine_k] < c.knots[k + 1] ? 1.0 : 0.0;
    const double x = f.knots[fine_k + p];
    double sum = 0.0;
    if (c.knots[k + p] > c.knots[k])
      sum += (x - c.knots[k]) / (c.knots[k + p] - c.knots[k]) * discrete(c, f, degree - 1, k, fine_k);
    if (c.knots[k + p + 1] > c.knots[k + 1])
      sum +=
          (c.knots[k + p + 1] - x) / (c.knots[k + p + 1] - c.knots[k + 1]) * discrete(c, f, degree - 1, k + 1, fine_k);
    return sum;
  }
};

TEST(GivenSpline, AHierarchyIsKnownFromKnotInsertion) {
  for (const int degree : {2, 3}) {
    const TwoLevels two(degree);
    // a coarse spline in the hierarchy: coarse coefficients stay, fine ones are those of inserted knots
    std::vector<Vec3> coarse;
    for (std::size_t j = 0; j < two.coarse[1].functions(); ++j)
      for (std::size_t i = 0; i < two.coarse[0].functions(); ++i)
        coarse.push_back(rail_point(greville(two.coarse[0], i), greville(two.coarse[1], j)));
    SplineSurface s = two.surface();
    std::size_t bump = 0, bump_i = 0, bump_j = 0;
    const std::size_t n = two.coarse[0].functions();
    two.each([&](int level, std::size_t i, std::size_t j) {
      if (level == 0) return s.points.push_back(coarse[i + n * j]);
      Vec3 sum = Vec3::Zero();
      for (std::size_t cj = 0; cj < two.coarse[1].functions(); ++cj)
        for (std::size_t ci = 0; ci < n; ++ci)
          sum += TwoLevels::discrete(two.coarse[0], two.fine[0], degree, ci, i) *
                 TwoLevels::discrete(two.coarse[1], two.fine[1], degree, cj, j) * coarse[ci + n * cj];
      bump = s.points.size(), bump_i = i, bump_j = j;
      s.points.push_back(sum);
    });
    const double height = 0.5e-3;
    s.points[bump].z() += height;
    const GivenSpline given(s);
    EXPECT_EQ(make_given_surface(s, Body::rail)->backend(), degree == 3 ? "thb" : "thb-quadratic");
    for (double u = 0.01; u < 1.0; u += 0.049)
      for (double v = 0.01; v < 1.0; v += 0.049) {
        Vec3 p = Vec3::Zero();
        for (std::size_t k = 0; k < coarse.size(); ++k) p += tensor(two.coarse, k % n, k / n, u, v) * coarse[k];
        p.z() += height * tensor(two.fine, bump_i, bump_j, u, v);
        EXPECT_LT((given.point(u, v) - p).norm(), kGivenRounding) << degree << ' ' << u << ' ' << v;
      }
    // the surface
    const auto rail = make_given_surface(s, Body::rail);
    std::vector<double> z(1);
    HeightsOut out;
    out.z = z;
    const Vec3 p = given.point(0.37, 0.61);
    rail->heights_at({}, std::vector<Vec2>{Vec2(p.x(), p.y())}, out);
    EXPECT_NEAR(z[0], p.z(), kSame);
  }
}

TEST(GivenSpline, AHierarchyThatIsNotTruncatedIsASumOfItsFunctions) {
  const TwoLevels two(3);
  SplineSurface s = two.surface();
  s.truncated = false;
  two.each([&](int level, std::size_t i, std::size_t j) {
    const auto& basis = level == 0 ? two.coarse : two.fine;
    const Vec3 p = rail_point(greville(basis[0], i), greville(basis[1], j));
    s.points.push_back(level == 0 ? p : Vec3(0.2 * p));
  });
  const GivenSpline given(s);
  for (double u = 0.01; u < 1.0; u += 0.049)
    for (double v = 0.01; v < 1.0; v += 0.049) {
      Vec3 p = Vec3::Zero();
      std::size_t k = 0;
      two.each([&](int level, std::size_t i, std::size_t j) {
        p += tensor(level == 0 ? two.coarse : two.fine, i, j, u, v) * s.points[k++];
      });
      EXPECT_LT((given.point(u, v) - p).norm(), kGivenRounding) << u << ' ' << v;
    }
}

sampling::PointGrid grid_of(Body body, bool closed, std::size_t nu, std::size_t ny) {
  sampling::PointGrid out;
  out.body = body;
  out.closed = closed;
  const double length = body == Body::rail ? 0.42 : closed ? 2.0 * std::numbers::pi : 1.2;
  for (std::size_t i = 0; i < nu; ++i)
    out.u.push_back(-0.5 * length + length * static_cast<double>(i) / static_cast<double>(closed ? nu : nu - 1));
  for (std::size_t j = 0; j < ny; ++j)
    out.y.push_back(-0.042 + 0.084 * static_cast<double>(j) / static_cast<double>(ny - 1));
  for (const double u : out.u)
    for (const double y : out.y)
      out.h.push_back(body == Body::rail ? rail_point(u / 0.4 + 0.5, y / 0.08 + 0.5).z()
                                         : kRadius - 2.0 * y * y + 2e-4 * std::sin(5.0 * u) * std::cos(60.0 * y) +
                                               3e-4 * std::exp(-400.0 * (u * u + y * y / (kRadius * kRadius))));
  return out;
}

TEST(ToldSpline, IsTheSameSurfaceAgain) {
  constexpr double kNanometre = 1e-9;
  for (const auto& [body, closed] : {std::pair{Body::rail, false}, {Body::wheel, false}, {Body::wheel, true}}) {
    const sampling::PointGrid points = grid_of(body, closed, closed ? 300 : 60, 30);
    const double turned = body == Body::wheel ? 0.3 : 0.0;
    const SplineSurface nurbs = tell_nurbs(points);
    EXPECT_LT(nurbs.points.size(), (points.u.size() + 4) * (points.y.size() + 3)) << "knots once";
    expect_same(*make_nurbs_surface(points), *make_given_surface(nurbs, body), kNanometre, turned);
    if (closed)  // at the seam
      expect_same(*make_nurbs_surface(points), *make_given_surface(nurbs, body), kNanometre, std::numbers::pi);
    for (const int degree : {2, 3}) {
      std::string note;
      const auto fitted = make_thb_surface(points, degree, note);
      const SplineSurface thb = tell_thb(points, degree, note);
      EXPECT_TRUE(thb.hierarchical);
      const auto again = make_given_surface(thb, body);
      EXPECT_EQ(again->backend(), fitted->backend());
      expect_same(*fitted, *again, kNanometre, turned);
      if (closed) expect_same(*fitted, *again, kNanometre, std::numbers::pi);
    }
  }
}

TEST(ToldSpline, GoesThroughPointsWithKnotsOnce) {
  for (const bool closed : {false, true}) {
    sampling::PointGrid grid;
    grid.body = closed ? Body::wheel : Body::rail;
    grid.closed = closed;
    for (int i = 0; i < 40; ++i)
      grid.u.push_back(closed ? -3.0 + 0.15 * i + 0.02 * std::sin(1.0 * i)
                              : 1e-3 * i + (i > 20 ? 3e-4 * (i - 20) : 0.0));
    for (int j = 0; j < 30; ++j) grid.y.push_back(1e-3 * j + 2e-4 * std::cos(3.0 * j));
    for (const double u : grid.u)
      for (const double y : grid.y) grid.h.push_back((closed ? 0.46 : 0.0) + 1e-3 * std::sin(3.0 * u + 90.0 * y));
    const FittedSpline fitted = fit_tensor_spline(grid);
    const auto& [along, across] = fitted.spline.levels.front();
    EXPECT_EQ(along.functions(), grid.u.size() + (closed ? 3 : 2));
    EXPECT_EQ(across.functions(), grid.y.size() + 2);
    const auto& surface = dynamic_cast<const NurbsSurface&>(*fitted.surface);
    const NurbsNet::Range end = surface.net().range(surface.net().patches_u() - 1, surface.net().patches_v() - 1);
    double most = 0.0;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 50; ++j) {
        const double u = grid.u.front() + (end.u1 - grid.u.front()) * i / 200.0, v = end.v1 * j / 50.0;
        most = std::max(most, (surface.point(u, v) - evaluate(fitted.spline, u, v).p).norm());
      }
    EXPECT_LT(most, kGivenRounding);
  }
}

TEST(ToldSpline, ArcsStayRound) {
  const ArcChain chain{-0.04, 0.0, -0.3, {{0.03, 10.0}, {0.02, 0.0}, {0.03, 10.0}}};
  for (const Body body : {Body::rail, Body::wheel}) {
    const SplineSurface s = tell_nurbs(chain, body, kRadius, -0.2, 0.2);
    EXPECT_FALSE(s.weights.empty());
    expect_same(*make_nurbs_surface(chain, body, kRadius, -0.2, 0.2), *make_given_surface(s, body), 1e-9);
  }
}

std::string refusal(const SplineSurface& s, Body body = Body::rail) {
  return error_of([&] { make_given_surface(s, body); });
}

TEST(GivenSpline, WhatCannotBeASurfaceIsNamed) {
  const SplineSurface good = tensor_rail(3, 3);
  const auto changed = [&](const std::function<void(SplineSurface&)>& change) {
    SplineSurface s = good;
    change(s);
    return refusal(s);
  };
  EXPECT_EQ(refusal(good), "");
  EXPECT_THAT(changed([](auto& s) { s.points.pop_back(); }),
              HasSubstr("Geometry 3: its basis has 8 x 6 functions, but"));
  EXPECT_THAT(changed([](auto& s) { s.weights.assign(s.points.size(), 0.0); }), HasSubstr("not positive"));
  EXPECT_THAT(changed([](auto& s) { s.points[4].x() = NAN; }), HasSubstr("not finite"));
  EXPECT_THAT(changed([](auto& s) { s.levels.clear(); }), HasSubstr("no basis"));
  EXPECT_THAT(changed([](auto& s) { std::swap(s.points[9], s.points[12]); }), HasSubstr("folds back"));
  EXPECT_THAT(changed([](auto& s) {
                for (Vec3& p : s.points) p.y() = 0.0;
              }),
              HasSubstr("edge-on"));
  EXPECT_THAT(changed([](auto& s) {
                for (Vec3& p : s.points) p = Vec3(p.x(), 0.0, p.y());
              }),
              HasSubstr("edge-on"));
  EXPECT_THAT(changed([](auto& s) {
                for (Vec3& p : s.points) p = Vec3(0.001 * p.x(), p.y(), p.x());
              }),
              HasSubstr("along the track"));
  // a loop across, smooth and regular
  SplineSurface loop;
  loop.name = "Geometry 3";
  loop.levels.push_back({knots(1, {}), knots(3, {})});
  for (const Vec2& yz : {Vec2(-0.04, 0.0), Vec2(0.12, -0.06), Vec2(-0.12, -0.06), Vec2(0.04, 0.0)})
    for (const double x : {-0.2, 0.2}) loop.points.emplace_back(x, yz.x(), yz.y());
  EXPECT_THAT(refusal(loop), HasSubstr("Geometry 3: a section crosses itself near y ="));
  EXPECT_THAT(changed([](auto& s) {
                for (Vec3& p : s.points) p *= 50.0;
              }),
              HasSubstr("covers"));
  // hierarchies
  const TwoLevels two(3);
  SplineSurface hierarchy = two.surface();
  two.each([&](int level, std::size_t i, std::size_t j) {
    const auto& basis = level == 0 ? two.coarse : two.fine;
    hierarchy.points.push_back(rail_point(greville(basis[0], i), greville(basis[1], j)));
  });
  EXPECT_EQ(refusal(hierarchy), "");
  const auto with_box = [&](SplineBox box) {
    SplineSurface s = hierarchy;
    s.boxes = {box};
    return refusal(s);
  };
  EXPECT_THAT(with_box({1, {1, 2}, {8, 8}, 12}), HasSubstr("cover 2 of the 4 parts"));
  EXPECT_THAT(with_box({1, {0, 2}, {2, 4}, 12}),
              HasSubstr("level 1 of a hierarchy of splines has 4 cells, but no function"));
  EXPECT_THAT(with_box({1, {0, 2}, {11, 4}, 12}), HasSubstr("does not lie inside"));
  EXPECT_THAT(with_box({2, {0, 2}, {4, 4}, 12}), HasSubstr("of no level"));
  EXPECT_THAT(with_box({1, {0, 0}, {10, 8}, 12}), HasSubstr("functions, but it has"));
  SplineSurface torn = hierarchy;
  torn.levels[1][0].knots[7] = 0.45;
  EXPECT_THAT(refusal(torn), HasSubstr("does not hold the knots"));
  SplineSurface open = hierarchy;
  open.levels[0][0].knots[0] = open.levels[1][0].knots[0] = -0.1;
  EXPECT_THAT(refusal(open), HasSubstr("repeated degree + 1 times"));
}

TEST(GivenSpline, ALoopIsFoundInTheMiddleOfManySections) {
  // a roof along x whose section crosses itself at one of 100 breaks
  SplineSurface s;
  s.name = "Geometry 3";
  s.levels.push_back({SplineKnots{1, {0.0}}, knots(3, {})});
  for (int i = 0; i <= 100; ++i) s.levels[0][0].knots.push_back(0.01 * i);
  s.levels[0][0].knots.push_back(1.0);
  const Vec2 plain[] = {{-0.04, 0.0}, {-0.01, -0.06}, {0.01, -0.06}, {0.04, 0.0}},
             loop[] = {{-0.04, 0.0}, {0.12, -0.06}, {-0.12, -0.06}, {0.04, 0.0}};
  for (const bool looped : {false, true}) {
    s.points.clear();
    for (std::size_t j = 0; j < 4; ++j)
      for (int i = 0; i <= 100; ++i) {
        const Vec2& yz = looped && i == 37 ? loop[j] : plain[j];
        s.points.emplace_back(0.004 * i - 0.2, yz.x(), yz.y());
      }
    EXPECT_THAT(refusal(s), looped ? HasSubstr("a section crosses itself near y =") : HasSubstr(""));
    if (!looped) {
      EXPECT_EQ(refusal(s), "");
    }
  }
}

SplineSurface plate(double x, double z, const std::string& name) {
  SplineSurface s;
  s.name = name;
  s.levels.push_back({knots(1, {}), knots(1, {})});
  for (const double y : {-0.03, 0.03})
    for (const double at : {x, x + 0.1}) s.points.emplace_back(at, y, z);
  return s;
}

TEST(SplineGaps, AreNamed) {
  const auto say = [](double step, bool interface) {
    const std::vector<SplineSurface> s{plate(0.0, 0.0, "Geometry 4"), plate(0.1, step, "Geometry 5")};
    std::vector<SplineInterface> i;
    if (interface) i.push_back({0, 1, 2, 1, {}});
    return spline_gaps(s, i);
  };
  for (const bool interface : {false, true}) {
    EXPECT_EQ(say(0.0, interface), "");
    EXPECT_EQ(say(0.5e-6, interface), "");
    EXPECT_EQ(say(20e-6, interface), "a gap of 20 um between side 2 of Geometry 4 and side 1 of Geometry 5. ");
  }
  // the second one told in another order: its side 4 is met, from the other end
  std::vector<SplineSurface> s{plate(0.0, 0.0, "Geometry 4"), plate(0.1, 0.0, "Geometry 5")};
  const std::vector<Vec3> p = s[1].points;
  s[1].points = {p[3], p[1], p[2], p[0]};
  std::vector<SplineInterface> met;
  EXPECT_EQ(spline_gaps(s, {}, &met), "");
  ASSERT_EQ(met.size(), 1u);
  EXPECT_EQ(met[0].first_side, 2);
  EXPECT_EQ(met[0].second, 1u);
  EXPECT_EQ(met[0].second_side, 4);
  EXPECT_TRUE(met[0].reversed);
  EXPECT_THAT(say(0.2e-3, false), HasSubstr("a gap of 200 um"));
  EXPECT_THAT(error_of([&] { say(0.2e-3, true); }), HasSubstr("are said to meet, but are 200 um apart"));
  EXPECT_THAT(say(5e-3, false), HasSubstr("Geometry 4 meets no other surface"));
}

}  // namespace
}  // namespace treadmark::spline
