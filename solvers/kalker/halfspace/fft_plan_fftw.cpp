// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>

#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

namespace {

fftw_complex* raw(std::complex<double>* p) { return reinterpret_cast<fftw_complex*>(p); }

enum class Lines { columns_forward, columns_inverse, part_forward, part_inverse };

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

  /// For a block or for what is left over, where that has a plan of its own.
  fftw_plan of(int lines) const { return (lines == of_block_ || !rest_ ? whole_ : rest_).get(); }

  /// execute(plan, first line)
  template <class Execute>
  void run(const Execute& execute) const {
    if (!whole_) return;
    const auto blocks = static_cast<std::size_t>((lines_ + of_block_ - 1) / of_block_);
    const auto block = [&](std::size_t b) {
      const int first = static_cast<int>(b) * of_block_;
      execute((first + of_block_ <= lines_ ? whole_ : rest_).get(), static_cast<std::ptrdiff_t>(first));
    };
    blocks > 1 ? parallel_for(blocks, block) : block(0);
  }

 private:
  int lines_ = 0, of_block_ = 1;
  SharedPlan whole_, rest_;
};

/// Columns by FFTW. Rows of real numbers by our own transforms, four at a time: FFTW, which does them one by one, takes
/// from a third more instructions to twice as many. FFTW_ESTIMATE chooses algorithms without timing, hence
/// repeatably.
class FftwPlan final : public FftPlan {
 public:
  FftwPlan(int nx, int ny, int active_rows)
      : nx_(nx),
        ny_(ny),
        columns_(nx / 2 + 1),
        rows_(make_lanes_fft_plan(nx, has_parts(active_rows, nx, ny) ? ny : 1, active_rows)) {
    if (ny == 1) return;
    const int of_part = columns_of_part(active_rows, nx, ny);
    AlignedVector<std::complex<double>> lines_of_part(2 * static_cast<std::size_t>(of_part) *
                                                      static_cast<std::size_t>(ny));
    const auto part_plan = [&](int sign) {
      const Lines kind = sign == FFTW_FORWARD ? Lines::part_forward : Lines::part_inverse;
      return BlockPlan(kind, ny, 1, has_parts(active_rows, nx, ny) ? columns_ : of_part, of_part, [&](int lines) {
        fftw_complex* from = raw(lines_of_part.data());
        return fftw_plan_many_dft(1, &ny, lines, from, nullptr, 1, ny, from + std::ptrdiff_t{lines} * ny, nullptr, 1,
                                  ny, sign, kFlags);
      });
    };
    part_forward_ = part_plan(FFTW_FORWARD);
    part_inverse_ = part_plan(FFTW_BACKWARD);
  }

  void rows_forward(double* real, std::complex<double>* spectrum) const override {
    rows_->rows_forward(real, spectrum);
  }
  void rows_inverse(std::complex<double>* spectrum, double* real) const override {
    rows_->rows_inverse(spectrum, real);
  }
  void columns_forward(std::complex<double>* spectrum) const override { execute(columns().forward, spectrum); }
  void columns_inverse(std::complex<double>* spectrum) const override { execute(columns().inverse, spectrum); }

  void part_of_rows_forward(int rows, double* real, std::complex<double>* spectrum) const override {
    rows_->part_of_rows_forward(rows, real, spectrum);
  }
  void part_of_rows_inverse(int rows, std::complex<double>* spectrum, double* real) const override {
    rows_->part_of_rows_inverse(rows, spectrum, real);
  }
  void part_of_columns_forward(int columns, std::complex<double>* from, std::complex<double>* to) const override {
    fftw_execute_dft(part_forward_.of(columns), raw(from), raw(to));
  }
  void part_of_columns_inverse(int columns, std::complex<double>* from, std::complex<double>* to) const override {
    fftw_execute_dft(part_inverse_.of(columns), raw(from), raw(to));
  }

 private:
  struct ColumnPlans {
    BlockPlan forward, inverse;
  };
  /// Of spectra that lie row by row: few are ever asked for.
  const ColumnPlans& columns() const {
    std::call_once(columns_made_, [this] {
      if (ny_ == 1) return;
      AlignedVector<std::complex<double>> spectrum(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(ny_));
      const std::lock_guard lock(fft_planning());
      const auto made = [&](Lines kind, int sign) {
        return BlockPlan(kind, ny_, columns_, columns_, lines_of_fft_block(columns_, nx_, ny_), [&](int lines) {
          fftw_complex* data = raw(spectrum.data());
          return fftw_plan_many_dft(1, &ny_, lines, data, nullptr, columns_, 1, data, nullptr, columns_, 1, sign,
                                    kFlags);
        });
      };
      column_plans_ = {made(Lines::columns_forward, FFTW_FORWARD), made(Lines::columns_inverse, FFTW_BACKWARD)};
    });
    return column_plans_;
  }

  static void execute(const BlockPlan& plans, std::complex<double>* spectrum) {
    plans.run([&](fftw_plan plan, std::ptrdiff_t first) {
      fftw_execute_dft(plan, raw(spectrum + first), raw(spectrum + first));
    });
  }

  static constexpr unsigned kFlags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;

  int nx_, ny_, columns_;
  std::shared_ptr<const FftPlan> rows_;
  BlockPlan part_forward_, part_inverse_;
  mutable std::once_flag columns_made_;
  mutable ColumnPlans column_plans_;
};

}  // namespace

std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows) {
  return std::make_shared<FftwPlan>(nx, ny, active_rows);
}

}  // namespace treadmark::kalker
