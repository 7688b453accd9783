// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/backends/spline/fit_profile.hpp"

namespace treadmark::spline {
namespace {

// Second differences that start at point i - 1: column of Q for the interior point i (Reinsch 1967).
struct SecondDifference {
  int point;
  double left, middle, right;
};

std::vector<SecondDifference> second_differences(const ProfileData& data) {
  std::vector<SecondDifference> columns;
  const int n = static_cast<int>(data.s.size());
  for (int i = 1; i + 1 < n; ++i) {
    // At a corner both second derivatives vanish, so it is no unknown.
    if (std::binary_search(data.kinks.begin(), data.kinks.end(), i)) continue;
    const auto k = static_cast<std::size_t>(i);
    const double before = 1.0 / (data.s[k] - data.s[k - 1]), after = 1.0 / (data.s[k + 1] - data.s[k]);
    columns.push_back({i, before, -before - after, after});
  }
  return columns;
}

double entry(const SecondDifference& column, int point) {
  switch (point - column.point) {
    case -1:
      return column.left;
    case 0:
      return column.middle;
    case 1:
      return column.right;
    default:
      return 0.0;
  }
}

// Matrix R + lambda Q' W^-1 Q of the second derivatives, already factorised.
BandedCholesky curvature_equations(const ProfileData& data, const std::vector<SecondDifference>& q, double lambda) {
  const int m = static_cast<int>(q.size());
  BandedCholesky matrix(m, 2);
  for (int a = 0; a < m; ++a) {
    const auto& qa = q[static_cast<std::size_t>(a)];
    const auto k = static_cast<std::size_t>(qa.point);
    matrix.at(a, a) += (data.s[k + 1] - data.s[k - 1]) / 3.0;
    for (int b = std::max(0, a - 2); b <= a; ++b) {
      const auto& qb = q[static_cast<std::size_t>(b)];
      if (qb.point == qa.point - 1) matrix.at(a, b) += (data.s[k] - data.s[k - 1]) / 6.0;
      double product = 0.0;
      for (int p = qa.point - 1; p <= qa.point + 1; ++p)
        product += entry(qa, p) * entry(qb, p) / data.weights[static_cast<std::size_t>(p)];
      matrix.at(a, b) += lambda * product;
    }
  }
  matrix.factor();
  return matrix;
}

struct FittedValues {
  std::vector<double> value, second;  // at the data positions
};

FittedValues fit(const ProfileData& data, const std::vector<SecondDifference>& q, const BandedCholesky& matrix,
                 double lambda, std::span<const double> f) {
  std::vector<double> g(q.size());
  for (std::size_t a = 0; a < q.size(); ++a) {
    const auto k = static_cast<std::size_t>(q[a].point);
    g[a] = q[a].left * f[k - 1] + q[a].middle * f[k] + q[a].right * f[k + 1];
  }
  matrix.solve(g);
  FittedValues fitted{{f.begin(), f.end()}, std::vector<double>(f.size(), 0.0)};
  for (std::size_t a = 0; a < q.size(); ++a) {
    const auto k = static_cast<std::size_t>(q[a].point);
    fitted.second[k] = g[a];
    fitted.value[k - 1] -= lambda / data.weights[k - 1] * q[a].left * g[a];
    fitted.value[k] -= lambda / data.weights[k] * q[a].middle * g[a];
    fitted.value[k + 1] -= lambda / data.weights[k + 1] * q[a].right * g[a];
  }
  return fitted;
}

void set_cubic(double (&c)[4], const FittedValues& f, std::size_t k, double h) {
  c[0] = f.value[k];
  c[1] = (f.value[k + 1] - f.value[k]) / h - h * (2.0 * f.second[k] + f.second[k + 1]) / 6.0;
  c[2] = 0.5 * f.second[k];
  c[3] = (f.second[k + 1] - f.second[k]) / (6.0 * h);
}

}  // namespace

ProfileSpline fit_cubic_smoothing(const ProfileData& data, double lambda) {
  const auto q = second_differences(data);
  const BandedCholesky matrix = curvature_equations(data, q, lambda);
  const FittedValues y = fit(data, q, matrix, lambda, data.y), z = fit(data, q, matrix, lambda, data.z);

  std::vector<CubicSegment> segments(data.s.size() - 1);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const double h = data.s[k + 1] - data.s[k];
    set_cubic(segments[k].y, y, k, h);
    set_cubic(segments[k].z, z, k, h);
  }
  std::vector<double> kinks;
  for (std::size_t k = 1; k + 1 < data.kinks.size(); ++k)
    kinks.push_back(data.s[static_cast<std::size_t>(data.kinks[k])]);
  return ProfileSpline({data.s.begin(), data.s.end()}, std::move(segments), std::move(kinks));
}

}  // namespace treadmark::spline
