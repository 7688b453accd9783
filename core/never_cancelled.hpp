// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/cancellation.hpp"

namespace treadmark {

/// While it lives no work is asked to end: for what writes down results, also those of work that was interrupted.
class NeverCancelled {
 private:
  class Token final : public CancellationToken {
   public:
    bool requested() const noexcept override { return false; }
  };
  Token token_;
  CancellationScope scope_{&token_};
};

}  // namespace treadmark
