// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

namespace treadmark::kalker {

/// One transform size of one FFT library; see RealFft2d for the contract. Immutable, callable from any thread.
/// Arrays begin at cache lines (AlignedVector).
class FftPlan {
 public:
  virtual ~FftPlan() = default;
  /// Along the active rows; real is overwritten.
  virtual void rows_forward(double* real, std::complex<double>* spectrum) const = 0;
  virtual void rows_inverse(std::complex<double>* spectrum, double* real) const = 0;
  /// Along the columns of all rows, in place.
  virtual void columns_forward(std::complex<double>* spectrum) const = 0;
  virtual void columns_inverse(std::complex<double>* spectrum) const = 0;

  /// Of a large transform (has_parts) so many rows, as many as rows_of_part says or what is left over at the end.
  virtual void part_of_rows_forward(int rows, double* real, std::complex<double>* spectrum) const = 0;
  virtual void part_of_rows_inverse(int rows, std::complex<double>* spectrum, double* real) const = 0;
  /// So many columns, as many as columns_of_part says or what is left over at the end: arrays of ny numbers one after
  /// the other. `from` is overwritten. Both have room for as many as columns_of_part says, and what stands there beyond
  /// `columns` may be transformed as well.
  virtual void part_of_columns_forward(int columns, std::complex<double>* from, std::complex<double>* to) const = 0;
  virtual void part_of_columns_inverse(int columns, std::complex<double>* from, std::complex<double>* to) const = 0;
};

/// Rows or columns of a large transform are transformed in blocks of this many, on all cores; a small transform is one
/// block. The same for any number of threads. Blocks begin at cache lines.
inline int lines_of_fft_block(int lines, int nx, int ny) {
  constexpr int kLarge = 32768, kBlock = 16;  // complex numbers; lines
  return (nx / 2 + 1) * ny >= kLarge ? std::min(lines, kBlock) : lines;
}

inline int rows_of_part(int active_rows, int nx, int ny) { return lines_of_fft_block(active_rows, nx, ny); }
inline bool has_parts(int active_rows, int nx, int ny) {
  return ny > 1 && rows_of_part(active_rows, nx, ny) < active_rows;
}

/// Columns that are transformed side by side. Of large transforms few enough to stay in the cache together, and at
/// least as many as fill a cache line; of small ones always as many, so that all of a length share plans.
inline int columns_of_part(int active_rows, int nx, int ny) {
  constexpr int kFewest = 4, kNumbers = 4096, kOfSmall = 8;
  return has_parts(active_rows, nx, ny) ? std::min(nx / 2 + 1, std::max(kFewest, kNumbers / ny)) : kOfSmall;
}

/// Held while a plan is made or destroyed: libraries let only transforms run in parallel.
std::mutex& fft_planning();

/// By FFTW where it is compiled in, else by our own transforms. Calls are serialised by the caller.
std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows);
/// Our own, in every build.
std::shared_ptr<const FftPlan> make_lanes_fft_plan(int nx, int ny, int active_rows);

/// Allocates at cache-line boundaries, so that vectorised transforms always take the same code path.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
  void deallocate(T* memory, std::size_t) noexcept { ::operator delete(memory, kAlignment); }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const noexcept {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace treadmark::kalker
