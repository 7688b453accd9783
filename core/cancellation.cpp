// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/cancellation.hpp"

namespace treadmark {

namespace {

thread_local const CancellationToken* cancellation_that_holds = nullptr;

}  // namespace

const char* Cancelled::what() const noexcept { return "the work was interrupted"; }

CancellationScope::CancellationScope(const CancellationToken* token) noexcept
    : flag_(nullptr), before_(cancellation_that_holds) {
  if (token != nullptr) cancellation_that_holds = token;
}

CancellationScope::CancellationScope(const std::atomic<bool>* flag) noexcept
    : flag_(flag), before_(cancellation_that_holds) {
  if (flag != nullptr) cancellation_that_holds = &flag_;
}

CancellationScope::~CancellationScope() { cancellation_that_holds = before_; }

const CancellationToken* current_cancellation() noexcept { return cancellation_that_holds; }

void check_cancelled() {
  if (cancellation_that_holds != nullptr && cancellation_that_holds->requested()) throw Cancelled();
}

}  // namespace treadmark
