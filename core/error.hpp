// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <stdexcept>
#include <string>

namespace treadmark {

/// Place in an input file. line and column count from 1; 0 = unknown.
struct SourcePosition {
  std::string file;
  int line = 0;    ///< from 1; 0 = unknown
  int column = 0;  ///< from 1; 0 = unknown

  /// "file:line:column", leaving out what is unknown.
  std::string to_string() const;
};

/// What went wrong, which also decides the exit status of the command line program.
enum class ErrorKind {
  configuration,  ///< the request is wrong or asks for something unsupported (exit 2)
  input_data,     ///< a data file is missing, broken or implausible (exit 3)
  numerical,      ///< a computation that has no meaningful result (exit 1)
};

/// The one exception type of the library for what is wrong (work that was cancelled ends with Cancelled,
/// core/cancellation.hpp): what happened, where in the input, and what to do about it.
/// what() reads "file:line:column: message (advice)".
class Error : public std::runtime_error {
 public:
  /// message: what is wrong, in one clause; advice: what to do instead, may be empty.
  Error(ErrorKind kind, std::string message, SourcePosition where = {}, std::string advice = {});

  ErrorKind kind() const noexcept { return kind_; }                 ///< decides the exit status
  const std::string& message() const noexcept { return message_; }  ///< without place and advice
  const SourcePosition& where() const noexcept { return where_; }   ///< in the input; may be unknown
  const std::string& advice() const noexcept { return advice_; }    ///< may be empty

 private:
  ErrorKind kind_;
  std::string message_;
  SourcePosition where_;
  std::string advice_;
};

}  // namespace treadmark
