// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <kissfft/kissfft.hh>
#include <map>
#include <numbers>
#include <vector>

#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

namespace {

using Complex = std::complex<double>;

/// kissfft objects carry scratch space, so that every thread needs its own. Valid until the next call.
const kissfft<double>& thread_transform(int n, bool inverse) {
  thread_local std::map<std::pair<int, bool>, kissfft<double>> transforms;
  if (transforms.size() >= kMostFftPlans && !transforms.contains({n, inverse})) transforms.clear();
  return transforms.try_emplace({n, inverse}, static_cast<std::size_t>(n), inverse).first->second;
}

/// Rows as complex transforms of half the length (even values real, odd values imaginary).
class KissPlan final : public FftPlan {
 public:
  KissPlan(int nx, int ny, int active_rows) : half_(nx / 2), columns_(nx / 2 + 1), ny_(ny), active_rows_(active_rows) {
    for (int k = 0; k <= half_; ++k) twiddle_.push_back(std::polar(1.0, -2.0 * std::numbers::pi * k / nx));
  }

  void rows_forward(double* real, Complex* spectrum) const override {
    in_blocks(active_rows_, [&](int begin, int end) { rows_forward(begin, end, real, spectrum); });
  }
  void rows_inverse(Complex* spectrum, double* real) const override {
    in_blocks(active_rows_, [&](int begin, int end) { rows_inverse(begin, end, spectrum, real); });
  }
  void columns_forward(Complex* spectrum) const override { transform_columns(spectrum, false); }
  void columns_inverse(Complex* spectrum) const override { transform_columns(spectrum, true); }

  void part_of_rows_forward(int rows, double* real, Complex* spectrum) const override {
    rows_forward(0, rows, real, spectrum);
  }
  void part_of_rows_inverse(int rows, Complex* spectrum, double* real) const override {
    rows_inverse(0, rows, spectrum, real);
  }
  void part_of_columns_forward(int columns, Complex* from, Complex* to) const override {
    transform_lines(columns, from, to, false);
  }
  void part_of_columns_inverse(int columns, Complex* from, Complex* to) const override {
    transform_lines(columns, from, to, true);
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  template <class Body>
  void in_blocks(int lines, const Body& body) const {
    const int block = lines_of_fft_block(lines, 2 * half_, ny_);
    parallel_for(at((lines + block - 1) / block), [&](std::size_t b) {
      const int begin = static_cast<int>(b) * block;
      body(begin, std::min(lines, begin + block));
    });
  }

  void rows_forward(int begin, int end, double* real, Complex* spectrum) const {
    const auto& transform = thread_transform(half_, false);
    std::vector<Complex> packed(static_cast<std::size_t>(half_));
    for (int iy = begin; iy < end; ++iy) {
      transform.transform(reinterpret_cast<const Complex*>(real) + std::ptrdiff_t{iy} * half_, packed.data());
      Complex* row = spectrum + std::ptrdiff_t{iy} * columns_;
      for (int k = 0; k <= half_; ++k) {
        const Complex z = packed[at(k % half_)], mirrored = std::conj(packed[at((half_ - k) % half_)]);
        const Complex even = 0.5 * (z + mirrored), odd = Complex(0.0, -0.5) * (z - mirrored);
        row[k] = even + twiddle_[at(k)] * odd;
      }
    }
  }

  void rows_inverse(int begin, int end, Complex* spectrum, double* real) const {
    const auto& transform = thread_transform(half_, true);
    std::vector<Complex> packed(static_cast<std::size_t>(half_));
    for (int iy = begin; iy < end; ++iy) {
      const Complex* row = spectrum + std::ptrdiff_t{iy} * columns_;
      for (int k = 0; k < half_; ++k) {
        const Complex s = row[k], mirrored = std::conj(row[half_ - k]);
        packed[at(k)] = (s + mirrored) + Complex(0.0, 1.0) * std::conj(twiddle_[at(k)]) * (s - mirrored);
      }
      transform.transform(packed.data(), reinterpret_cast<Complex*>(real) + std::ptrdiff_t{iy} * half_);
    }
  }

  void transform_columns(Complex* spectrum, bool inverse) const {
    if (ny_ == 1) return;
    in_blocks(columns_, [&](int begin, int end) { transform_columns(begin, end, spectrum, inverse); });
  }
  void transform_columns(int begin, int end, Complex* spectrum, bool inverse) const {
    const auto& transform = thread_transform(ny_, inverse);
    std::vector<Complex> in(at(ny_)), out(at(ny_));
    for (int k = begin; k < end; ++k) {
      for (int iy = 0; iy < ny_; ++iy) in[at(iy)] = spectrum[k + std::ptrdiff_t{iy} * columns_];
      transform.transform(in.data(), out.data());
      for (int iy = 0; iy < ny_; ++iy) spectrum[k + std::ptrdiff_t{iy} * columns_] = out[at(iy)];
    }
  }

  void transform_lines(int count, const Complex* from, Complex* to, bool inverse) const {
    const auto& transform = thread_transform(ny_, inverse);
    for (std::ptrdiff_t k = 0; k < count; ++k) transform.transform(from + k * ny_, to + k * ny_);
  }

  int half_, columns_, ny_, active_rows_;
  std::vector<Complex> twiddle_;
};

}  // namespace

std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows) {
  return std::make_shared<KissPlan>(nx, ny, active_rows);
}

const char* fft_library() { return "KISS FFT"; }

}  // namespace treadmark::kalker
