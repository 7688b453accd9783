// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <charconv>
#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#include "treadmark/core/platform/own_from_chars.hpp"
namespace treadmark {
using platform::from_chars;
}
#endif

namespace treadmark {
/// Numbers at the beginning of a text. Doubles by our own function where the standard library has none (libc++ before
/// 20).
using std::from_chars;
}  // namespace treadmark
