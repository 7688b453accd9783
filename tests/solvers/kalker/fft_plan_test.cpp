// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "treadmark/core/kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_lines.hpp"

// Our own transforms, which builds without FFTW use (there fft2d_test.cpp is about them, too).

namespace treadmark::kalker {
namespace {

using FftNumbers = AlignedVector<std::complex<double>>;

/// Sums of a few hundred values of order one, rounded once per operation.
constexpr double kFftRounding = 1e-11;

FftNumbers random_numbers(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  FftNumbers numbers(static_cast<std::size_t>(count));
  for (auto& number : numbers) number = {uniform(generator), uniform(generator)};
  return numbers;
}

/// The transform of a line by its definition.
FftNumbers line_by_definition(const std::complex<double>* line, int n, double sign) {
  FftNumbers out(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i)
      out[static_cast<std::size_t>(k)] +=
          line[i] * std::polar(1.0, sign * 2.0 * std::numbers::pi * static_cast<double>(i * k % n) / n);
  return out;
}

void expect_lines(const FftNumbers& found, const FftNumbers& given, int lines, int n, double sign) {
  for (int line = 0; line < lines; ++line) {
    const FftNumbers expected = line_by_definition(given.data() + line * n, n, sign);
    for (int k = 0; k < n; ++k)
      ASSERT_LT(std::abs(found[static_cast<std::size_t>(line * n + k)] - expected[static_cast<std::size_t>(k)]),
                kFftRounding)
          << "length " << n << ", line " << line << ", number " << k;
  }
}

TEST(LanesFftPlan, LinesOfEveryLengthAreThoseOfTheDefinition) {
  constexpr int kLines = 5;  // four and one
  for (int n = 1; n <= 140; ++n) {
    const auto plan = make_lanes_fft_plan(2, n, 1);
    const FftNumbers given = random_numbers(kLines * n, static_cast<unsigned>(n));
    FftNumbers from = given, to(given.size());
    plan->part_of_columns_forward(kLines, from.data(), to.data());
    expect_lines(to, given, kLines, n, -1.0);
    from = given;
    plan->part_of_columns_inverse(kLines, from.data(), to.data());
    expect_lines(to, given, kLines, n, 1.0);
  }
}

TEST(LanesFftPlan, ColumnsAreTransformedAsLinesAre) {
  for (const int ny : {6, 35, 64, 66}) {
    constexpr int kColumns = 7, kNx = 2 * (kColumns - 1);
    const auto plan = make_lanes_fft_plan(kNx, ny, ny);
    const FftNumbers given = random_numbers(kColumns * ny, 5);
    for (const bool inverse : {false, true}) {
      FftNumbers found = given, lines(given.size()), expected(given.size());
      if (inverse)
        plan->columns_inverse(found.data());
      else
        plan->columns_forward(found.data());
      for (int k = 0; k < kColumns; ++k)
        for (int iy = 0; iy < ny; ++iy)
          lines[static_cast<std::size_t>(k * ny + iy)] = given[static_cast<std::size_t>(iy * kColumns + k)];
      if (inverse)
        plan->part_of_columns_inverse(kColumns, lines.data(), expected.data());
      else
        plan->part_of_columns_forward(kColumns, lines.data(), expected.data());
      for (int k = 0; k < kColumns; ++k)
        for (int iy = 0; iy < ny; ++iy)
          ASSERT_EQ(found[static_cast<std::size_t>(iy * kColumns + k)], expected[static_cast<std::size_t>(k * ny + iy)])
              << ny;
    }
  }
}

TEST(LanesFftPlan, RowsOfRealNumbersAreHalfOfTheirComplexTransform) {
  constexpr int kRows = 6;
  for (const int nx : {2, 4, 6, 14, 30, 64, 84, 140, 202}) {
    const auto plan = make_lanes_fft_plan(nx, 1, kRows);
    const int columns = nx / 2 + 1;
    FftNumbers given = random_numbers(kRows * nx, static_cast<unsigned>(nx));
    AlignedVector<double> real;
    for (auto& number : given) {
      number.imag(0.0);
      real.push_back(number.real());
    }
    const AlignedVector<double> before = real;
    FftNumbers spectrum(static_cast<std::size_t>(kRows * columns)), part(spectrum.size());
    plan->rows_forward(real.data(), spectrum.data());
    for (int row = 0; row < kRows; ++row) {
      const FftNumbers expected = line_by_definition(given.data() + row * nx, nx, -1.0);
      for (int k = 0; k < columns; ++k)
        ASSERT_LT(
            std::abs(spectrum[static_cast<std::size_t>(row * columns + k)] - expected[static_cast<std::size_t>(k)]),
            kFftRounding)
            << nx << ", row " << row << ", number " << k;
    }
    real = before;
    plan->part_of_rows_forward(3, real.data(), part.data());  // other lanes, the same bytes
    for (int k = 0; k < 3 * columns; ++k)
      ASSERT_EQ(part[static_cast<std::size_t>(k)], spectrum[static_cast<std::size_t>(k)]);
    plan->rows_inverse(spectrum.data(), real.data());
    for (std::size_t i = 0; i < real.size(); ++i) ASSERT_NEAR(real[i] / nx, before[i], kFftRounding);
  }
}

TEST(LanesFftPlan, MachinesWithoutAvx2GetTheSameButForRounding) {
  if (avx2_kernel<FftLines>() == nullptr) GTEST_SKIP() << "no AVX2";
  // A pass of a prime that has no function of its own: all of a length of 61 numbers.
  constexpr int kPrime = 61;
  std::vector<double> roots, ones(2 * (kPrime - 1), 0.0);
  for (int k = 0; k < kPrime; ++k)
    for (const double part :
         {std::cos(2.0 * std::numbers::pi * k / kPrime), -std::sin(2.0 * std::numbers::pi * k / kPrime)})
      roots.push_back(part);
  for (std::size_t c = 0; c < ones.size(); c += 2) ones[c] = 1.0;
  FftPasses passes;
  passes.n = kPrime;
  passes.count = 1;
  passes.radix[0] = kPrime;
  passes.turns[0] = ones.data();
  passes.roots[0] = roots.data();
  const FftNumbers given = random_numbers(kPrime, 9);
  AlignedVector<double> work(FftLines::kWork * (kPrime + 1));
  FftNumbers found[2];
  int which = 0;
  for (const FftLines* kernel : {&FftLines::generic, avx2_kernel<FftLines>()}) {
    FftNumbers& to = found[which++] = given;
    const double* from = reinterpret_cast<const double*>(given.data());
    double* target = reinterpret_cast<double*>(to.data());
    kernel->lines(passes, 1, &from, &target, false, work.data());
    expect_lines(to, given, 1, kPrime, -1.0);
  }
  for (int k = 0; k < kPrime; ++k)
    EXPECT_LT(std::abs(found[0][static_cast<std::size_t>(k)] - found[1][static_cast<std::size_t>(k)]), kFftRounding);
}

}  // namespace
}  // namespace treadmark::kalker
