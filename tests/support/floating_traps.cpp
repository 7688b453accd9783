// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Linked into the tests of the trap preset: what gives an infinity is a signal (SIGFPE) where it happens. Threads
// inherit it from the one that starts them. Invalid operations stay quiet, as ordered comparisons with NaN, which
// stands for a missing surface, are such.
#include <cfenv>

namespace {
[[maybe_unused]] const int kBefore = feenableexcept(FE_DIVBYZERO | FE_OVERFLOW);
}  // namespace
