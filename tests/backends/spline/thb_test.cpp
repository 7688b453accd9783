// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Truncated hierarchical B-splines: the basis, what is exact, fits to points.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/backends/spline/thb/thb_fit.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using sampling::PointGrid;
using testing::kRadius;

// of numbers near 1, after some tens of sums and products
constexpr double kThbRounding = 2e-14;

KnotLine line(int degree, bool closed, const std::vector<double>& breaks) {
  return closed ? KnotLine::periodic(degree, breaks) : KnotLine::open(degree, breaks);
}

/// Unequal intervals; v is halved only where it is long.
ThbSpace space_of(int degree, bool closed, int levels) {
  std::vector<double> u, v;
  for (int i = 0; i <= 7; ++i) u.push_back(i + 0.2 * std::sin(1.0 * i));
  for (int i = 0; i <= 6; ++i) v.push_back(i < 3 ? 0.4 * i : 1.2 + (i - 3));
  std::vector<ThbSpace::Level> all{{line(degree, closed, u), line(degree, false, v)}};
  while (static_cast<int>(all.size()) < levels) {
    const KnotLine &lu = all.back().u, &lv = all.back().v;
    const auto next_u = lu.halved([](int) { return true; });
    const auto next_v = lv.halved([&](int i) { return lv.to(i) - lv.from(i) > 0.3; });
    all.push_back({line(degree, closed, next_u), line(degree, false, next_v)});
  }
  return ThbSpace(std::move(all));
}

void divide_some(ThbSpace& space, int times, unsigned seed) {
  std::mt19937 random(seed);
  for (int k = 0; k < times; ++k) {
    space.settle();
    const auto& cells = space.cells();
    const ThbCell cell = cells[std::uniform_int_distribution<std::size_t>(0, cells.size() - 1)(random)];
    // blocks that have room for functions
    for (int du = 0; du < 3; ++du)
      for (int dv = 0; dv < 3; ++dv) {
        const ThbCell near{cell.level, cell.iu + du, cell.iv + dv};
        if (near.iu < space.u(cell.level).intervals() && near.iv < space.v(cell.level).intervals() &&
            space.exists(near))
          space.divide(near);
      }
  }
  space.settle();
}

struct Case {
  int degree;
  bool closed;
};
class ThbBasis : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Degrees, ThbBasis, ::testing::Values(Case{1, false}, Case{2, false}, Case{3, false}, Case{2, true}, Case{3, true}),
    [](const auto& which) {
      return "degree_" + std::to_string(which.param.degree) + (which.param.closed ? "_closed" : "");
    });

TEST_P(ThbBasis, FunctionsAreNotNegativeAndSumToOne) {
  ThbSpace space = space_of(GetParam().degree, GetParam().closed, 4);
  divide_some(space, 9, 1);
  const auto used = static_cast<std::size_t>(GetParam().degree + 1) * static_cast<std::size_t>(GetParam().degree + 1);
  int finest = 0;
  for (const ThbCell& cell : space.cells()) {
    finest = std::max(finest, cell.level);
    const auto columns = space.columns(cell);
    EXPECT_GE(columns.size(), used);
    for (std::size_t k = 0; k < 16; ++k) {
      const auto p = static_cast<std::size_t>(GetParam().degree);
      double sum = 0.0;
      for (const auto& column : columns) {
        EXPECT_GE(column.b[k], -kThbRounding);
        sum += column.b[k];
      }
      EXPECT_NEAR(sum, k / 4 <= p && k % 4 <= p ? 1.0 : 0.0, kThbRounding);
    }
  }
  EXPECT_EQ(finest, 3);
}

TEST_P(ThbBasis, FunctionsAreLinearlyIndependent) {
  ThbSpace space = space_of(GetParam().degree, GetParam().closed, 3);
  divide_some(space, 5, 2);
  const auto n = static_cast<Eigen::Index>(space.functions());
  // values at 5 x 5 points of each cell determine its polynomials
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  const int p = GetParam().degree;
  for (const ThbCell& cell : space.cells()) {
    const auto columns = space.columns(cell);
    for (int a = 0; a < 5; ++a)
      for (int b = 0; b < 5; ++b) {
        const double at[2] = {a / 4.0, b / 4.0};
        KnotWeights w[2];
        for (int d = 0; d < 2; ++d) {
          const double arguments[3] = {at[d], at[d], at[d]};
          w[d] = bernstein_blossom(p, arguments, 0.0, 1.0);
        }
        std::vector<double> values;
        for (const auto& column : columns) {
          double sum = 0.0;
          for (std::size_t i = 0; i <= static_cast<std::size_t>(p); ++i)
            for (std::size_t j = 0; j <= static_cast<std::size_t>(p); ++j)
              sum += w[0][i] * w[1][j] * column.b[4 * i + j];
          values.push_back(sum);
        }
        for (std::size_t i = 0; i < values.size(); ++i)
          for (std::size_t j = 0; j < values.size(); ++j)
            gram(static_cast<Eigen::Index>(columns[i].function), static_cast<Eigen::Index>(columns[j].function)) +=
                values[i] * values[j];
      }
  }
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GT(values.minCoeff() / values.maxCoeff(), 1e-7) << n;
}

std::vector<Vec3> some_coefficients(const ThbSpace& space, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vec3> coefficients;
  coefficients.reserve(space.functions());
  for (std::size_t i = 0; i < space.functions(); ++i)
    coefficients.emplace_back(unit(random), unit(random), unit(random));
  return coefficients;
}

TEST_P(ThbBasis, DividingKeepsTheSurface) {
  ThbSpace space = space_of(GetParam().degree, GetParam().closed, 4);
  divide_some(space, 4, 3);
  std::mt19937 random(4);
  constexpr double kSize = 0.05;  // [m] hulls of surfaces of metres take long
  std::vector<Vec3> coefficients = some_coefficients(space, random);
  for (Vec3& c : coefficients) c *= kSize;
  ThbSpace finer = space;
  divide_some(finer, 6, 5);
  ASSERT_GT(finer.functions(), space.functions());
  const ThbSpline before{space, coefficients}, after{finer, space.refined(coefficients, finer)};
  const NurbsSurface patches(extracted(after), Body::rail, "thb");
  const auto &u = space.u(0).breaks(), &v = space.v(0).breaks();
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 400; ++k) {
    const double at_u = u.front() + (u.back() - u.front()) * 0.5 * (1.0 + unit(random)),
                 at_v = v.front() + (v.back() - v.front()) * 0.5 * (1.0 + unit(random));
    EXPECT_LT((after.point(at_u, at_v) - before.point(at_u, at_v)).norm(), 20.0 * kSize * kThbRounding);
    // and so do the patches that it is cut into
    EXPECT_LT((patches.point(at_u, at_v) - before.point(at_u, at_v)).norm(), 20.0 * kSize * kThbRounding);
  }
}

TEST_P(ThbBasis, TheSurfaceIsAsSmoothAsItsDegreeAllowsWhereLevelsMeet) {
  const int degree = GetParam().degree;
  ThbSpace space = space_of(degree, GetParam().closed, 4);
  divide_some(space, 9, 6);
  std::mt19937 random(7);
  const std::vector<Vec3> coefficients = some_coefficients(space, random);
  const ThbSpline spline{space, coefficients};
  constexpr double kStep = 1e-7, kSlopes = 100.0;  // step over a border, greatest slope of these surfaces
  for (const ThbCell& cell : space.cells()) {
    const ThbRange r = space.range(cell);
    const double v = 0.5 * (r.v0 + r.v1), h = 0.1 * (r.u1 - r.u0);
    const auto at = [&](double u) { return spline.point(u, v); };
    EXPECT_LT((at(r.u1 - kStep) - at(std::min(r.u1 + kStep, space.u(0).breaks().back()))).norm(),
              2.0 * kStep * kSlopes);
    if (degree == 1 || r.u1 + h > space.u(0).breaks().back()) continue;
    const Vec3 before = (at(r.u1) - at(r.u1 - kStep)) / kStep, behind = (at(r.u1 + kStep) - at(r.u1)) / kStep;
    EXPECT_LT((before - behind).norm(), 1e-3);
  }
}

TEST_P(ThbBasis, PolynomialsOfItsDegreeAreReproduced) {
  const int degree = GetParam().degree;
  const int degree_u = GetParam().closed ? 0 : degree;  // others are not periodic
  ThbSpace space = space_of(degree, GetParam().closed, 4);
  divide_some(space, 9, 11);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double c[3][4][4] = {};
  for (auto& coordinate : c)
    for (int a = 0; a <= degree_u; ++a)
      for (int b = 0; b <= degree; ++b) coordinate[a][b] = unit(random);
  const auto value = [&](double u, double v) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      for (int a = 0; a <= degree; ++a)
        for (int b = 0; b <= degree; ++b) sum[k] += c[k][a][b] * std::pow(u / 7.0, a) * std::pow(v / 4.0, b);
    return sum;
  };
  // its Bernstein coefficients over a cell, from those of powers of u and v
  const auto piece_of = [&](const ThbCell& cell) {
    const ThbRange r = space.range(cell);
    const auto blossom = [&](int power, int k, double low, double high, double scale) {
      // symmetric sum of products of so many of the arguments, k of which are high
      double e[4] = {1.0, 0.0, 0.0, 0.0};
      for (int i = 0; i < degree; ++i)
        for (int m = degree; m > 0; --m) e[m] += e[m - 1] * (i < degree - k ? low : high) / scale;
      constexpr double kChoose[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
      return e[power] / kChoose[degree][power];
    };
    ThbPiece out{};
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= degree; ++j) {
        Vec3 sum = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
          for (int a = 0; a <= degree; ++a)
            for (int b = 0; b <= degree; ++b)
              sum[k] += c[k][a][b] * blossom(a, i, r.u0, r.u1, 7.0) * blossom(b, j, r.v0, r.v1, 4.0);
        out[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = sum;
      }
    return out;
  };
  const ThbSpline spline{space, space.coefficients(piece_of)};
  for (int k = 0; k < 300; ++k) {
    const double u = 3.5 * (1.0 + unit(random)), v = 2.1 * (1.0 + unit(random));
    EXPECT_LT((spline.point(u, v) - value(u, v)).norm(), 50.0 * kThbRounding) << u << ' ' << v;
  }
}

TEST(ThbSpace, NamesLevelsWithoutSupport) {
  ThbSpace space = space_of(3, false, 3);
  for (int i = 2; i < 6; ++i)
    for (int j = 1; j < 6; ++j) space.divide({0, i, j});
  space.settle();
  EXPECT_NO_THROW(space.require_support());
  space.divide_alone({1, 7, 5});  // of one cell no function is made
  space.settle();
  try {
    space.require_support();
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("level 2"), std::string::npos) << e.what();
  }
  EXPECT_THROW(space.divide_alone({1, 0, 0}), Error);  // its parent is not divided
}

TEST(KnotLine, SaysWhatIsWrongWithKnots) {
  const auto refused = [](int degree, std::vector<double> knots) {
    try {
      KnotLine::of_knots({degree, std::move(knots)});
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(3, {0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1}), "");
  EXPECT_NE(refused(4, {0, 0, 0, 0, 1, 1, 1, 1}).find("degree 4"), std::string::npos);
  EXPECT_NE(refused(2, {0, 0, 0, 0.5, 0.4, 1, 1, 1}).find("knot 5 is less"), std::string::npos);
  EXPECT_NE(refused(2, {0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1}).find("repeated 3 times"), std::string::npos);
  EXPECT_NE(refused(3, {0, 0, 1, 1}).find("too few"), std::string::npos);
  EXPECT_NE(refused(1, {0, 0, std::nan(""), 1}).find("not finite"), std::string::npos);
}

PointGrid sampled(Body body, double u0, double u1, int nu, double y0, double y1, int ny,
                  const std::function<double(double, double)>& h) {
  PointGrid grid;
  grid.body = body;
  for (int i = 0; i < nu; ++i) grid.u.push_back(u0 + (u1 - u0) * i / (nu - 1));
  for (int j = 0; j < ny; ++j) grid.y.push_back(y0 + (y1 - y0) * j / (ny - 1));
  for (const double u : grid.u)
    for (const double y : grid.y) grid.h.push_back(h(u, y));
  return grid;
}

PointGrid round_wheel(int nu, int ny, const std::function<double(double, double)>& r) {
  PointGrid grid = sampled(Body::wheel, -kPi, kPi, nu + 1, -0.05, 0.05, ny, r);
  grid.u.pop_back();
  grid.h.resize(grid.u.size() * grid.y.size());
  grid.closed = true;
  return grid;
}

struct Errors {
  double most = 0.0, rms = 0.0;
};
Errors errors_of(const NurbsSurface& surface, double x_half, double y_half,
                 const std::function<double(double, double)>& h) {
  Errors e;
  int count = 0;
  const bool wheel = surface.facing() == Facing::down;
  const Pose X{{0.0, 0.0, wheel ? kRadius : 0.0}, Mat3::Identity()};
  for (int i = 0; i < 61; ++i)
    for (int j = 0; j < 59; ++j) {
      const double x = x_half * (i / 30.0 - 1.0), y = y_half * (j / 29.0 - 1.0);
      const double z = height_at(surface, X, {x, y}) + X.origin.z();
      const double error = wheel ? std::hypot(x, z) - h(std::atan2(x, z), y) : z - h(x, y);
      e.most = std::isnan(error) ? error : std::max(e.most, std::abs(error));
      e.rms += error * error;
      ++count;
    }
  e.rms = std::sqrt(e.rms / count);
  return e;
}
Errors errors_of(const ThbSpline& spline, Body body, double x_half, double y_half,
                 const std::function<double(double, double)>& h) {
  return errors_of(NurbsSurface(extracted(spline), body, "thb"), x_half, y_half, h);
}

TEST(ThbFit, PolynomialsOfItsDegreeAreExact) {
  for (const int degree : {2, 3}) {
    const auto h = [&](double x, double) {
      return 0.01 - 0.3 * x + 2.0 * x * x - (degree == 3 ? 40.0 * x * x * x : 0.0);
    };
    ThbFitSettings settings;
    settings.degree = degree;
    const ThbFit fit = fit_thb(sampled(Body::rail, -0.1, 0.1, 201, -0.03, 0.03, 61, h), settings);
    EXPECT_LT(errors_of(fit.spline, Body::rail, 0.0999, 0.0299, h).most, 1e-13);
    EXPECT_LE(fit.spline.space.functions(), static_cast<std::size_t>((4 + degree) * (4 + degree)));
  }
}

double waves(double x, double y) { return 1e-3 * std::sin(60.0 * x) * std::cos(50.0 * y); }

TEST(ThbFit, ErrorFallsWithTheDegreePlusOne) {
  constexpr double kIrregular = 0.4;
  for (const int degree : {2, 3}) {
    ThbFitSettings uniform;
    uniform.degree = degree;
    uniform.tolerance = 0.0;
    const auto error = [&](int n) {
      return errors_of(fit_thb(sampled(Body::rail, -0.1, 0.1, n, -0.04, 0.04, n, waves), uniform).spline, Body::rail,
                       0.09, 0.035, waves)
          .rms;
    };
    const double coarse = error(33), fine = error(65), finest = error(129);
    EXPECT_GT(std::log2(coarse / fine), degree + 1 - kIrregular) << degree;
    EXPECT_GT(std::log2(fine / finest), degree + 1 - kIrregular) << degree;
  }
}

double dented(double theta, double y) {
  const double a = std::remainder(theta - 0.02, 2 * kPi) * kRadius / 0.01, b = (y - 5e-3) / 8e-3;
  return kRadius + 0.3 * y * y - 0.5e-3 * std::exp(-a * a - b * b);
}

TEST(ThbFit, CoefficientsFollowTheDamage) {
  const int nu = 2880, ny = 101;
  const ThbFit fit = fit_thb(round_wheel(nu, ny, dented));
  const NurbsSurface tensor(fit_point_grid(round_wheel(nu, ny, dented)), Body::wheel);
  const double most = errors_of(fit.spline, Body::wheel, 0.06, 0.045, dented).most;
  EXPECT_LT(most, 1.1 * errors_of(tensor, 0.06, 0.045, dented).most + 2e-9);
  EXPECT_LT(fit.spline.space.functions(), static_cast<std::size_t>(nu * ny / 15));
  EXPECT_EQ(fit.unresolved, 0u);
  EXPECT_LT(extracted(fit.spline).memory_bytes(), tensor.net().memory_bytes() / 12);
}

TEST(ThbFit, NoiseIsNotFollowed) {
  constexpr double kNoise = 3e-5;
  std::mt19937 random(8);
  std::normal_distribution<double> normal(0.0, kNoise);
  const auto noisy = [&](double x, double y) { return waves(x, y) + normal(random); };
  const ThbFit fit = fit_thb(sampled(Body::rail, -0.1, 0.1, 801, -0.04, 0.04, 321, noisy));
  EXPECT_NEAR(fit.noise, kNoise, 0.01 * kNoise);
  // n points of a coefficient leave noise / sqrt(n); what is too small to be told from noise is left out
  EXPECT_LT(errors_of(fit.spline, Body::rail, 0.095, 0.038, waves).rms, 2e-6);
  EXPECT_LT(fit.spline.space.functions(), 2000u);
}

TEST(ThbFit, IsTheSameForEveryNumberOfThreads) {
  const PointGrid points = round_wheel(720, 51, dented);
  const auto coefficients = [&](int threads) {
    const ThreadLimit limit(threads);
    return fit_thb(points).spline.coefficients;
  };
  EXPECT_EQ(coefficients(1), coefficients(2));
}

TEST(ThbFit, RefusesWhatItCannotFit) {
  PointGrid gap = sampled(Body::rail, -0.1, 0.1, 9, -0.03, 0.03, 12, waves);
  gap.h[17] = std::nan("");
  EXPECT_THROW(fit_thb(gap), Error);
  ThbFitSettings quartic;
  quartic.degree = 4;
  EXPECT_THROW(fit_thb(sampled(Body::rail, -0.1, 0.1, 9, -0.03, 0.03, 12, waves), quartic), Error);
  EXPECT_THROW(fit_thb(sampled(Body::rail, -0.1, 0.1, 3, -0.03, 0.03, 12, waves)), Error);
}

double around_wheel(double theta, double y) { return dented(theta, y) + 2e-5 * std::cos(20.0 * theta); }

std::vector<Vec3> scanned_wheel(int count, double noise) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double theta = kPi * (2.0 * unit(random) - 1.0), y = 0.1 * unit(random) - 0.05;
    const double r = around_wheel(theta, y) + noise * normal(random);
    out.emplace_back(r * std::sin(theta), y, r * std::cos(theta));
  }
  return out;
}

TEST(ThbFit, ScatteredPointsAreMetAsCloselyAsTheirNoiseAllows) {
  constexpr double kNoise = 3e-5;
  constexpr int kCount = 400'000;
  for (const int degree : {2, 3}) {
    ThbFitSettings settings;
    settings.degree = degree;
    const ThbFit fit = fit_thb(scanned_wheel(kCount, kNoise), Body::wheel, {}, settings);
    EXPECT_NEAR(fit.noise, kNoise, 0.02 * kNoise);
    EXPECT_NEAR(fit.rms_left, kNoise, 0.02 * kNoise);
    // a mean of some hundred points, and as much again for what could not be told from noise
    EXPECT_LT(errors_of(fit.spline, Body::wheel, 0.06, 0.048, around_wheel).rms, 0.125 * kNoise) << degree;
    EXPECT_LT(fit.spline.space.functions(), kCount / 200u) << degree;
  }
}

TEST(ThbFit, ScatteredPointsOfAPolynomialAreExact) {
  const auto h = [](double x, double y) { return 0.01 * x + y - 3.0 * x * x + 4.0 * x * y + 50.0 * y * y * y; };
  std::mt19937 random(10);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vec3> points;
  for (int k = 0; k < 3000; ++k) {
    const double x = 0.1 * unit(random), y = 0.03 * unit(random);
    points.emplace_back(x, y, h(x, y));
  }
  ThbFitSettings clean;
  clean.noise = 0.0;
  const ThbFit fit = fit_thb(points, Body::rail, {}, clean);
  EXPECT_LT(errors_of(fit.spline, Body::rail, 0.098, 0.0295, h).most, 1e-12);
  EXPECT_LT(fit.spline.space.functions(), 64u);
}

TEST(ThbFit, RefusesScatteredPointsThatDoNotSuffice) {
  const auto refusal = [](const std::vector<Vec3>& points, Body body, sampling::Region region = {}) {
    try {
      fit_thb(points, body, region);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  std::vector<Vec3> points = scanned_wheel(20'000, 0.0);
  EXPECT_EQ(refusal(points, Body::wheel), "");
  EXPECT_NE(refusal(points, Body::wheel, {0.0, 0.01, 0.0, 0.001}).find("too few"), std::string::npos);
  std::vector<Vec3> line(200, Vec3(0.0, 0.0, 0.0));
  for (std::size_t k = 0; k < line.size(); ++k) line[k].x() = 1e-3 * static_cast<double>(k);
  EXPECT_NE(refusal(line, Body::rail).find("lie on a line"), std::string::npos);
  std::vector<Vec3> half = points;
  std::erase_if(half, [](const Vec3& p) { return p.x() < 0.0; });
  EXPECT_NE(refusal(half, Body::wheel).find("there are no points from u"), std::string::npos)
      << refusal(half, Body::wheel);
  // it names a part that is empty, and how many points an even spread over the turn would have put there
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0, count = 0.0;
  const std::string gap = refusal(half, Body::wheel);
  ASSERT_EQ(std::sscanf(gap.c_str() + gap.find("from u"), "from u = %lf to %lf and v = %lf to %lf m, where %lf", &u0,
                        &u1, &v0, &v1, &count),
            5)
      << gap;
  double least = 1.0, most = -1.0;
  for (const Vec3& p : half) least = std::min(least, p.y()), most = std::max(most, p.y());
  const double even = static_cast<double>(half.size()) * (u1 - u0) * (v1 - v0) / (2.0 * kPi * (most - least));
  EXPECT_NEAR(count, even, 0.05 * even) << gap;
  EXPECT_EQ(refusal(half, Body::wheel, {0.0, kPi, -0.05, 0.05}), "");
  points[7].z() = std::nan("");
  EXPECT_NE(refusal(points, Body::wheel).find("point 8"), std::string::npos);
}

TEST(ThbFit, FewPointsAreEnough) {
  for (const int n : {4, 5, 6, 7, 9}) {
    const ThbFit fit = fit_thb(sampled(Body::rail, -0.01, 0.01, n, -0.003, 0.003, n, waves));
    EXPECT_LT(errors_of(fit.spline, Body::rail, 0.0099, 0.0029, waves).most, 2e-5) << n;
  }
  const ThbFit wheel = fit_thb(round_wheel(16, 6, [](double, double) { return kRadius; }));
  EXPECT_LT(errors_of(wheel.spline, Body::wheel, 0.1, 0.04, [](double, double) { return kRadius; }).most, 2e-3);
}

}  // namespace
}  // namespace treadmark::spline
