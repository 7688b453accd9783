// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <atomic>
#include <exception>

namespace treadmark {

/// Thrown where work ends early because its caller asked for it. No Error: nothing is wrong, and what takes errors for
/// the failure of one case must not take this for it. Solvers that were at work need reset() or restore() before they
/// are used again; what is stored elsewhere stays whole.
class Cancelled : public std::exception {
 public:
  /// "the work was interrupted"
  const char* what() const noexcept override;
};

/// Says whether work is to end.
class CancellationToken {
 public:
  virtual ~CancellationToken() = default;
  /// Asked at check points, from any thread and several at a time: must be fast.
  virtual bool requested() const noexcept = 0;
};

/// While it lives, work of the thread that made it can be cancelled, and what that work does in parallel_for on any
/// thread. Of several scopes the innermost one holds. Must end on the thread that made it.
class CancellationScope {
 public:
  /// The token must outlive the scope; nullptr leaves what holds.
  explicit CancellationScope(const CancellationToken* token) noexcept;
  /// Work ends once the flag is set, for example by a handler of signals; as with a token.
  explicit CancellationScope(const std::atomic<bool>* flag) noexcept;
  ~CancellationScope();
  CancellationScope(const CancellationScope&) = delete;
  CancellationScope& operator=(const CancellationScope&) = delete;

 private:
  class Flag final : public CancellationToken {
   public:
    explicit Flag(const std::atomic<bool>* flag) : flag_(flag) {}
    bool requested() const noexcept override { return flag_->load(std::memory_order_relaxed); }

   private:
    const std::atomic<bool>* flag_;
  };

  Flag flag_;
  const CancellationToken* before_;
};

/// What holds for this thread; nullptr: nothing.
const CancellationToken* current_cancellation() noexcept;

/// A check point: throws Cancelled where the scope that holds for this thread asks for it. Thread-safe. Costs some
/// nanoseconds: long loops call it once a row, an iteration or a step, and parallel_for before each call of its body.
/// From the request to the end pass fractions of a second (one product with the matrix of a contact at most).
void check_cancelled();

}  // namespace treadmark
