// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <functional>

#include "treadmark/core/cancellation.hpp"

namespace treadmark {

/// check_cancelled for loops over millions of things that take nanoseconds each: asks at every 4096th pass. One object,
/// one thread.
class CheckPoint {
 public:
  void pass() {
    constexpr unsigned kSeldom = 4096;
    if (++passed_ % kSeldom == 0) check_cancelled();
  }

 private:
  unsigned passed_ = 0;
};

/// std::sort of many values that can be cancelled, which leaves them in no order.
template <class Values, class Less = std::less<>>
void sort_many(Values& values, Less less = {}) {
  CheckPoint check;
  std::sort(values.begin(), values.end(), [&check, &less](const auto& a, const auto& b) {
    check.pass();
    return less(a, b);
  });
}

}  // namespace treadmark
