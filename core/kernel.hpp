// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/cpu.hpp"

namespace treadmark {

/// Kernels that gain from AVX2 and FMA are compiled twice from one header, for every machine and with these
/// instructions: treadmark_kernels() in the CMakeLists.txt of its folder names it. A kernel is a table of functions,
///
///     struct TileKernel {
///       bool (*fill)(...);
///       static const TileKernel generic;
///       static const TileKernel* const avx2;  ///< nullptr if this build has none
///     };
///
/// and its header ends with TREADMARK_KERNEL(TileKernel, fill_tile), outside the namespace without a name that holds
/// everything else. Neither the header nor what it includes has inline functions of external linkage (std::vector ...):
/// the linker might keep the copy that other processors cannot run. Results of the two differ by rounding only.
#if defined(TREADMARK_AVX2_KERNELS)
#define TREADMARK_KERNEL_MEMBERS(Table, table) const Table* const Table::avx2 = &table
#elif defined(TREADMARK_NO_AVX2_KERNELS)
#define TREADMARK_KERNEL_MEMBERS(Table, table) \
  const Table Table::generic = table;          \
  const Table* const Table::avx2 = nullptr
#else
#define TREADMARK_KERNEL_MEMBERS(Table, table) const Table Table::generic = table
#endif
#define TREADMARK_KERNEL(Table, ...)        \
  namespace {                               \
  constexpr Table k##Table##_{__VA_ARGS__}; \
  }                                         \
  TREADMARK_KERNEL_MEMBERS(Table, k##Table##_)

/// The table for AVX2; nullptr if this build or this processor has none.
template <class Table>
const Table* avx2_kernel() {
  return cpu_has_avx2() ? Table::avx2 : nullptr;
}

/// The fastest that this machine runs. Thread-safe.
template <class Table>
const Table& fastest_kernel() {
  static const Table& fastest = avx2_kernel<Table>() != nullptr ? *avx2_kernel<Table>() : Table::generic;
  return fastest;
}

}  // namespace treadmark
