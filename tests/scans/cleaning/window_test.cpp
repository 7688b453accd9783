// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "treadmark/tests/support/kernels.hpp"

namespace treadmark::scans {
namespace {

Window rough_window(int count, unsigned seed) {
  Window window{};
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> at(-1.0f, 1.0f);
  std::normal_distribution<float> rough(0.0f, 20e-6f);
  window.count = count;
  for (int i = 0; i < count; ++i) {
    window.x[i] = at(random);
    window.y[i] = at(random);
    window.d[i] = i % 9 == 4 ? 2e-3f : 1e-4f * window.x[i] + rough(random);
  }
  return window;
}

constexpr double kQuadratic[] = {1e-5, 9e-5, -2e-5, 3e-5, 1e-5, -4e-5};

double residual_of(const Window& window, int i) {
  const double x = window.x[i], y = window.y[i];
  const double terms[] = {1.0, x, y, x * x, x * y, y * y};
  double sum = window.d[i];
  for (int k = 0; k < 6; ++k) sum -= kQuadratic[k] * terms[k];
  return sum;
}

TEST(WindowKernel, SumsAreThoseOfEachPointByItself) {
  constexpr double kScale = 30e-6;
  ASSERT_FALSE(all_kernels<WindowKernel>().empty());
  for (const WindowKernel* kernel : all_kernels<WindowKernel>())
    for (const int count : {12, 13, 14, 15, 61, 220})
      for (const WindowWeights weights : {WindowWeights::even, WindowWeights::absolute, WindowWeights::biweight}) {
        const Window window = rough_window(count, 3);
        std::array<double, Window::kMoments> moments, wanted{};
        std::array<double, Window::kTerms> products, wanted_products{};
        kernel->sums(window, kQuadratic, weights, kScale, moments.data(), products.data());
        for (int i = 0; i < count; ++i) {
          const double x = window.x[i], y = window.y[i], r = std::fabs(residual_of(window, i));
          double w = 1.0;
          if (weights == WindowWeights::absolute) w = std::min(1.0, kScale / r);
          if (weights == WindowWeights::biweight) w = r < kScale ? std::pow(1.0 - std::pow(r / kScale, 2), 2) : 0.0;
          std::size_t at = 0;
          for (int j = 0; j <= 4; ++j)
            for (int k = 0; k + j <= 4; ++k) wanted[at++] += w * std::pow(x, k) * std::pow(y, j);
          const double terms[] = {1.0, x, y, x * x, x * y, y * y};
          for (std::size_t k = 0; k < 6; ++k) wanted_products[k] += w * terms[k] * static_cast<double>(window.d[i]);
        }
        for (std::size_t k = 0; k < moments.size(); ++k) EXPECT_NEAR(moments[k], wanted[k], 1e-11) << count << ' ' << k;
        for (std::size_t k = 0; k < products.size(); ++k) EXPECT_NEAR(products[k], wanted_products[k], 1e-15) << count;
      }
}

TEST(WindowKernel, MiddleIsThatOfSortedSizes) {
  for (const WindowKernel* kernel : all_kernels<WindowKernel>())
    for (const int count : {12, 13, 16, 17, 61, 220})
      for (unsigned seed = 0; seed < 20; ++seed) {
        Window window = rough_window(count, seed);
        if (seed == 1)  // all alike
          for (int i = 0; i < count; ++i) window.x[i] = window.x[0], window.y[i] = window.y[0], window.d[i] = 1e-3f;
        float middle = -1.0f, greatest = -1.0f;
        kernel->sizes(window, kQuadratic, &middle, &greatest);
        std::vector<float> sorted(window.size, window.size + count);
        for (int i = 0; i < count; ++i)
          EXPECT_NEAR(sorted[static_cast<std::size_t>(i)], std::fabs(residual_of(window, i)), 1e-9);
        std::sort(sorted.begin(), sorted.end());
        EXPECT_EQ(middle, sorted[static_cast<std::size_t>(count) / 2]) << count << ' ' << seed;
        EXPECT_EQ(greatest, sorted.back()) << count << ' ' << seed;
      }
}

}  // namespace
}  // namespace treadmark::scans
