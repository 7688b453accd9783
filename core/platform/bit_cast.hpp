// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <bit>
#include <version>

namespace treadmark {

#if defined(__cpp_lib_bit_cast)
using std::bit_cast;
#else
/// The bits of an object as those of another one; by the compiler where the standard library has not got it (libc++
/// before 14).
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

}  // namespace treadmark
