// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/core/report.hpp"
#include "treadmark/interfaces/c/treadmark.h"

namespace treadmark::c {

/// Thrown for what a caller in C can do wrong: TM_BAD_ARGUMENT.
struct BadArgument {
  const char* what;
};

inline void require(bool right, const char* what) {
  if (!right) throw BadArgument{what};
}

/// Keeps the message of the exception that is being handled, for tm_message(), and gives its status. Takes no memory.
tm_status caught() noexcept;

/// From now on what calls of this thread catch is kept there too, as it was: for interfaces that have exceptions. Null:
/// no longer. Returns where it was kept before.
std::exception_ptr* keep_caught(std::exception_ptr* where) noexcept;

/// Runs the body of a call under the thread's cancel flag: no exception gets past it.
tm_status guarded_call(void (*body)(void*), void* data) noexcept;

template <class Body>
tm_status guarded(Body&& body) noexcept {
  return guarded_call([](void* data) { (*static_cast<std::remove_reference_t<Body>*>(data))(); }, &body);
}

/// The same for a call that makes an object: *out is null unless all went well.
template <class Handle, class Make>
tm_status make(Handle** out, Make&& how) noexcept {
  if (out != nullptr) *out = nullptr;
  return guarded([&] {
    require(out != nullptr, "out must not be null");
    *out = how().release();
  });
}

/// How a computation ended.
tm_status status_of(Status status) noexcept;

/// Calls the function of tm_set_progress, within guarded() on its thread. No member stop: the function's wish to end
/// reaches the work as the cancel flag does.
Progress callers_progress();

/// The texts of an array that came from a caller.
std::vector<std::string> texts_of(const char* const* texts, std::size_t n, const char* what);
/// A copy for tm_text_free.
char* lasting(const std::string& text);

}  // namespace treadmark::c
