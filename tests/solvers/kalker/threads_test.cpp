// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "owned_problem.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"
#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

using testing::hertzian;
using testing::kSteel;
using testing::OwnedProblem;

/// Rolling contact on n x n elements; two hundred have loops in several blocks and transforms in blocks of lines.
OwnedProblem large(int n, Regime regime) {
  const HertzShape shape = hertz_from_semi_axes(8e-3, 4e-3, {true, 82e3}, kSteel);
  OwnedProblem c = hertzian(shape, hertz_grid(shape, n, n, 1.1));
  c.problem.hertz = shape;
  c.problem.regime = regime;
  c.problem.rolling.step = c.problem.grid.dx;
  c.problem.creepage = {-6e-4, -4e-4, 0.3};
  if (regime == Regime::shift) c.problem.creepage = {2e-6, 1e-6, 0.0};
  return c;
}

void expect_equal(const ContactSolution& a, const ContactSolution& b, const std::string& what) {
  EXPECT_EQ(a.pressure, b.pressure) << what;
  EXPECT_EQ(a.displacement_n, b.displacement_n) << what;
  EXPECT_EQ(a.traction_x, b.traction_x) << what;
  EXPECT_EQ(a.traction_y, b.traction_y) << what;
  EXPECT_EQ(a.slip_x, b.slip_x) << what;
  EXPECT_EQ(a.state, b.state) << what;
  EXPECT_EQ(a.force_x, b.force_x) << what;
  EXPECT_EQ(a.approach, b.approach) << what;
  EXPECT_EQ(a.normal.iterations, b.normal.iterations) << what;
}

ContactSolution solve_on(int threads, const OwnedProblem& c) {
  const ThreadLimit limit(threads);
  return ContactSolver().solve(c.problem);
}

TEST(ElementBlocks, EveryElementBelongsToOneBlock) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, kElementsOfBlock, kFewestBlocks * kElementsOfBlock, 7 * kElementsOfBlock + 3}) {
    std::vector<std::atomic<int>> visits(count);
    for_each_element(count, [&](std::size_t i) { ++visits[i]; });
    for (const auto& v : visits) ASSERT_EQ(v, 1);
    for (const std::size_t width : {std::size_t{1}, std::size_t{100}, 2 * kElementsOfBlock}) {
      std::atomic<std::size_t> sum = 0;
      for_blocks(
          count / width, [&](std::size_t begin, std::size_t end) { sum += end - begin; }, width);
      EXPECT_EQ(sum, count / width);
    }
    EXPECT_EQ(sum_of_blocks(count, [](std::size_t begin, std::size_t end) { return double(end - begin); }),
              double(count));
  }
}

TEST(ElementBlocks, SumsDoNotDependOnThreads) {
  std::vector<double> field(9 * kElementsOfBlock + 17);
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = std::sin(0.1 * double(i)) * std::exp(1e-5 * double(i));
  const auto sum = [&](int threads) {
    const ThreadLimit limit(threads);
    return sum_of_blocks(field.size(), [&](std::size_t begin, std::size_t end) {
      return std::accumulate(field.begin() + std::ptrdiff_t(begin), field.begin() + std::ptrdiff_t(end), 0.0);
    });
  };
  const double one = sum(1);
  for (int threads = 2; threads <= 5; ++threads) EXPECT_EQ(sum(threads), one);
  EXPECT_NEAR(one, std::accumulate(field.begin(), field.end(), 0.0), 1e-9);
}

TEST(Threads, TransformsInBlocksOfLinesAreThoseOfSingleLines) {
  // A field of one wave in each direction transforms to one pair of numbers; rows that are not a multiple of the block.
  constexpr int nx = 270, ny = 315, active = 301;
  ASSERT_GT(active, lines_of_fft_block(active, nx, ny)) << "a transform in blocks";
  const RealFft2d fft(nx, ny, active);
  AlignedVector<double> field(fft.real_size()), back(fft.real_size());
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = std::sin(0.37 * double(i)) + 0.2 * double(i % 7);
  std::vector<AlignedVector<std::complex<double>>> spectra;
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    AlignedVector<double> copy = field;
    spectra.emplace_back(fft.spectrum_size());
    fft.forward(copy, spectra.back());
    EXPECT_TRUE(spectra.back() == spectra.front()) << threads;
  }
  // against sums written out, at some places of the spectrum
  for (const auto& [kx, ky] : {std::pair{0, 0}, {1, 0}, {17, 3}, {135, 314}, {64, 200}}) {
    std::complex<double> sum = 0.0;
    for (int iy = 0; iy < active; ++iy)
      for (int ix = 0; ix < nx; ++ix)
        sum += field[std::size_t(ix + nx * iy)] *
               std::polar(1.0, -2.0 * std::acos(-1.0) * (double(kx) * ix / nx + double(ky) * iy / ny));
    EXPECT_LT(std::abs(spectra[0][std::size_t(kx + (nx / 2 + 1) * ky)] - sum), 1e-8) << kx << ' ' << ky;
  }
  fft.inverse(spectra[0], back);
  for (std::size_t i = 0; i < field.size(); i += 101) ASSERT_NEAR(back[i] / (double(nx) * ny), field[i], 1e-12);
}

TEST(Threads, LargeContactsDoNotDependOnTheirNumber) {
  for (const Regime regime : {Regime::steady, Regime::shift, Regime::transient}) {
    const OwnedProblem c = large(200, regime);
    const ContactSolution one = solve_on(1, c);
    ASSERT_EQ(one.status, Status::ok);
    ASSERT_GT(one.elements_contact, int(2 * kElementsOfBlock));
    for (const int threads : {2, 3}) expect_equal(solve_on(threads, c), one, std::to_string(threads) + " threads");
  }
}

TEST(Threads, ContactsSolvedBesideEachOtherAreThoseSolvedAlone) {
  // Loops within loops: a thread that waits for a part of its contact must not begin another contact.
  std::vector<OwnedProblem> problems;
  for (int k = 0; k < 6; ++k) {
    problems.push_back(large(200, k % 2 == 0 ? Regime::steady : Regime::shift));
    problems.back().problem.normal_force *= 1.0 + 0.1 * k;
  }
  std::vector<ContactSolution> alone, together(problems.size());
  for (const OwnedProblem& p : problems) alone.push_back(solve_on(1, p));
  const ThreadLimit limit(4);
  parallel_for(problems.size(), [&](std::size_t k) { together[k] = ContactSolver().solve(problems[k].problem); });
  for (std::size_t k = 0; k < problems.size(); ++k) expect_equal(together[k], alone[k], std::to_string(k));
}

}  // namespace
}  // namespace treadmark::kalker
