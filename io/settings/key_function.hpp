// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace treadmark::io {

/// A function that a line of a table of keys holds, or none. As std::function, but with a few templates a function
/// where that has dozens: there are hundreds, and compiling them took most of this library's time. Copies share the
/// function, which is const; safe to call from several threads where that is. To call none is an error of the program.
template <class Signature>
class KeyFunction;

template <class Result, class... Arguments>
class KeyFunction<Result(Arguments...)> {
  struct Any {
    Any() = default;
    Any(const Any&) = delete;
    Any& operator=(const Any&) = delete;
    virtual ~Any() = default;
    virtual Result call(Arguments... arguments) const = 0;
  };
  template <class Function>
  struct One final : Any {
    explicit One(Function given) : function(std::move(given)) {}
    Result call(Arguments... arguments) const override {
      if constexpr (std::is_void_v<Result>)
        function(std::forward<Arguments>(arguments)...);
      else
        return function(std::forward<Arguments>(arguments)...);
    }
    Function function;
  };

 public:
  KeyFunction() noexcept = default;  // said for GCC 12, which breaks where it must find out
  template <class Function>
  requires(!std::is_same_v<Function, KeyFunction> && std::is_invocable_r_v<Result, const Function&, Arguments...>)
      KeyFunction(Function function)
      : held_(static_cast<const Any*>(new One<Function>(std::move(function)))) {}

  explicit operator bool() const { return held_ != nullptr; }
  Result operator()(Arguments... arguments) const { return held_->call(std::forward<Arguments>(arguments)...); }

 private:
  std::shared_ptr<const Any> held_;
};

}  // namespace treadmark::io
