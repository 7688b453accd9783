// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/fft2d.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

std::mutex& fft_planning() {
  static std::mutex planning;
  return planning;
}

namespace {

struct KeptPlan {
  std::shared_ptr<const FftPlan> plan;
  std::uint64_t asked = 0;  ///< when for the last time
};

std::map<std::array<int, 3>, KeptPlan>& kept_plans() {
  static std::map<std::array<int, 3>, KeptPlan> plans;
  return plans;
}

/// Whoever lets go of it last, it is destroyed under the lock.
std::shared_ptr<const FftPlan> destroyed_alone(std::shared_ptr<const FftPlan> plan) {
  const FftPlan* where = plan.get();
  return {where, [plan = std::move(plan)](const FftPlan*) mutable {
            const std::lock_guard lock(fft_planning());
            plan.reset();
          }};
}

/// Making plans costs milliseconds: the sizes asked for last are kept for the whole process.
std::shared_ptr<const FftPlan> shared_plan(int nx, int ny, int active_rows) {
  static std::uint64_t asked = 0;
  std::shared_ptr<const FftPlan> dropped;  // outlives the lock
  const std::lock_guard lock(fft_planning());
  auto& plans = kept_plans();
  KeptPlan& kept = plans[{nx, ny, active_rows}];
  kept.asked = ++asked;
  if (!kept.plan) kept.plan = destroyed_alone(make_fft_plan(nx, ny, active_rows));
  if (plans.size() > kMostFftPlans) {
    const auto oldest = std::min_element(plans.begin(), plans.end(), [](const auto& one, const auto& other) {
      return one.second.asked < other.second.asked;
    });
    dropped = std::move(oldest->second.plan);
    plans.erase(oldest);
  }
  return kept.plan;
}

bool is_aligned(const void* memory) {
  return reinterpret_cast<std::uintptr_t>(memory) % static_cast<std::size_t>(AlignedAllocator<double>::kAlignment) == 0;
}

bool has_only_small_factors(int n) {
  for (const int factor : {2, 3, 5, 7})
    while (n > 0 && n % factor == 0) n /= factor;
  return n == 1;
}

}  // namespace

std::size_t fft_plans() {
  const std::lock_guard lock(fft_planning());
  return kept_plans().size();
}

RealFft2d::RealFft2d(int nx, int ny) : RealFft2d(nx, ny, ny) {}

RealFft2d::RealFft2d(int nx, int ny, int active_rows) : nx_(nx), ny_(ny), active_rows_(active_rows) {
  if (nx < 2 || nx % 2 != 0 || ny < 1 || active_rows < 1 || active_rows > ny)
    throw Error(ErrorKind::configuration,
                "a Fourier transform of " + std::to_string(nx) + " x " + std::to_string(ny) + " values with " +
                    std::to_string(active_rows) + " active rows",
                {}, "nx must be even and positive, 1 <= active_rows <= ny");
  plan_ = shared_plan(nx, ny, active_rows);
  large_ = has_parts(active_rows, nx, ny);
}

namespace {

void check_sizes(bool fit) {
  if (!fit) throw Error(ErrorKind::configuration, "arrays of a Fourier transform have the wrong size");
}

void check_aligned(const void* memory) {
  if (!is_aligned(memory))
    throw Error(ErrorKind::configuration, "an array of a Fourier transform does not begin at a cache line");
}

}  // namespace

void RealFft2d::forward(std::span<double> real, std::span<std::complex<double>> spectrum) const {
  check_sizes(real.size() == real_size() && spectrum.size() == spectrum_size());
  if (!is_aligned(real.data()) || !is_aligned(spectrum.data())) {
    AlignedVector<double> aligned_real(real.begin(), real.end());
    AlignedVector<std::complex<double>> aligned_spectrum(spectrum.size());
    forward(aligned_real, aligned_spectrum);
    std::copy(aligned_spectrum.begin(), aligned_spectrum.end(), spectrum.begin());
    return;
  }
  clear(spectrum.subspan(rows_size()));
  plan_->rows_forward(real.data(), spectrum.data());
  plan_->columns_forward(spectrum.data());
}

void RealFft2d::inverse(std::span<std::complex<double>> spectrum, std::span<double> real) const {
  check_sizes(real.size() == real_size() && spectrum.size() == spectrum_size());
  if (!is_aligned(real.data()) || !is_aligned(spectrum.data())) {
    AlignedVector<double> aligned_real(real.size());
    AlignedVector<std::complex<double>> aligned_spectrum(spectrum.begin(), spectrum.end());
    inverse(aligned_spectrum, aligned_real);
    std::copy(aligned_real.begin(), aligned_real.end(), real.begin());
    return;
  }
  plan_->columns_inverse(spectrum.data());
  plan_->rows_inverse(spectrum.data(), real.data());
}

void RealFft2d::forward_rows(std::span<double> real, std::span<std::complex<double>> rows) const {
  check_sizes(real.size() == real_size() && rows.size() == rows_size());
  check_aligned(real.data());
  check_aligned(rows.data());
  plan_->rows_forward(real.data(), rows.data());
}

void RealFft2d::inverse_rows(std::span<std::complex<double>> rows, std::span<double> real) const {
  check_sizes(real.size() == real_size() && rows.size() == rows_size());
  check_aligned(real.data());
  check_aligned(rows.data());
  plan_->rows_inverse(rows.data(), real.data());
}

void RealFft2d::forward_columns(std::span<std::complex<double>> spectrum) const {
  check_sizes(spectrum.size() == spectrum_size());
  check_aligned(spectrum.data());
  plan_->columns_forward(spectrum.data());
}

void RealFft2d::inverse_columns(std::span<std::complex<double>> spectrum) const {
  check_sizes(spectrum.size() == spectrum_size());
  check_aligned(spectrum.data());
  plan_->columns_inverse(spectrum.data());
}

namespace {

using Complex = std::complex<double>;

/// Memory of the calling thread; kept, because allocation would cost as much as a small transform.
template <class Value, int tag>
Value* kept_memory(std::size_t size) {
  thread_local AlignedVector<Value> memory;
  if (memory.size() < size) memory.resize(size);
  return memory.data();
}
enum KeptMemory { kRealRows, kSpectra, kColumns };

/// body(first, count) for parts of the lines.
template <class Body>
void for_parts(int lines, int of_part, const Body& body) {
  parallel_for(static_cast<std::size_t>((lines + of_part - 1) / of_part), [&](std::size_t part) {
    const int first = static_cast<int>(part) * of_part;
    body(first, std::min(of_part, lines - first));
  });
}

std::size_t area(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

}  // namespace

void RealFft2d::multiply(std::span<const LoadRows> load, const Line& factor, std::span<const StoreRows> store) const {
  check_sizes(load.size() <= kMostFields && (store.empty() || store.size() == load.size()));
  lines_are_columns() ? multiply_columns(load, factor, store) : multiply_rows(load, factor, store);
}

void RealFft2d::lines_of(const LoadRows& load, const Line& take) const { multiply({&load, 1}, take, {}); }

/// A single row.
void RealFft2d::multiply_rows(std::span<const LoadRows> load, const Line& factor,
                              std::span<const StoreRows> store) const {
  double* real = kept_memory<double, kRealRows>(real_size());
  const std::size_t apart = (spectrum_size() + 3) / 4 * 4;  // every spectrum begins at a cache line
  Complex* memory = kept_memory<Complex, kSpectra>(load.size() * apart);
  std::array<Complex*, kMostFields> spectra{};
  for (std::size_t f = 0; f < load.size(); ++f) {
    spectra[f] = memory + f * apart;
    load[f](0, 1, real);
    plan_->rows_forward(real, spectra[f]);
  }
  factor(0, spectra.data());
  for (std::size_t f = 0; f < store.size(); ++f) {
    plan_->rows_inverse(spectra[f], real);
    store[f](0, 1, real);
  }
}

void RealFft2d::rows_forward(const LoadRows& load, Complex* rows) const {
  const std::size_t width = static_cast<std::size_t>(nx_ / 2 + 1);
  if (!large_) {
    double* real = kept_memory<double, kRealRows>(real_size());
    load(0, active_rows_, real);
    return plan_->rows_forward(real, rows);
  }
  const int of_rows = rows_of_part(active_rows_, nx_, ny_);
  for_parts(active_rows_, of_rows, [&](int first, int count) {
    double* real = kept_memory<double, kRealRows>(area(of_rows, nx_));
    load(first, count, real);
    plan_->part_of_rows_forward(count, real, rows + static_cast<std::size_t>(first) * width);
  });
}

void RealFft2d::rows_inverse(Complex* rows, const StoreRows& store) const {
  const std::size_t width = static_cast<std::size_t>(nx_ / 2 + 1);
  if (!large_) {
    double* real = kept_memory<double, kRealRows>(real_size());
    plan_->rows_inverse(rows, real);
    return store(0, active_rows_, real);
  }
  const int of_rows = rows_of_part(active_rows_, nx_, ny_);
  for_parts(active_rows_, of_rows, [&](int first, int count) {
    double* real = kept_memory<double, kRealRows>(area(of_rows, nx_));
    plan_->part_of_rows_inverse(count, rows + static_cast<std::size_t>(first) * width, real);
    store(first, count, real);
  });
}

/// What is zero before and not wanted after the transform along columns, the rows that are not active, exists for a few
/// columns at a time only.
void RealFft2d::multiply_columns(std::span<const LoadRows> load, const Line& factor,
                                 std::span<const StoreRows> store) const {
  const int width = nx_ / 2 + 1, of_columns = columns_of_part(active_rows_, nx_, ny_);
  const std::size_t apart = (rows_size() + 3) / 4 * 4, size = (area(of_columns, ny_) + 3) / 4 * 4;
  const auto length = static_cast<std::size_t>(ny_), active = static_cast<std::size_t>(active_rows_);
  Complex* rows = kept_memory<Complex, kSpectra>(load.size() * apart);
  for (std::size_t f = 0; f < load.size(); ++f) rows_forward(load[f], rows + f * apart);
  const auto part = [&](int first, int count) {
    Complex* memory = kept_memory<Complex, kColumns>((1 + load.size()) * size);
    Complex* before = memory;  // a field's columns, which its spectrum has not seen or has seen already
    const auto columns = static_cast<std::size_t>(count);
    std::array<Complex*, kMostFields> values{};
    for (std::size_t f = 0; f < load.size(); ++f) {
      values[f] = memory + (f + 1) * size;
      const Complex* from = rows + f * apart + first;
      for (std::size_t iy = 0; iy < active; ++iy, from += width)
        for (std::size_t k = 0; k < columns; ++k) before[k * length + iy] = from[k];
      for (std::size_t k = 0; k < columns; ++k)
        std::fill(before + k * length + active, before + (k + 1) * length, Complex());
      if (!large_) std::fill(before + columns * length, before + area(of_columns, ny_), Complex());
      plan_->part_of_columns_forward(count, before, values[f]);
    }
    for (std::size_t k = 0; k < columns; ++k) {
      std::array<Complex*, kMostFields> line{};
      for (std::size_t f = 0; f < load.size(); ++f) line[f] = values[f] + k * length;
      factor(first + static_cast<int>(k), line.data());
    }
    for (std::size_t f = 0; f < store.size(); ++f) {
      plan_->part_of_columns_inverse(count, values[f], before);
      Complex* to = rows + f * apart + first;
      for (std::size_t iy = 0; iy < active; ++iy, to += width)
        for (std::size_t k = 0; k < columns; ++k) to[k] = before[k * length + iy];
    }
  };
  if (large_)
    for_parts(width, of_columns, part);
  else
    for (int first = 0; first < width; first += of_columns) part(first, std::min(of_columns, width - first));
  for (std::size_t f = 0; f < store.size(); ++f) rows_inverse(rows + f * apart, store[f]);
}

int good_fft_size(int n) {
  int size = n < 2 ? 2 : n + n % 2;
  while (!has_only_small_factors(size)) size += 2;
  const int power = static_cast<int>(std::bit_ceil(static_cast<unsigned>(size)));
  return 5 * power <= 6 * size ? power : size;
}

int roomy_columns(int n) { return n <= 1 ? 1 : good_fft_size(2 * n - 1) / 2; }

int roomy_rows(int n) {
  // Padded as far as fast_columns does, a row more costs one transform along it.
  constexpr int kStep = 4, kFewest = 9, kMost = 64;
  return n < kFewest || n > kMost ? roomy_columns(n) : (n + kStep - 1) / kStep * kStep;
}

int fast_columns(int ny) {
  constexpr int kSmallest = 32, kLargest = 128;
  const int power = static_cast<int>(std::bit_ceil(static_cast<unsigned>(ny)));
  return power >= kSmallest && power <= kLargest ? power : ny;
}

}  // namespace treadmark::kalker
