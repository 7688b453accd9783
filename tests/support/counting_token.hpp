// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <atomic>
#include <limits>

#include "treadmark/core/cancellation.hpp"

namespace treadmark::testing {

/// Asks for the end at a certain check point, and counts those that are passed.
class CountingToken final : public CancellationToken {
 public:
  explicit CountingToken(long last = std::numeric_limits<long>::max()) : last_(last) {}

  bool requested() const noexcept override { return ++passed_ >= last_; }
  long passed() const { return passed_; }

 private:
  long last_;
  mutable std::atomic<long> passed_{0};
};

}  // namespace treadmark::testing
