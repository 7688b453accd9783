// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/kernel.hpp"

namespace treadmark {

/// Every table of a kernel that this machine runs.
template <class Table>
std::vector<const Table*> all_kernels() {
  std::vector<const Table*> all{&Table::generic};
  if (avx2_kernel<Table>() != nullptr) all.push_back(avx2_kernel<Table>());
  return all;
}

}  // namespace treadmark
