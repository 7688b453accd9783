// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_lines.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

namespace {

using Complex = std::complex<double>;
constexpr std::ptrdiff_t kAtOnce = 4;  // lines of a kernel

/// exp(-2 pi i k / n)
Complex root(std::int64_t k, std::int64_t n) {
  return std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k % n) / static_cast<double>(n));
}

/// The passes of a length and the numbers that they point to.
class Passes {
 public:
  explicit Passes(int n) {
    passes_.n = n;
    for (int left = n; left > 1;) {
      int radix = left % 4 == 0 ? 4 : 2;
      for (; left % radix != 0; radix = radix == 2 ? 3 : radix + 2)
        if (std::int64_t{radix} * radix > left) {
          radix = left;  // a prime
          break;
        }
      for (int q = 0; q < left / radix; ++q)
        for (int c = 1; c < radix; ++c) numbers_.push_back(root(std::int64_t{q} * c, left));
      for (int k = 0; k < radix; ++k) numbers_.push_back(root(k, radix));
      passes_.radix[passes_.count++] = radix;
      left /= radix;
    }
    const auto* at = reinterpret_cast<const double*>(numbers_.data());
    int left = n;
    for (int i = 0; i < passes_.count; ++i) {
      const int radix = passes_.radix[i];
      passes_.turns[i] = at;
      at += 2 * std::ptrdiff_t{radix - 1} * (left / radix);
      passes_.roots[i] = at;
      at += 2 * radix;
      left /= radix;
    }
  }
  Passes(const Passes&) = delete;
  Passes& operator=(const Passes&) = delete;

  const FftPasses& get() const { return passes_; }

 private:
  FftPasses passes_;
  std::vector<Complex> numbers_;
};

/// Four lines at a time by FftLines. Every line is transformed by the same operations, whatever lies beside it.
class LanesPlan final : public FftPlan {
 public:
  LanesPlan(int nx, int ny, int active_rows)
      : nx_(nx), ny_(ny), active_rows_(active_rows), columns_(nx / 2 + 1), along_row_(nx / 2), along_column_(ny) {
    for (int k = 0; k <= nx / 2; ++k) turns_.push_back(root(k, nx));
  }

  void rows_forward(double* real, Complex* spectrum) const override {
    in_blocks(active_rows_, [&](std::ptrdiff_t begin, std::ptrdiff_t end) { forward(begin, end, real, spectrum); });
  }
  void rows_inverse(Complex* spectrum, double* real) const override {
    in_blocks(active_rows_, [&](std::ptrdiff_t begin, std::ptrdiff_t end) { inverse(begin, end, spectrum, real); });
  }
  void columns_forward(Complex* spectrum) const override { transform_columns(spectrum, false); }
  void columns_inverse(Complex* spectrum) const override { transform_columns(spectrum, true); }

  void part_of_rows_forward(int rows, double* real, Complex* spectrum) const override {
    forward(0, rows, real, spectrum);
  }
  void part_of_rows_inverse(int rows, Complex* spectrum, double* real) const override {
    inverse(0, rows, spectrum, real);
  }
  void part_of_columns_forward(int columns, Complex* from, Complex* to) const override {
    transform_lines(columns, from, to, false);
  }
  void part_of_columns_inverse(int columns, Complex* from, Complex* to) const override {
    transform_lines(columns, from, to, true);
  }

 private:
  template <class Body>
  void in_blocks(int lines, const Body& body) const {
    parallel_blocks(static_cast<std::size_t>(lines), static_cast<std::size_t>(lines_of_fft_block(lines, nx_, ny_)),
                    [&](std::size_t begin, std::size_t end) {
                      body(static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
                    });
  }

  /// Of this thread, until it asks again.
  double* work() const {
    thread_local AlignedVector<double> numbers;
    const std::size_t size = FftLines::kWork * static_cast<std::size_t>(std::max(nx_ / 2, ny_) + 1);
    if (numbers.size() < size) numbers.resize(size);
    return numbers.data();
  }

  static double* doubles(Complex* numbers) { return reinterpret_cast<double*>(numbers); }

  /// each(count, from, to) for up to four lines, `from_length` and `to_length` doubles apart.
  template <class Each>
  static void by_fours(std::ptrdiff_t begin, std::ptrdiff_t end, const double* from, std::ptrdiff_t from_length,
                       double* to, std::ptrdiff_t to_length, const Each& each) {
    for (std::ptrdiff_t k = begin; k < end; k += kAtOnce) {
      std::array<const double*, kAtOnce> sources{};
      std::array<double*, kAtOnce> targets{};
      const std::ptrdiff_t count = std::min(kAtOnce, end - k);
      for (std::ptrdiff_t i = 0; i < count; ++i) {
        sources[static_cast<std::size_t>(i)] = from + (k + i) * from_length;
        targets[static_cast<std::size_t>(i)] = to + (k + i) * to_length;
      }
      each(static_cast<int>(count), sources.data(), targets.data());
    }
  }

  void forward(std::ptrdiff_t begin, std::ptrdiff_t end, const double* real, Complex* spectrum) const {
    double* const own = work();
    by_fours(begin, end, real, nx_, doubles(spectrum), 2 * columns_, [&](int count, auto* from, auto* to) {
      kernel_.real_forward(along_row_.get(), turns(), count, from, to, own);
    });
  }
  void inverse(std::ptrdiff_t begin, std::ptrdiff_t end, Complex* spectrum, double* real) const {
    double* const own = work();
    by_fours(begin, end, doubles(spectrum), 2 * columns_, real, nx_, [&](int count, auto* from, auto* to) {
      kernel_.real_inverse(along_row_.get(), turns(), count, from, to, own);
    });
  }

  void transform_columns(Complex* spectrum, bool inverse) const {
    if (ny_ == 1) return;
    in_blocks(static_cast<int>(columns_), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      double* const own = work();
      for (std::ptrdiff_t k = begin; k < end; k += kAtOnce)
        kernel_.columns(along_column_.get(), static_cast<int>(std::min(kAtOnce, end - k)), doubles(spectrum + k),
                        2 * columns_, inverse, own);
    });
  }

  void transform_lines(int count, Complex* from, Complex* to, bool inverse) const {
    double* const own = work();
    by_fours(0, count, doubles(from), 2 * std::ptrdiff_t{ny_}, doubles(to), 2 * std::ptrdiff_t{ny_},
             [&](int lines, auto* sources, auto* targets) {
               kernel_.lines(along_column_.get(), lines, sources, targets, inverse, own);
             });
  }

  const double* turns() const { return reinterpret_cast<const double*>(turns_.data()); }

  const FftLines& kernel_ = fastest_kernel<FftLines>();
  int nx_, ny_, active_rows_;
  std::ptrdiff_t columns_;
  Passes along_row_, along_column_;
  std::vector<Complex> turns_;
};

}  // namespace

std::shared_ptr<const FftPlan> make_lanes_fft_plan(int nx, int ny, int active_rows) {
  return std::make_shared<LanesPlan>(nx, ny, active_rows);
}

}  // namespace treadmark::kalker
