// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>

namespace treadmark {

/// How long work tells its caller how far it is and learns that it should stop. All members may be empty.
struct Progress {
  /// (finished, total, what) after every finished unit; may be called from any thread, one call at a time.
  std::function<void(std::size_t, std::size_t, const std::string&)> report;
  /// Set from outside (for example a signal handler) to stop at the next check point (core/cancellation.hpp), also in
  /// the middle of a unit, whose work is lost then.
  const std::atomic<bool>* stop = nullptr;

  /// To be asked between units of work, from any thread.
  bool stop_requested() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
};

}  // namespace treadmark
