// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fftw3.h>

#include <new>

#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

namespace {

fftw_complex* raw(std::complex<double>* p) { return reinterpret_cast<fftw_complex*>(p); }

/// FFTW_ESTIMATE chooses algorithms without timing, hence repeatably.
class FftwPlan final : public FftPlan {
 public:
  FftwPlan(int nx, int ny, int active_rows) {
    const int columns = nx / 2 + 1;
    AlignedVector<double> real(static_cast<std::size_t>(nx) * static_cast<std::size_t>(active_rows));
    AlignedVector<std::complex<double>> spectrum(static_cast<std::size_t>(columns) * static_cast<std::size_t>(ny));
    constexpr unsigned kFlags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;
    rows_forward_ = fftw_plan_many_dft_r2c(1, &nx, active_rows, real.data(), nullptr, 1, nx, raw(spectrum.data()),
                                           nullptr, 1, columns, kFlags);
    rows_inverse_ = fftw_plan_many_dft_c2r(1, &nx, active_rows, raw(spectrum.data()), nullptr, 1, columns, real.data(),
                                           nullptr, 1, nx, kFlags);
    if (!rows_forward_ || !rows_inverse_) throw std::bad_alloc();
    if (ny == 1) return;
    const auto column_plan = [&](int sign) {
      fftw_complex* data = raw(spectrum.data());
      return fftw_plan_many_dft(1, &ny, columns, data, nullptr, columns, 1, data, nullptr, columns, 1, sign, kFlags);
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

  void rows_forward(double* real, std::complex<double>* spectrum) const override {
    fftw_execute_dft_r2c(rows_forward_, real, raw(spectrum));
  }
  void rows_inverse(std::complex<double>* spectrum, double* real) const override {
    fftw_execute_dft_c2r(rows_inverse_, raw(spectrum), real);
  }
  void columns_forward(std::complex<double>* spectrum) const override { execute(columns_forward_, spectrum); }
  void columns_inverse(std::complex<double>* spectrum) const override { execute(columns_inverse_, spectrum); }

 private:
  static void execute(fftw_plan plan, std::complex<double>* spectrum) {
    if (plan) fftw_execute_dft(plan, raw(spectrum), raw(spectrum));
  }

  fftw_plan rows_forward_ = nullptr, columns_forward_ = nullptr, rows_inverse_ = nullptr, columns_inverse_ = nullptr;
};

}  // namespace

std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows) {
  return std::make_shared<FftwPlan>(nx, ny, active_rows);
}

const char* fft_library() { return "FFTW"; }

}  // namespace treadmark::kalker
