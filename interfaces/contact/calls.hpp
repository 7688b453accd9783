// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

#include "treadmark/interfaces/contact/problem.hpp"

namespace treadmark::contact {

/// A call that cannot be answered: code for ierror, and the line of the log.
struct Refusal {
  int code;
  std::string message;
};

/// Codes of misuse, as CONTACT has them.
enum Misuse {
  bad_element = -101,
  not_for_rail = -102,
  not_for_basic = -103,
  bad_patch = -104,
  no_patch = -105,
  not_of_patch = -106
};

/// Which problems a function is for.
enum class For {
  basic,       ///< module 3, patch 1 to 9
  rail,        ///< module 1, without a patch
  rail_patch,  ///< module 1, a patch
  rail_any,    ///< module 1, a patch or the whole
  whole,       ///< module 1 as a whole, or module 3
  patch,       ///< a patch of either
  any,         ///< module 1 as a whole, or a patch of either
};

/// The problem that a call is about, locked.
struct Active {
  std::shared_ptr<Problem> keeper;
  std::unique_lock<std::mutex> lock;
  Problem& problem;
  int patch;  ///< from 0; -1: the whole wheel

  /// Of the patch. Refusal where there is none.
  const io::PatchResult& result() const;
};

/// Errors: Refusal. lock false: the problem is not locked.
Active activate(const int* ire, const int* icp, For what, bool lock = true);

/// Logs the exception that is being handled and gives its code.
int caught(const char* function) noexcept;

/// Runs a body; no exception gets past it. ierror, if not null, gets the code.
template <class Body>
void guarded(const char* function, int* ierror, Body&& body) noexcept {
  try {
    body();
  } catch (...) {
    const int code = caught(function);
    if (ierror != nullptr) *ierror = code;
  }
}

/// Calls body(Active&).
template <class Body>
void on_problem(const char* function, const int* ire, const int* icp, For what, Body&& body) noexcept {
  guarded(function, nullptr, [&] {
    Active active = activate(ire, icp, what);
    body(active);
  });
}

inline constexpr int kWholeWheel = -1;

/// What a caller gives. Errors: Refusal for null pointers and negative lengths.
template <class T>
const T& need(const T* given, const char* name) {
  if (given == nullptr) throw Refusal{CNTC_err_icp, std::string("the argument ") + name + " is a null pointer"};
  return *given;
}
template <class T>
std::span<T> array(T* values, const int* count, const char* name) {
  const int n = need(count, name);
  if (n < 0) throw Refusal{CNTC_err_icp, std::string("the length of ") + name + " is negative"};
  if (n > 0) need(values, name);
  return {values, static_cast<std::size_t>(n)};
}
/// The same where a null pointer means "not wanted".
template <class T>
std::span<T> room(T* values, const int* count, const char* name) {
  const int n = need(count, name);
  if (n < 0) throw Refusal{CNTC_err_icp, std::string("the length of ") + name + " is negative"};
  return {values, values == nullptr ? 0 : static_cast<std::size_t>(n)};
}
/// A finite number. Errors: Refusal.
double number(const double* given, const char* name);
void require_finite(std::span<const double> values, const char* name);
/// Without blanks at its end.
std::string text(const char* bytes, const int* length, const char* name);

template <class T>
void put(T* out, T value) {
  if (out != nullptr) *out = value;
}
/// As many as there is room for.
template <class Values, class T>
void fill(std::span<T> out, const Values& values) {
  for (std::size_t i = 0; i < out.size() && i < std::size(values); ++i) out[i] = static_cast<T>(values[i]);
}

/// The library as a whole.
struct Folders {
  std::string work, out, name;  ///< folders end with '/', or are empty
};
Folders folders();
/// What is asked for before the library was started; starts it with default folders.
void start_if_needed();
/// Codes and values of flags that belong to no problem; 0 is passed over, what is no such flag is warned about.
void set_global_flags(std::span<const int> codes, std::span<const int> values);

}  // namespace treadmark::contact
