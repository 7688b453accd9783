// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <version>

#if defined(__cpp_lib_ranges)
namespace treadmark {
/// The algorithms of the standard library over ranges, or our own where it has none (libc++ before 16). Everything
/// else asks for them here.
namespace ranges = std::ranges;
}  // namespace treadmark
#else
#include "treadmark/core/platform/own_ranges.hpp"
namespace treadmark {
namespace ranges = own_ranges;
}  // namespace treadmark
#endif
