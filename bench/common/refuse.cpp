// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/common/refuse.hpp"

#include <atomic>

namespace treadmark::bench {
namespace {
std::atomic<bool> refused{false};
}

void refuse(benchmark::State& state, const std::string& reason) {
  refused = true;
  state.SkipWithError(reason.c_str());
}

bool any_refused() { return refused; }

benchmark::Counter time_each(std::size_t n) {
  return {static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

}  // namespace treadmark::bench
