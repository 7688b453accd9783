// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/point_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "treadmark/core/random.hpp"
#include "treadmark/scans/placement/section_fit.hpp"
#include "treadmark/tests/support/kernels.hpp"

namespace treadmark::scans {
namespace {

constexpr double kRounding = 1e-12;
constexpr float kFarOff = 4.0f;

/// A band of 12 x 10 cells with 0 to 4 points each; the interval of 3 x 5 cells in the middle.
struct SampleInterval {
  std::vector<float> a, s, residual, weight;
  std::vector<std::uint32_t> begin{0};
  IntervalPoints points{};
  static constexpr double kCell = 1e-3;

  SampleInterval() {
    Random random(5);
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column < 10; ++column) {
        for (int k = static_cast<int>(5.0 * random.uniform()); k > 0; --k) {
          a.push_back(static_cast<float>(kCell * (row + random.uniform())));
          s.push_back(static_cast<float>(kCell * (column + random.uniform())));
          residual.push_back(static_cast<float>(1e-5 * (random.uniform() - 0.5)));
          weight.push_back(random.uniform() < 0.2 ? 0.0f : static_cast<float>(1e11 * (0.5 + random.uniform())));
          if (random.uniform() < 0.1) residual.back() *= 30.0f;
        }
        begin.push_back(static_cast<std::uint32_t>(a.size()));
      }
    points = {a.data(),
              s.data(),
              begin.data() + 6 * 10 + 5,
              3,
              5,
              10,
              6.0 * kCell,
              5.0 * kCell,
              1.0 / (3.0 * kCell),
              1.0 / (5.0 * kCell)};
  }

  /// Calls visit(i, products of the basis) for the points of the interval, found by their places.
  template <class Visit>
  void each(const Visit& visit) const {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double ta = (a[i] - points.a0) * points.per_a, ts = (s[i] - points.s0) * points.per_s;
      if (ta < 0.0 || ta > 1.0 || ts < 0.0 || ts > 1.0) continue;
      const auto ba = cubic_basis(ta), bs = cubic_basis(ts);
      std::array<double, 16> b;
      for (std::size_t m = 0; m < 16; ++m) b[m] = ba[m / 4] * bs[m % 4];
      visit(i, b);
    }
  }
};

void expect_near(std::span<const double> found, std::span<const double> wanted) {
  double largest = 0.0;
  for (const double value : wanted) largest = std::max(largest, std::fabs(value));
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(found[k], wanted[k], kRounding * largest) << k;
}

TEST(PointSums, OfFunctionsAreThoseOfEachPointByItself) {
  const SampleInterval sample;
  std::array<double, 16> wbr{}, wbb{}, sum{};
  std::size_t cut = 0;
  sample.each([&](std::size_t i, const std::array<double, 16>& b) {
    const double w = sample.weight[i];
    if (w == 0.0) return;
    const double most = kFarOff / std::sqrt(sample.weight[i]);
    cut += std::fabs(sample.residual[i]) > most ? 1 : 0;
    for (std::size_t m = 0; m < 16; ++m) {
      wbr[m] += w * b[m] * std::clamp(static_cast<double>(sample.residual[i]), -most, most);
      wbb[m] += w * b[m] * b[m];
      sum[m] += b[m];
    }
  });
  EXPECT_GT(cut, 0u);
  for (const PointSums* sums : all_kernels<PointSums>()) {
    std::array<double, 16> got_wbr{}, got_wbb{}, got{};
    for (int twice = 0; twice < 2; ++twice)  // they add
      sums->functions(sample.points, sample.residual.data(), sample.weight.data(), kFarOff, got_wbr.data(),
                      got_wbb.data(), got.data());
    for (auto* list : {&got_wbr, &got_wbb, &got})
      for (double& value : *list) value *= 0.5;
    expect_near(got_wbr, wbr);
    expect_near(got_wbb, wbb);
    expect_near(got, sum);
  }
}

TEST(PointSums, OfProductsAreThoseOfEachPointByItself) {
  const SampleInterval sample;
  std::array<double, 256> products{};
  std::array<double, 16> wbr{};
  sample.each([&](std::size_t i, const std::array<double, 16>& b) {
    for (std::size_t m = 0; m < 16; ++m) {
      wbr[m] += static_cast<double>(sample.weight[i]) * b[m] * sample.residual[i];
      for (std::size_t n = 0; n < 4 * (m / 4) + 4; ++n)
        products[16 * m + n] += static_cast<double>(sample.weight[i]) * b[m] * b[n];
    }
  });
  for (const PointSums* sums : all_kernels<PointSums>()) {
    std::array<double, 256> got{};
    std::array<double, 16> got_wbr{};
    sums->products(sample.points, sample.residual.data(), sample.weight.data(), got.data(), got_wbr.data());
    expect_near(got, products);
    expect_near(got_wbr, wbr);
  }
}

TEST(PointSums, SubtractTheSurfaceWhereItsPointsAre) {
  SampleInterval sample;
  std::array<double, 16> c;
  for (std::size_t m = 0; m < 16; ++m) c[m] = 1e-5 * std::sin(3.0 * static_cast<double>(m));
  std::vector<float> wanted = sample.residual;
  sample.each([&](std::size_t i, const std::array<double, 16>& b) {
    double sum = 0.0;
    for (std::size_t m = 0; m < 16; ++m) sum += b[m] * c[m];
    wanted[i] -= static_cast<float>(sum);
  });
  for (const PointSums* sums : all_kernels<PointSums>()) {
    std::vector<float> got = sample.residual;
    sums->subtract(sample.points, c.data(), got.data());
    constexpr float kFloat = 1e-11f;  // of values about 1e-5
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], kFloat) << i;
  }
}

}  // namespace
}  // namespace treadmark::scans
