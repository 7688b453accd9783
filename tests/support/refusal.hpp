// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::testing {

/// The Error that a call throws; a failure of the test where it throws none.
template <class Call>
Error error_thrown_by(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no Error was thrown";
  return Error(ErrorKind::numerical, "no Error was thrown");
}

/// What a user sees of the Error that a call throws, which must be of this kind; "no error" where it throws none.
template <class Call>
std::string refusal_of(Call&& call, std::optional<ErrorKind> kind = {}) {
  try {
    call();
  } catch (const Error& error) {
    if (kind) {
      EXPECT_EQ(error.kind(), *kind);
    }
    return error.what();
  }
  return "no error";
}

}  // namespace treadmark::testing
