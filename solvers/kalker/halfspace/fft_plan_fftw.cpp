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
    for (int unaligned = 0; unaligned < 2; ++unaligned) {
      const unsigned flags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT | (unaligned ? FFTW_UNALIGNED : 0u);
      Set& set = sets_[unaligned];
      set.rows_forward = fftw_plan_many_dft_r2c(1, &nx, active_rows, real.data(), nullptr, 1, nx, raw(spectrum.data()),
                                                nullptr, 1, columns_, flags);
      set.rows_inverse = fftw_plan_many_dft_c2r(1, &nx, active_rows, raw(spectrum.data()), nullptr, 1, columns_,
                                                real.data(), nullptr, 1, nx, flags);
      if (!set.rows_forward || !set.rows_inverse) throw std::bad_alloc();
      if (ny == 1) continue;
      set.columns_forward = column_plan(ny, spectrum.data(), FFTW_FORWARD, flags);
      set.columns_inverse = column_plan(ny, spectrum.data(), FFTW_BACKWARD, flags);
      if (!set.columns_forward || !set.columns_inverse) throw std::bad_alloc();
    }
  }
  ~FftwPlan() override {
    for (Set& set : sets_)
      for (fftw_plan plan : {set.rows_forward, set.columns_forward, set.rows_inverse, set.columns_inverse})
        if (plan) fftw_destroy_plan(plan);
  }
  FftwPlan(const FftwPlan&) = delete;
  FftwPlan& operator=(const FftwPlan&) = delete;

  void forward(double* real, std::complex<double>* spectrum) const override {
    const Set& set = set_for(real, spectrum);
    std::fill(spectrum + first_inactive_, spectrum + end_, std::complex<double>());
    fftw_execute_dft_r2c(set.rows_forward, real, raw(spectrum));
    if (set.columns_forward) fftw_execute_dft(set.columns_forward, raw(spectrum), raw(spectrum));
  }
  void inverse(std::complex<double>* spectrum, double* real) const override {
    const Set& set = set_for(real, spectrum);
    if (set.columns_inverse) fftw_execute_dft(set.columns_inverse, raw(spectrum), raw(spectrum));
    fftw_execute_dft_c2r(set.rows_inverse, raw(spectrum), real);
  }

 private:
  struct Set {
    fftw_plan rows_forward = nullptr, columns_forward = nullptr, rows_inverse = nullptr, columns_inverse = nullptr;
  };

  fftw_plan column_plan(int ny, std::complex<double>* data, int sign, unsigned flags) const {
    return fftw_plan_many_dft(1, &ny, columns_, raw(data), nullptr, columns_, 1, raw(data), nullptr, columns_, 1, sign,
                              flags);
  }
  const Set& set_for(double* real, std::complex<double>* spectrum) const {
    const bool aligned =
        fftw_alignment_of(real) == 0 && fftw_alignment_of(reinterpret_cast<double*>(spectrum)) == 0;
    return sets_[aligned ? 0 : 1];
  }

  Set sets_[2];
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
