// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <numbers>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using Method = SmoothingOptions::Method;

Profile noisy_profile() {
  Profile p = testing::graph_profile(Body::rail, -20e-3, 20e-3, 41, [](double y) { return 3.0 * y * y; });
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 20e-6);
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    p.y[i] += i % 3 ? 2e-4 : 0.0;  // uneven spacing
    p.z[i] += noise(random);
  }
  return p;
}

double roof(double y) { return std::abs(y - 5e-3); }

TEST(ProfileFit, InterpolatesDataExactly) {
  for (const Method method : {Method::spline, Method::weighted_spline, Method::weighted_bspline}) {
    Profile p = noisy_profile();
    p.smoothing.method = method;
    const ProfileSpline spline = fit_profile(p);
    const auto s = arc_length(p);
    for (std::size_t i = 0; i < s.size(); ++i) {
      constexpr double kRounding = 1e-13;  // normal equations of the B-spline; the others are exact to 1e-17
      EXPECT_NEAR(spline.position(s[i]).x(), p.y[i], kRounding);
      EXPECT_NEAR(spline.position(s[i]).y(), p.z[i], kRounding);
    }
  }
}

// Dense minimisation of sum w (f_i - z_i)^2 + lambda integral f''^2 over values and slopes at the points (Hermite
// cubics), a formulation that shares nothing with the solver. Sections are joined in value at corners.
Eigen::VectorXd dense_smoothing(const std::vector<double>& s, const std::vector<double>& data,
                                const std::vector<double>& w, const std::vector<int>& corners, double lambda) {
  const int n = static_cast<int>(s.size());
  // Unknowns: values f_0 .. f_(n-1), then the left and right slope of every interval.
  const int size = n + 2 * (n - 1);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < n; ++i) {
    a(i, i) += w[static_cast<std::size_t>(i)];
    b(i) += w[static_cast<std::size_t>(i)] * data[static_cast<std::size_t>(i)];
  }
  std::vector<std::pair<int, int>> equal_slopes;
  for (int i = 0; i + 1 < n; ++i) {
    const double h = s[static_cast<std::size_t>(i) + 1] - s[static_cast<std::size_t>(i)];
    // integral f''^2 of the cubic with end values and slopes (beam element).
    Eigen::Matrix4d k;
    k << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h, 6 * h, 2 * h * h, -6 * h,
        4 * h * h;
    k *= lambda / (h * h * h);
    const int index[4] = {i, n + 2 * i, i + 1, n + 2 * i + 1};
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) a(index[r], index[c]) += k(r, c);
    const bool corner = std::find(corners.begin(), corners.end(), i + 1) != corners.end();
    if (i + 2 < n && !corner) equal_slopes.emplace_back(n + 2 * i + 1, n + 2 * i + 2);
  }
  // Lagrange multipliers join the slopes.
  const int m = static_cast<int>(equal_slopes.size());
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(size + m, size + m);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(size + m);
  full.topLeftCorner(size, size) = a;
  rhs.head(size) = b;
  for (int k = 0; k < m; ++k) {
    const auto [p, q] = equal_slopes[static_cast<std::size_t>(k)];
    full(size + k, p) = full(p, size + k) = 1.0;
    full(size + k, q) = full(q, size + k) = -1.0;
  }
  return full.fullPivLu().solve(rhs).head(size);
}

TEST(ProfileFit, CubicSmoothingMinimisesItsFunctional) {
  const Profile p = testing::graph_profile(Body::rail, -10e-3, 12e-3, 23,
                                           [](double y) { return roof(y) + 30e-6 * std::sin(9e3 * y); });
  const auto s = arc_length(p);
  const auto kinks = find_kinks(p, s);
  ASSERT_EQ(kinks.size(), 3u);
  // Metres make the beam matrix badly conditioned, so both sides work in millimetres.
  std::vector<double> s_mm, y_mm, z_mm, w(s.size(), 1.0);
  for (std::size_t i = 0; i < s.size(); ++i)
    s_mm.push_back(1e3 * s[i]), y_mm.push_back(1e3 * p.y[i]), z_mm.push_back(1e3 * p.z[i]);
  w[static_cast<std::size_t>(kinks[1])] = 100.0;
  for (const double lambda : {0.01, 1.0, 50.0}) {
    const ProfileSpline fitted = fit_cubic_smoothing({s_mm, y_mm, z_mm, kinks, w}, lambda);
    const Eigen::VectorXd expected = dense_smoothing(s_mm, z_mm, w, kinks, lambda);
    for (std::size_t i = 0; i < s.size(); ++i)
      EXPECT_NEAR(fitted.position(s_mm[i]).y(), expected(static_cast<int>(i)), 1e-9);
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
      EXPECT_NEAR(fitted.derivative(s_mm[i]).y(), expected(static_cast<int>(s.size() + 2 * i)), 1e-8);
  }
  // The whole way, in metres: lambda in m^3.
  Profile smooth = p;
  smooth.smoothing.strength = 1.0e-9;
  const ProfileSpline fitted = fit_profile(smooth);
  const Eigen::VectorXd expected = dense_smoothing(s_mm, z_mm, w, kinks, 1.0);
  for (std::size_t i = 0; i < s.size(); ++i)
    EXPECT_NEAR(fitted.position(s[i]).y(), 1e-3 * expected(static_cast<int>(i)), 1e-12);
}

// J of the B-spline method by quadrature of the result.
double bspline_functional(const ProfileSpline& f, const Profile& p, const std::vector<double>& s,
                          const std::vector<double>& w, double lambda) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) sum += w[i] * std::pow(f.position(s[i]).y() - p.z[i], 2);
  for (std::size_t k = 0; k < f.segments().size(); ++k)
    sum += lambda * (f.breaks()[k + 1] - f.breaks()[k]) * std::pow(6.0 * f.segments()[k].z[3], 2);
  return sum;
}

TEST(ProfileFit, BsplineSmoothingMinimisesItsFunctional) {
  Profile p = noisy_profile();
  p.smoothing.method = Method::weighted_bspline;
  p.smoothing.strength = 8e-3;
  const auto s = arc_length(p);
  std::vector<double> w(s.size());
  for (std::size_t i = 1; i + 1 < s.size(); ++i) w[i] = 0.5 * (s[i + 1] - s[i - 1]);
  w.front() = s[1] - s[0];
  w.back() = s[s.size() - 1] - s[s.size() - 2];
  const double lambda = std::pow(8e-3 / (2 * std::numbers::pi), 6);
  const ProfileSpline f = fit_profile(p);
  EXPECT_EQ(f.segments().size(), static_cast<std::size_t>(std::lround((s.back() - s.front()) / 2e-3)));
  // Any other member of the spline space has a greater J: add small splines with the same knots.
  const double least = bspline_functional(f, p, s, w, lambda);
  for (std::size_t k = 0; k + 4 < f.breaks().size(); ++k) {
    for (const double size : {1e-7, -1e-7}) {
      std::vector<CubicSegment> segments(f.segments().begin(), f.segments().end());
      // The uniform cubic B-spline on four intervals.
      const double h = f.breaks()[k + 1] - f.breaks()[k];
      const double bump[4][4] = {{0, 0, 0, 1}, {1, 3, 3, -3}, {4, 0, -6, 3}, {1, -3, 3, -1}};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t m = 0; m < 4; ++m)
          segments[k + i].z[m] += size * bump[i][m] / std::pow(h, static_cast<double>(m));
      const ProfileSpline other({f.breaks().begin(), f.breaks().end()}, segments);
      EXPECT_GT(bspline_functional(other, p, s, w, lambda), least);
    }
  }
}

TEST(ProfileFit, CutOffWavelengthIsDampedToHalf) {
  // z = A sin(2 pi s / L) on a flat profile, so small that arc length and y agree to 1e-8.
  constexpr double kWavelength = 10e-3, kAmplitude = 1e-7;
  for (const Method method : {Method::weighted_spline, Method::weighted_bspline}) {
    Profile p = testing::graph_profile(Body::rail, -0.1, 0.1, 801, [](double y) {
      return kAmplitude * std::cos(2 * std::numbers::pi * y / kWavelength);
    });
    p.smoothing.method = method;
    p.smoothing.strength = kWavelength;
    const ProfileSpline spline = fit_profile(p);
    // The ideal filter passes one half. A B-spline with four knots per wavelength, coefficients c exp(i w x), w h = pi
    // / 2, has the value c (2 + cos w h) / 3 and f''' = c (2 sin(w h / 2) / h)^3, so its penalty is that much greater.
    const double value = 2.0 / 3.0,
                 third = std::pow(2.0 * std::sin(std::numbers::pi / 4), 3) / std::pow(std::numbers::pi / 2, 3);
    const double expected = method == Method::weighted_spline ? 0.5 : 1.0 / (1.0 + std::pow(third / value, 2));
    double crest = 0.0;
    for (double s = -kWavelength; s <= kWavelength; s += 0.01 * kWavelength)
      crest = std::max(crest, spline.position(s).y());
    constexpr double kSampling = 0.004;  // 40 points per wavelength; a cubic is no exact sine
    EXPECT_NEAR(crest / kAmplitude, expected, kSampling);
    // Much longer waves pass, much shorter ones do not.
    for (const double factor : {4.0, 0.25}) {
      p.smoothing.strength = kWavelength / factor;
      const double passed = fit_profile(p).position(0.0).y() / kAmplitude;
      EXPECT_NEAR(passed, factor > 1 ? 1.0 : 0.0, 0.02);
    }
  }
}

TEST(ProfileFit, InterpolationConvergesWithOrderFour) {
  const auto z = [](double y) { return 0.02 * std::sin(60.0 * y); };
  double before = 0.0;
  for (const int n : {41, 81, 161, 321}) {
    const ProfileSpline spline = fit_profile(testing::graph_profile(Body::rail, -0.05, 0.05, n, z));
    double error = 0.0;
    // Natural ends lose two orders there; the middle is what counts.
    for (double s = -0.025; s < 0.025; s += 1.7e-5) {
      const Vec2 p = spline.position(s);
      error = std::max(error, std::abs(p.y() - z(p.x())));
    }
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 4.0, 0.35) << n;
    }
    before = error;
  }
}

TEST(ProfileFit, CornersStaySharp) {
  for (const Method method : {Method::spline, Method::weighted_spline, Method::weighted_bspline}) {
    Profile p = testing::graph_profile(Body::rail, -20e-3, 30e-3, 51, roof);
    p.smoothing.method = method;
    p.smoothing.strength = method == Method::spline ? 1e-9 : 4e-3;
    const ProfileSpline spline = fit_profile(p);
    ASSERT_EQ(spline.kinks().size(), 1u);
    const double kink = spline.kinks()[0];
    EXPECT_NEAR(spline.position(kink).x(), 5e-3, 1e-9);
    EXPECT_NEAR(spline.position(kink).y(), 0.0, 1e-9);
    // Straight on both sides, joined without a jump.
    EXPECT_NEAR(spline.inclination(kink - 1e-6), -std::numbers::pi / 4, 1e-6);
    EXPECT_NEAR(spline.inclination(kink), std::numbers::pi / 4, 1e-6);
    EXPECT_NEAR((spline.position(kink - 1e-12) - spline.position(kink)).norm(), 0.0, 1e-11);
  }
}

TEST(ProfileFit, ASectionOfTwoPointsIsStraight) {
  Profile p;
  p.name = "two corners";
  // Long flat sections with 5 mm between two right-angled corners and no point there.
  for (int i = 0; i <= 10; ++i) p.y.push_back(-0.03 + 3e-3 * i), p.z.push_back(0.0);
  for (int i = 0; i <= 10; ++i) p.y.push_back(0.0 + 3e-3 * i), p.z.push_back(5e-3);
  for (const Method method : {Method::spline, Method::weighted_bspline}) {
    p.smoothing.method = method;
    p.smoothing.strength = method == Method::spline ? 1e-9 : 4e-3;
    const ProfileSpline spline = fit_profile(p);
    ASSERT_EQ(spline.kinks().size(), 2u);
    for (double f = 0.05; f < 1.0; f += 0.1) {
      const Vec2 q = spline.position(spline.kinks()[0] + f * (spline.kinks()[1] - spline.kinks()[0]));
      EXPECT_NEAR(q.x(), 0.0, 1e-9);
      EXPECT_NEAR(q.y(), f * 5e-3, 1e-9);
    }
  }
}

TEST(ProfilePoints, KinksNeedCalmNeighbours) {
  Profile p = testing::graph_profile(Body::rail, -20e-3, 30e-3, 51, roof);
  EXPECT_EQ(find_kinks(p, arc_length(p)), (std::vector<int>{0, 25, 50}));
  // A second turn within the kink width spoils it.
  p.z[26] += 0.3e-3;
  EXPECT_EQ(find_kinks(p, arc_length(p)), (std::vector<int>{0, 50}));
  // Far enough away it does not.
  p.z[26] -= 0.3e-3;
  p.z[29] += 0.3e-3;
  EXPECT_EQ(find_kinks(p, arc_length(p)), (std::vector<int>{0, 25, 50}));
  // A single point between two corners joins them: one point from the end.
  Profile near_end = testing::graph_profile(Body::rail, 0.0, 5e-3, 3, [](double) { return 0.0; });
  EXPECT_EQ(find_kinks(near_end, arc_length(near_end)), (std::vector<int>{0, 1, 2}));
}

TEST(ProfilePoints, ArcLengthStartsAtTheProfileOrigin) {
  const Profile p = testing::graph_profile(Body::wheel, 10.25e-3, -20e-3, 122, [](double) { return 1e-3; });
  const auto s = arc_length(p);
  EXPECT_NEAR(s.front(), -10.25e-3, 1e-15);  // y = 0 lies between two points
  EXPECT_NEAR(s.back(), 20e-3, 1e-15);
  const Profile aside = testing::graph_profile(Body::rail, 5e-3, 9e-3, 5, [](double) { return 0.0; });
  EXPECT_EQ(arc_length(aside).front(), 0.0);  // 0 out of range: the nearest point
  Profile folded;
  folded.y = {-2e-3, 0.5e-3, 0.5e-3, 0.1e-3};
  folded.z = {0.0, 0.1e-3, 3e-3, 5e-3};
  EXPECT_EQ(arc_length(folded)[1], 0.0);  // not monotonic: the point nearest to the origin
}

TEST(ProfileFit, BadInputIsRefusedWithReason) {
  Profile p = noisy_profile();
  p.smoothing.strength = -1.0;
  EXPECT_THROW(fit_profile(p), Error);
  p.smoothing.strength = 0.0;
  p.y[4] = p.y[3], p.z[4] = p.z[3];
  try {
    fit_profile(p);
    FAIL() << "coinciding points accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    EXPECT_NE(error.message().find("number 5"), std::string::npos) << error.message();
  }
  p.y[4] = std::nan("");
  EXPECT_THROW(fit_profile(p), Error);
  p.y.resize(1);
  EXPECT_THROW(fit_profile(p), Error);
}

TEST(ProfileFit, FiveThousandPointsTakeMilliseconds) {
  Profile p = testing::graph_profile(Body::rail, -0.05, 0.05, 5000,
                                     [](double y) { return 3.0 * y * y + 1e-6 * std::sin(3e4 * y); });
  for (const Method method : {Method::spline, Method::weighted_spline, Method::weighted_bspline}) {
    p.smoothing.method = method;
    p.smoothing.strength = method == Method::spline ? 1e-9 : 2e-3;
    const auto start = std::chrono::steady_clock::now();
    const ProfileSpline spline = fit_profile(p);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_LT(seconds, 2.0);  // a dense solver would take minutes; the margin is for sanitizers and busy machines
    EXPECT_NEAR(spline.position(0.01).y(), 3.0 * std::pow(spline.position(0.01).x(), 2), 2e-6);
  }
}

}  // namespace
}  // namespace treadmark::spline
