// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/error.hpp"

#include <utility>

namespace treadmark {

std::string SourcePosition::to_string() const {
  std::string text = file;
  if (line > 0) text += ':' + std::to_string(line);
  if (line > 0 && column > 0) text += ':' + std::to_string(column);
  return text;
}

namespace {
std::string compose(const std::string& message, const SourcePosition& where, const std::string& advice) {
  std::string text = where.to_string();
  if (!text.empty()) text += ": ";
  text += message;
  if (!advice.empty()) text += " (" + advice + ")";
  return text;
}
}  // namespace

Error::Error(ErrorKind kind, std::string message, SourcePosition where, std::string advice)
    : std::runtime_error(compose(message, where, advice)),
      kind_(kind),
      message_(std::move(message)),
      where_(std::move(where)),
      advice_(std::move(advice)) {}

}  // namespace treadmark
