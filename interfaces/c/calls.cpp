// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/c/calls.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "treadmark/app/version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::c {
namespace {

constexpr std::size_t kLongest = 2048;
thread_local char message[kLongest] = "";
thread_local const volatile int* cancel_flag = nullptr;
thread_local tm_progress progress_function = nullptr;
thread_local void* progress_user = nullptr;
thread_local std::exception_ptr* kept = nullptr;

void keep(const char* text) noexcept {
  const std::size_t size = std::min(std::strlen(text), kLongest - 1);
  std::memcpy(message, text, size);
  message[size] = '\0';
}

/// Whether the thread that made it wants the end of its call, asked from any thread: by its flag, or since its
/// function of progress said so.
class CallersWish final : public CancellationToken {
 public:
  CallersWish() { current = this; }
  ~CallersWish() override { current = before_; }
  CallersWish(const CallersWish&) = delete;
  CallersWish& operator=(const CallersWish&) = delete;

  bool requested() const noexcept override {
    return (flag_ != nullptr && __atomic_load_n(flag_, __ATOMIC_RELAXED) != 0) ||
           given_up_.load(std::memory_order_relaxed);
  }
  void give_up() { given_up_ = true; }

  static thread_local CallersWish* current;  ///< of the call that this thread is in

 private:
  const volatile int* flag_ = cancel_flag;
  CallersWish* before_ = current;
  std::atomic<bool> given_up_{false};
};
thread_local CallersWish* CallersWish::current = nullptr;

struct StatusName {
  tm_status status;
  const char* name;
};
constexpr StatusName kStatusNames[] = {{TM_OK, "ok"},
                                       {TM_NO_CONTACT, "no_contact"},
                                       {TM_NOT_CONVERGED, "not_converged"},
                                       {TM_FAILED, "failed"},
                                       {TM_BAD_ARGUMENT, "bad_argument"},
                                       {TM_BAD_REQUEST, "bad_request"},
                                       {TM_BAD_INPUT, "bad_input"},
                                       {TM_NUMERICAL, "numerical"},
                                       {TM_CANCELLED, "cancelled"},
                                       {TM_OUT_OF_MEMORY, "out_of_memory"},
                                       {TM_INTERNAL, "internal"}};

tm_status status_of(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::configuration:
      return TM_BAD_REQUEST;
    case ErrorKind::input_data:
      return TM_BAD_INPUT;
    case ErrorKind::numerical:
      return TM_NUMERICAL;
  }
  return TM_INTERNAL;
}

}  // namespace

std::exception_ptr* keep_caught(std::exception_ptr* where) noexcept { return std::exchange(kept, where); }

tm_status caught() noexcept {
  if (kept != nullptr) *kept = std::current_exception();
  try {
    throw;
  } catch (const BadArgument& wrong) {
    keep(wrong.what);
    return TM_BAD_ARGUMENT;
  } catch (const Error& error) {
    keep(error.what());
    return status_of(error.kind());
  } catch (const Cancelled& end) {
    keep(end.what());
    return TM_CANCELLED;
  } catch (const std::filesystem::filesystem_error& error) {
    keep(error.what());
    return TM_BAD_REQUEST;
  } catch (const std::bad_alloc&) {
    keep("there is not enough memory");
    return TM_OUT_OF_MEMORY;
  } catch (const std::length_error&) {
    keep("there is not enough memory");
    return TM_OUT_OF_MEMORY;
  } catch (const std::exception& other) {
    keep(other.what());
    return TM_INTERNAL;
  } catch (...) {
    keep("an unknown error");
    return TM_INTERNAL;
  }
}

tm_status guarded_call(void (*body)(void*), void* data) noexcept {
  try {
    CallersWish wish;
    const CancellationScope scope(&wish);
    body(data);
    return TM_OK;
  } catch (...) {
    return caught();
  }
}

Progress callers_progress() {
  Progress progress;
  if (progress_function != nullptr)
    progress.report = [function = progress_function, user = progress_user, wish = CallersWish::current](
                          std::size_t finished, std::size_t total, const std::string& what) {
      if (function(user, finished, total, what.c_str()) != 0) wish->give_up();
    };
  return progress;
}

std::vector<std::string> texts_of(const char* const* texts, std::size_t n, const char* what) {
  require(texts != nullptr || n == 0, what);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < n; ++i) {
    require(texts[i] != nullptr, what);
    all.emplace_back(texts[i]);
  }
  return all;
}

char* lasting(const std::string& text) {
  auto* copy = static_cast<char*>(std::malloc(text.size() + 1));
  if (copy == nullptr) throw std::bad_alloc();
  std::memcpy(copy, text.c_str(), text.size() + 1);
  return copy;
}

tm_status status_of(Status status) noexcept {
  switch (status) {
    case Status::ok:
      return TM_OK;
    case Status::no_contact:
      return TM_NO_CONTACT;
    case Status::not_converged:
      return TM_NOT_CONVERGED;
    case Status::failed:
      return TM_FAILED;
  }
  return TM_INTERNAL;
}

}  // namespace treadmark::c

using treadmark::c::guarded;
using treadmark::c::require;

extern "C" {

void tm_version(int* major, int* minor, int* patch) {
  if (major != nullptr) *major = TREADMARK_VERSION_MAJOR;
  if (minor != nullptr) *minor = TREADMARK_VERSION_MINOR;
  if (patch != nullptr) *patch = TREADMARK_VERSION_PATCH;
}

const char* tm_version_text(void) {
  try {
    using namespace treadmark::app;
    static const std::string text = version() + " (" + git_revision() + ")\n" + build_description();
    return text.c_str();
  } catch (...) {
    return "";
  }
}

const char* tm_message(void) { return treadmark::c::message; }

const char* tm_status_name(tm_status status) {
  for (const auto& row : treadmark::c::kStatusNames)
    if (row.status == status) return row.name;
  return "unknown";
}

tm_status tm_set_threads(int count) {
  return guarded([&] {
    constexpr int kMost = 4096;
    require(count >= 0 && count <= kMost, "the number of threads must be 0 to 4096");
    static std::mutex mutex;
    static std::unique_ptr<treadmark::ThreadLimit> limit;
    auto next = count > 0 ? std::make_unique<treadmark::ThreadLimit>(count) : nullptr;
    const std::lock_guard lock(mutex);
    limit = std::move(next);
  });
}

void tm_set_cancel_flag(const volatile int* flag) { treadmark::c::cancel_flag = flag; }

void tm_set_progress(tm_progress function, void* user) {
  treadmark::c::progress_function = function;
  treadmark::c::progress_user = user;
}

}  // extern "C"
