// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fftw3.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <new>
#include <type_traits>

#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

namespace {

fftw_complex* raw(std::complex<double>* p) { return reinterpret_cast<fftw_complex*>(p); }

enum class Lines { rows_forward, rows_inverse, columns_forward, columns_inverse, part_forward, part_inverse };

/// Plans of lines of one length, distance and number, as long as anyone has them: making one takes as long as dozens of
/// transforms by it. Made and destroyed by one thread at a time.
using SharedPlan = std::shared_ptr<std::remove_pointer_t<fftw_plan>>;
template <class Make>
SharedPlan shared_lines(Lines kind, int length, int distance, int lines, const Make& make) {
  static std::map<std::array<int, 4>, std::weak_ptr<std::remove_pointer_t<fftw_plan>>> known;
  std::erase_if(known, [](const auto& one) { return one.second.expired(); });
  auto& kept = known[{static_cast<int>(kind), length, distance, lines}];
  if (SharedPlan plan = kept.lock()) return plan;
  SharedPlan plan(make(lines), fftw_destroy_plan);
  if (!plan) throw std::bad_alloc();
  kept = plan;
  return plan;
}

/// Rows of a small transform go in blocks of so many, whatever their number, for which there are few plans.
constexpr int kFewRows = 4;

/// A plan for a number of lines and one for what is left over where lines are not a multiple of it.
class BlockPlan {
 public:
  BlockPlan() = default;
  template <class Make>
  BlockPlan(Lines kind, int length, int distance, int lines, int of_block, const Make& make)
      : lines_(lines), of_block_(of_block) {
    whole_ = shared_lines(kind, length, distance, of_block, make);
    if (lines % of_block != 0) rest_ = shared_lines(kind, length, distance, lines % of_block, make);
  }

  /// For a block or for what is left over.
  fftw_plan of(int lines) const { return (lines == of_block_ ? whole_ : rest_).get(); }

  /// execute(plan, first line)
  template <class Execute>
  void run(const Execute& execute) const {
    if (!whole_) return;
    const auto blocks = static_cast<std::size_t>((lines_ + of_block_ - 1) / of_block_);
    const auto block = [&](std::size_t b) {
      const int first = static_cast<int>(b) * of_block_;
      execute((first + of_block_ <= lines_ ? whole_ : rest_).get(), static_cast<std::ptrdiff_t>(first));
    };
    if (of_block_ > kFewRows) return parallel_for(blocks, block);
    for (std::size_t b = 0; b < blocks; ++b) block(b);
  }

 private:
  int lines_ = 0, of_block_ = 1;
  SharedPlan whole_, rest_;
};

/// FFTW_ESTIMATE chooses algorithms without timing, hence repeatably.
class FftwPlan final : public FftPlan {
 public:
  FftwPlan(int nx, int ny, int active_rows) : nx_(nx), columns_(nx / 2 + 1) {
    const int columns = columns_;
    AlignedVector<double> real(static_cast<std::size_t>(nx) * static_cast<std::size_t>(active_rows));
    AlignedVector<std::complex<double>> spectrum(static_cast<std::size_t>(columns) * static_cast<std::size_t>(ny));
    constexpr unsigned kFlags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;
    const int at_once = lines_of_fft_block(active_rows, nx, ny);
    const int rows_of_block = has_parts(active_rows, nx, ny) ? at_once : std::min(at_once, kFewRows);
    rows_forward_ = {Lines::rows_forward, nx, columns, active_rows, rows_of_block, [&](int rows) {
                       return fftw_plan_many_dft_r2c(1, &nx, rows, real.data(), nullptr, 1, nx, raw(spectrum.data()),
                                                     nullptr, 1, columns, kFlags);
                     }};
    rows_inverse_ = {Lines::rows_inverse, nx, columns, active_rows, rows_of_block, [&](int rows) {
                       return fftw_plan_many_dft_c2r(1, &nx, rows, raw(spectrum.data()), nullptr, 1, columns,
                                                     real.data(), nullptr, 1, nx, kFlags);
                     }};
    if (ny == 1) return;
    const auto column_plan = [&](int sign) {
      const Lines kind = sign == FFTW_FORWARD ? Lines::columns_forward : Lines::columns_inverse;
      return BlockPlan(kind, ny, columns, columns, lines_of_fft_block(columns, nx, ny), [&](int lines) {
        fftw_complex* data = raw(spectrum.data());
        return fftw_plan_many_dft(1, &ny, lines, data, nullptr, columns, 1, data, nullptr, columns, 1, sign, kFlags);
      });
    };
    columns_forward_ = column_plan(FFTW_FORWARD);
    columns_inverse_ = column_plan(FFTW_BACKWARD);
    if (!has_parts(active_rows, nx, ny)) return;
    const auto part_plan = [&](int sign) {
      const Lines kind = sign == FFTW_FORWARD ? Lines::part_forward : Lines::part_inverse;
      return BlockPlan(kind, ny, 1, columns, columns_of_part(nx, ny), [&](int lines) {
        fftw_complex* from = raw(spectrum.data());
        return fftw_plan_many_dft(1, &ny, lines, from, nullptr, 1, ny, from + lines * ny, nullptr, 1, ny, sign, kFlags);
      });
    };
    part_forward_ = part_plan(FFTW_FORWARD);
    part_inverse_ = part_plan(FFTW_BACKWARD);
  }

  void rows_forward(double* real, std::complex<double>* spectrum) const override {
    rows_forward_.run([&](fftw_plan plan, std::ptrdiff_t first) {
      fftw_execute_dft_r2c(plan, real + first * nx_, raw(spectrum + first * columns_));
    });
  }
  void rows_inverse(std::complex<double>* spectrum, double* real) const override {
    rows_inverse_.run([&](fftw_plan plan, std::ptrdiff_t first) {
      fftw_execute_dft_c2r(plan, raw(spectrum + first * columns_), real + first * nx_);
    });
  }
  void columns_forward(std::complex<double>* spectrum) const override { execute(columns_forward_, spectrum); }
  void columns_inverse(std::complex<double>* spectrum) const override { execute(columns_inverse_, spectrum); }

  void part_of_rows_forward(int rows, double* real, std::complex<double>* spectrum) const override {
    fftw_execute_dft_r2c(rows_forward_.of(rows), real, raw(spectrum));
  }
  void part_of_rows_inverse(int rows, std::complex<double>* spectrum, double* real) const override {
    fftw_execute_dft_c2r(rows_inverse_.of(rows), raw(spectrum), real);
  }
  void part_of_columns_forward(int columns, std::complex<double>* from, std::complex<double>* to) const override {
    fftw_execute_dft(part_forward_.of(columns), raw(from), raw(to));
  }
  void part_of_columns_inverse(int columns, std::complex<double>* from, std::complex<double>* to) const override {
    fftw_execute_dft(part_inverse_.of(columns), raw(from), raw(to));
  }

 private:
  static void execute(const BlockPlan& plans, std::complex<double>* spectrum) {
    plans.run([&](fftw_plan plan, std::ptrdiff_t first) {
      fftw_execute_dft(plan, raw(spectrum + first), raw(spectrum + first));
    });
  }

  int nx_, columns_;
  BlockPlan rows_forward_, columns_forward_, rows_inverse_, columns_inverse_, part_forward_, part_inverse_;
};

}  // namespace

std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows) {
  return std::make_shared<FftwPlan>(nx, ny, active_rows);
}

}  // namespace treadmark::kalker
