// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#ifdef TREADMARK_HAVE_FFTW

#include <fftw3.h>

#include <algorithm>
#include <new>

#include "treadmark/solvers/kalker/halfspace/aligned_vector.hpp"
#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

namespace {

fftw_complex* raw(std::complex<double>* p) { return reinterpret_cast<fftw_complex*>(p); }

/// Rows first (only the active ones), then columns. FFTW_ESTIMATE chooses algorithms without timing, hence repeatably.
class FftwPlan final : public FftPlan {
 public:
  FftwPlan(int nx, int ny, int active_rows) : columns_(nx / 2 + 1) {
    first_inactive_ = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(active_rows);
    end_ = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(ny);
    AlignedVector<double> real(static_cast<std::size_t>(nx) * static_cast<std::size_t>(active_rows));
    AlignedVector<std::complex<double>> spectrum(end_);
    constexpr unsigned kFlags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;
    rows_forward_ = fftw_plan_many_dft_r2c(1, &nx, active_rows, real.data(), nullptr, 1, nx, raw(spectrum.data()), nullptr,
                                           1, columns_, kFlags);
    rows_inverse_ = fftw_plan_many_dft_c2r(1, &nx, active_rows, raw(spectrum.data()), nullptr, 1, columns_, real.data(),
                                           nullptr, 1, nx, kFlags);
    if (!rows_forward_ || !rows_inverse_) throw std::bad_alloc();
    if (ny == 1) return;
    const auto column_plan = [&](int sign) {
      fftw_complex* data = raw(spectrum.data());
      return fftw_plan_many_dft(1, &ny, columns_, data, nullptr, columns_, 1, data, nullptr, columns_, 1, sign, kFlags);
    };
    columns_forward_ = column_plan(FFTW_FORWARD);
    columns_inverse_ = column_plan(FFTW_BACKWARD);
    if (!columns_forward_ || !columns_inverse_) throw std::bad_alloc();
  }
  ~FftwPlan() override {
    for (fftw_plan plan : {rows_forward_, columns_forward_, rows_inverse_, columns_inverse_})
      if (plan) fftw_destroy_plan(plan);
  }
  FftwPlan(const FftwPlan&) = delete;
  FftwPlan& operator=(const FftwPlan&) = delete;

  void forward(double* real, std::complex<double>* spectrum) const override {
    std::fill(spectrum + first_inactive_, spectrum + end_, std::complex<double>());
    fftw_execute_dft_r2c(rows_forward_, real, raw(spectrum));
    if (columns_forward_) fftw_execute_dft(columns_forward_, raw(spectrum), raw(spectrum));
  }
  void inverse(std::complex<double>* spectrum, double* real) const override {
    if (columns_inverse_) fftw_execute_dft(columns_inverse_, raw(spectrum), raw(spectrum));
    fftw_execute_dft_c2r(rows_inverse_, raw(spectrum), real);
  }

 private:
  fftw_plan rows_forward_ = nullptr, columns_forward_ = nullptr, rows_inverse_ = nullptr, columns_inverse_ = nullptr;
  int columns_;
  std::size_t first_inactive_ = 0, end_ = 0;
};

}  // namespace

std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows) {
  return std::make_shared<FftwPlan>(nx, ny, active_rows);
}

const char* fft_library() { return "FFTW"; }

}  // namespace treadmark::kalker

#endif  // TREADMARK_HAVE_FFTW
