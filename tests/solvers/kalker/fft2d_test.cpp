// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {
namespace {

using Complex = std::complex<double>;

/// Sums of a few hundred values of order one, rounded once per operation.
constexpr double kFft2dRounding = 1e-11;

AlignedVector<double> random_field(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  AlignedVector<double> field(size);
  for (double& value : field) value = uniform(generator);
  return field;
}

Complex sum_by_definition(const RealFft2d& fft, const AlignedVector<double>& field, int kx, int ky) {
  Complex sum;
  for (int iy = 0; iy < fft.active_rows(); ++iy)
    for (int ix = 0; ix < fft.nx(); ++ix) {
      const double phase =
          -2.0 * std::numbers::pi * (static_cast<double>(kx * ix) / fft.nx() + static_cast<double>(ky * iy) / fft.ny());
      sum += field[static_cast<std::size_t>(ix + fft.nx() * iy)] * std::polar(1.0, phase);
    }
  return sum;
}

struct Shape {
  int nx, ny, active_rows;
};

class Fft2dShapes : public ::testing::TestWithParam<Shape> {};

TEST_P(Fft2dShapes, MatchesTheDefinitionAndInverts) {
  const auto [nx, ny, active_rows] = GetParam();
  const RealFft2d fft(nx, ny, active_rows);
  const AlignedVector<double> field = random_field(fft.real_size(), 7);
  AlignedVector<double> work = field;
  AlignedVector<Complex> spectrum(fft.spectrum_size(), Complex(std::nan(""), std::nan("")));
  fft.forward(work, spectrum);
  for (int ky = 0; ky < ny; ++ky)
    for (int kx = 0; kx <= nx / 2; ++kx)
      ASSERT_LT(
          std::abs(spectrum[static_cast<std::size_t>(kx + (nx / 2 + 1) * ky)] - sum_by_definition(fft, field, kx, ky)),
          kFft2dRounding)
          << kx << ' ' << ky;
  fft.inverse(spectrum, work);
  for (std::size_t i = 0; i < field.size(); ++i) ASSERT_NEAR(work[i] / (nx * ny), field[i], kFft2dRounding);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Fft2dShapes,
                         ::testing::Values(Shape{2, 1, 1}, Shape{4, 3, 3}, Shape{14, 15, 15}, Shape{30, 28, 13},
                                           Shape{16, 1, 1}, Shape{6, 22, 9}));

// Rows and columns of numbers that are no multiples of those that are transformed together; the last one in parts.
TEST(Fft2d, MultipliesFieldsLineByLine) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (const Shape& shape :
       {Shape{2, 1, 1}, {16, 1, 1}, {4, 2, 1}, {4, 3, 3}, {14, 15, 15}, {18, 22, 9}, {30, 28, 13}, {270, 315, 301}}) {
    const RealFft2d fft(shape.nx, shape.ny, shape.active_rows);
    const auto symbol = [&](int kx, int ky) {
      return 1.0 + 0.3 * std::cos(kTurn * kx / fft.nx()) + 0.2 * std::cos(kTurn * ky / fft.ny());
    };
    // what becomes of each field is the other one, multiplied
    const std::array fields{random_field(fft.real_size(), 5), random_field(fft.real_size(), 6)};
    std::array<AlignedVector<double>, 2> found, expected;
    std::array<RealFft2d::LoadRows, 2> load;
    std::array<RealFft2d::StoreRows, 2> store;
    for (std::size_t f = 0; f < 2; ++f) {
      AlignedVector<double> work = fields[1 - f];
      AlignedVector<Complex> spectrum(fft.spectrum_size());
      fft.forward(work, spectrum);
      for (int ky = 0; ky < fft.ny(); ++ky)
        for (int kx = 0; kx <= fft.nx() / 2; ++kx)
          spectrum[static_cast<std::size_t>(kx + (fft.nx() / 2 + 1) * ky)] *= symbol(kx, ky);
      expected[f].resize(fft.real_size()), found[f].resize(fft.real_size());
      fft.inverse(spectrum, expected[f]);
      load[f] = [&fft, from = fields[f].data()](int first, int count, double* rows) {
        std::copy_n(from + first * fft.nx(), count * fft.nx(), rows);
      };
      store[f] = [&fft, to = found[f].data()](int first, int count, const double* rows) {
        std::copy_n(rows, count * fft.nx(), to + first * fft.nx());
      };
    }
    const RealFft2d::Line factor = [&](int line, Complex* const* values) {
      for (int k = 0; k < fft.line_length(); ++k) {
        const double by = fft.lines_are_columns() ? symbol(line, k) : symbol(k, line);
        const Complex first = values[0][k];
        values[0][k] = by * values[1][k], values[1][k] = by * first;
      }
    };
    fft.multiply(load, factor, store);
    const double size = static_cast<double>(fft.nx()) * fft.ny();
    for (std::size_t f = 0; f < 2; ++f)
      for (std::size_t i = 0; i < found[f].size(); ++i)
        ASSERT_NEAR(found[f][i] / size, expected[f][i] / size, kFft2dRounding) << shape.nx << " x " << shape.ny;
  }
}

TEST(Fft2d, UnalignedArraysGiveTheSameResult) {
  const RealFft2d fft(12, 10);
  const AlignedVector<double> field = random_field(fft.real_size(), 3);
  AlignedVector<double> aligned = field, shifted(field.size() + 1);
  std::copy(field.begin(), field.end(), shifted.begin() + 1);
  AlignedVector<Complex> one(fft.spectrum_size()), other(fft.spectrum_size());
  fft.forward(aligned, one);
  fft.forward(std::span(shifted).subspan(1), other);
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_LT(std::abs(one[i] - other[i]), kFft2dRounding);
}

TEST(Fft2d, ThreadsGetBitwiseTheSameResult) {
  const RealFft2d fft(60, 50, 25);
  const AlignedVector<double> field = random_field(fft.real_size(), 11);
  std::vector<AlignedVector<Complex>> spectra(4, AlignedVector<Complex>(fft.spectrum_size()));
  std::vector<std::thread> threads;
  for (auto& spectrum : spectra)
    threads.emplace_back([&] {
      for (int repeat = 0; repeat < 20; ++repeat) {
        AlignedVector<double> work = field;
        RealFft2d(60, 50, 25).forward(work, spectrum);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& spectrum : spectra) EXPECT_EQ(spectrum, spectra.front());
}

TEST(Fft2d, GoodSizesAreSevenSmoothOrNearbyPowersOfTwo) {
  EXPECT_EQ(good_fft_size(1), 2);
  EXPECT_EQ(good_fft_size(7), 8);
  EXPECT_EQ(good_fft_size(11), 12);
  EXPECT_EQ(good_fft_size(83), 84);
  EXPECT_EQ(good_fft_size(105), 128) << "108 is smooth, but 128 is faster";
  EXPECT_EQ(good_fft_size(129), 140);
  EXPECT_EQ(good_fft_size(163), 168);
}

TEST(Fft2d, RoomySizesAreFewAndHardlyLarger) {
  EXPECT_EQ(roomy_columns(1), 1);
  EXPECT_EQ(roomy_rows(1), 1);
  for (const auto roomy : {roomy_columns, roomy_rows}) {
    std::set<int> sizes;
    for (int n = 2; n <= 200; ++n) {
      const int size = roomy(n);
      EXPECT_GE(size, n);
      EXPECT_LE(size, n + std::max(3, n / 3)) << n;
      EXPECT_EQ(roomy(size), size) << "a box that has grown stays";
      sizes.insert(size);
    }
    EXPECT_LT(sizes.size(), 60u);
  }
}

TEST(Fft2d, RejectsOddSizesAndWrongArrays) {
  EXPECT_THROW(RealFft2d(9, 4), Error);
  EXPECT_THROW(RealFft2d(8, 4, 5), Error);
  const RealFft2d fft(8, 4);
  AlignedVector<double> field(fft.real_size());
  AlignedVector<Complex> spectrum(fft.spectrum_size() - 1);
  EXPECT_THROW(fft.forward(field, spectrum), Error);
}

TEST(RealFft2d, KeepsNoMorePlansThanItSays) {
  const AlignedVector<double> field = random_field(16 * 5, 3);
  const auto spectrum_of = [&](const RealFft2d& fft) {
    AlignedVector<double> real = field;
    AlignedVector<Complex> spectrum(fft.spectrum_size());
    fft.forward(real, spectrum);
    return spectrum;
  };
  const RealFft2d first(16, 8, 5);
  const auto before = spectrum_of(first);
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 2; ++thread)
    threads.emplace_back([] {
      for (int ny = 1; ny <= 2 * static_cast<int>(kMostFftPlans); ++ny) RealFft2d(4, ny, 1);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(fft_plans(), kMostFftPlans);
  EXPECT_EQ(spectrum_of(first), before) << "whose plan is no longer kept";
  EXPECT_EQ(spectrum_of(RealFft2d(16, 8, 5)), before) << "whose plan is made again";
}

}  // namespace
}  // namespace treadmark::kalker
