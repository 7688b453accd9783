// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/spectrum_kernel.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <random>
#include <utility>
#include <vector>

#include "treadmark/core/kernel.hpp"

namespace treadmark::kalker {
namespace {

using Complex = std::complex<double>;

struct Spectra {
  std::vector<double> blocks;
  std::vector<Complex> x, y, factors;

  explicit Spectra(std::size_t n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto draw = [&] { return Complex(number(random), number(random)); };
    for (std::size_t k = 0; k < 3 * n; ++k) blocks.push_back(number(random));
    for (std::size_t k = 0; k < n; ++k) x.push_back(draw()), y.push_back(draw()), factors.push_back(draw());
  }
  double* numbers(std::vector<Complex>& z) { return reinterpret_cast<double*>(z.data()); }
  /// What comes of place k.
  std::pair<Complex, Complex> wanted(std::size_t k, const Complex& factor) const {
    const double* b = blocks.data() + 3 * k;
    return {(b[0] * x[k] + b[1] * y[k]) * factor, (b[1] * x[k] + b[2] * y[k]) * factor};
  }
};

/// how: 0 plainly, 1 turned by one factor, 2 by a factor each.
Spectra multiplied(const SpectrumKernel& kernel, Spectra s, int how, const Complex& one) {
  const std::size_t n = s.x.size();
  double *x = s.numbers(s.x), *y = s.numbers(s.y);
  if (how == 0) kernel.plain(n, s.blocks.data(), x, y);
  if (how == 1) kernel.turned(n, s.blocks.data(), x, y, one.real(), one.imag());
  if (how == 2) kernel.turned_each(n, s.blocks.data(), x, y, s.numbers(s.factors));
  return s;
}

TEST(SpectrumKernel, MultipliesAndAllGiveTheSameBits) {
  const Complex one(0.6, -0.8);
  for (const std::size_t n : {0u, 1u, 2u, 3u, 8u, 33u})
    for (int how = 0; how < 3; ++how) {
      const Spectra before(n), generic = multiplied(SpectrumKernel::generic, before, how, one);
      for (std::size_t k = 0; k < n; ++k) {
        const auto [x, y] = before.wanted(k, how == 0 ? 1.0 : how == 1 ? one : before.factors[k]);
        EXPECT_LT(std::abs(generic.x[k] - x), 1e-15) << n << ' ' << how << ' ' << k;
        EXPECT_LT(std::abs(generic.y[k] - y), 1e-15) << n << ' ' << how << ' ' << k;
      }
      const Spectra fastest = multiplied(fastest_kernel<SpectrumKernel>(), before, how, one);
      EXPECT_EQ(fastest.x, generic.x) << n << ' ' << how;
      EXPECT_EQ(fastest.y, generic.y) << n << ' ' << how;
    }
}

}  // namespace
}  // namespace treadmark::kalker
