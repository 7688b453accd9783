// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cfenv>

namespace treadmark::testing {

/// While it lives, infinities of this thread are meant: the trap preset (floating_traps.cpp) lets them pass.
class MeantOverflow {
 public:
  MeantOverflow() : trapped_(fegetexcept() & (FE_DIVBYZERO | FE_OVERFLOW)) { fedisableexcept(trapped_); }
  ~MeantOverflow() {
    std::feclearexcept(trapped_);
    feenableexcept(trapped_);
  }
  MeantOverflow(const MeantOverflow&) = delete;
  MeantOverflow& operator=(const MeantOverflow&) = delete;

 private:
  int trapped_;
};

}  // namespace treadmark::testing
