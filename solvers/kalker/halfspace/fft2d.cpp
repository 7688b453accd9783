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

namespace {

/// Held while a plan is made or destroyed: libraries let only transforms run in parallel.
std::mutex planning;

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
            const std::lock_guard lock(planning);
            plan.reset();
          }};
}

/// Making plans costs milliseconds: the sizes asked for last are kept for the whole process.
std::shared_ptr<const FftPlan> shared_plan(int nx, int ny, int active_rows) {
  static std::uint64_t asked = 0;
  std::shared_ptr<const FftPlan> dropped;  // outlives the lock
  const std::lock_guard lock(planning);
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
  const std::lock_guard lock(planning);
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
  by_columns_ = has_parts(active_rows, nx, ny);
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

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

}  // namespace

void RealFft2d::multiply(std::span<const LoadRows> load, const Line& factor, std::span<const StoreRows> store) const {
  check_sizes(load.size() <= kMostFields && (store.empty() || store.size() == load.size()));
  by_columns_ ? multiply_in_parts(load, factor, store) : multiply_whole(load, factor, store);
}

void RealFft2d::lines_of(const LoadRows& load, const Line& take) const { multiply({&load, 1}, take, {}); }

void RealFft2d::multiply_whole(std::span<const LoadRows> load, const Line& factor,
                               std::span<const StoreRows> store) const {
  double* real = kept_memory<double, kRealRows>(real_size());
  Complex* memory = kept_memory<Complex, kSpectra>(load.size() * (spectrum_size() + 4));
  // every spectrum begins at a cache line
  const std::size_t apart = (spectrum_size() + 3) / 4 * 4;
  std::array<Complex*, kMostFields> spectra{};
  for (std::size_t f = 0; f < load.size(); ++f) {
    spectra[f] = memory + f * apart;
    load[f](0, active_rows_, real);
    plan_->rows_forward(real, spectra[f]);
    std::fill(spectra[f] + rows_size(), spectra[f] + spectrum_size(), Complex());
    plan_->columns_forward(spectra[f]);
  }
  for (int line = 0; line < ny_; ++line) {
    std::array<Complex*, kMostFields> values{};
    for (std::size_t f = 0; f < load.size(); ++f) values[f] = spectra[f] + place(0, line);
    factor(line, values.data());
  }
  for (std::size_t f = 0; f < store.size(); ++f) {
    plan_->columns_inverse(spectra[f]);
    plan_->rows_inverse(spectra[f], real);
    store[f](0, active_rows_, real);
  }
}

/// What is zero before and not wanted after the transform along columns, the rows that are not active, exists for a few
/// columns at a time only.
void RealFft2d::multiply_in_parts(std::span<const LoadRows> load, const Line& factor,
                                  std::span<const StoreRows> store) const {
  const int width = nx_ / 2 + 1, of_rows = rows_of_part(active_rows_, nx_, ny_), of_columns = columns_of_part(nx_, ny_);
  const std::size_t apart = (rows_size() + 3) / 4 * 4;
  Complex* rows = kept_memory<Complex, kSpectra>(load.size() * apart);
  for (std::size_t f = 0; f < load.size(); ++f)
    for_parts(active_rows_, of_rows, [&](int first, int count) {
      double* real = kept_memory<double, kRealRows>(product(of_rows, nx_));
      load[f](first, count, real);
      plan_->part_of_rows_forward(count, real, rows + f * apart + product(first, width));
    });
  for_parts(width, of_columns, [&](int first, int count) {
    const std::size_t size = (product(count, ny_) + 3) / 4 * 4;
    Complex* memory = kept_memory<Complex, kColumns>((1 + load.size()) * ((product(of_columns, ny_) + 3) / 4 * 4));
    Complex* before = memory;  // a field's columns, which its spectrum has not seen or has seen already
    std::array<Complex*, kMostFields> values{};
    for (std::size_t f = 0; f < load.size(); ++f) {
      values[f] = memory + (f + 1) * size;
      const Complex* from = rows + f * apart + first;
      for (int iy = 0; iy < active_rows_; ++iy, from += width)
        for (int k = 0; k < count; ++k) before[product(k, ny_) + static_cast<std::size_t>(iy)] = from[k];
      for (int k = 0; k < count; ++k)
        std::fill(before + product(k, ny_) + static_cast<std::size_t>(active_rows_), before + product(k + 1, ny_),
                  Complex());
      plan_->part_of_columns_forward(count, before, values[f]);
    }
    for (int k = 0; k < count; ++k) {
      std::array<Complex*, kMostFields> line{};
      for (std::size_t f = 0; f < load.size(); ++f) line[f] = values[f] + product(k, ny_);
      factor(first + k, line.data());
    }
    for (std::size_t f = 0; f < store.size(); ++f) {
      plan_->part_of_columns_inverse(count, values[f], before);
      Complex* to = rows + f * apart + first;
      for (int iy = 0; iy < active_rows_; ++iy, to += width)
        for (int k = 0; k < count; ++k) to[k] = before[product(k, ny_) + static_cast<std::size_t>(iy)];
    }
  });
  for (std::size_t f = 0; f < store.size(); ++f)
    for_parts(active_rows_, of_rows, [&](int first, int count) {
      double* real = kept_memory<double, kRealRows>(product(of_rows, nx_));
      plan_->part_of_rows_inverse(count, rows + f * apart + product(first, width), real);
      store[f](first, count, real);
    });
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
