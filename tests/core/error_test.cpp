// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <stdexcept>

#include "treadmark/core/error.hpp"
#include "treadmark/core/report.hpp"

namespace treadmark {
namespace {

TEST(SourcePosition, LeavesOutWhatIsUnknown) {
  EXPECT_EQ((SourcePosition{"a.toml", 3, 7}.to_string()), "a.toml:3:7");
  EXPECT_EQ((SourcePosition{"a.toml", 3, 0}.to_string()), "a.toml:3");
  EXPECT_EQ((SourcePosition{"a.toml", 0, 7}.to_string()), "a.toml");
  EXPECT_EQ(SourcePosition{}.to_string(), "");
}

TEST(ErrorText, HasPlaceMessageAndAdvice) {
  const Error full(ErrorKind::input_data, "radius is negative", {"a.toml", 3, 7}, "give it in mm");
  EXPECT_STREQ(full.what(), "a.toml:3:7: radius is negative (give it in mm)");
  EXPECT_EQ(full.kind(), ErrorKind::input_data);
  EXPECT_EQ(full.message(), "radius is negative");
  EXPECT_EQ(full.where().line, 3);
  EXPECT_EQ(full.advice(), "give it in mm");
  EXPECT_STREQ(Error(ErrorKind::numerical, "no result").what(), "no result");
  EXPECT_STREQ(Error(ErrorKind::numerical, "no result", {}, "try again").what(), "no result (try again)");
  EXPECT_STREQ(Error(ErrorKind::input_data, "broken", {"b.prr", 0, 0}).what(), "b.prr: broken");
}

TEST(ErrorText, IsCaughtAsAStandardException) {
  EXPECT_THROW(throw Error(ErrorKind::configuration, "x"), std::runtime_error);
}

TEST(StatusWords, AreThoseOfTheResultFile) {
  EXPECT_EQ(to_string(Status::ok), "ok");
  EXPECT_EQ(to_string(Status::no_contact), "no_contact");
  EXPECT_EQ(to_string(Status::not_converged), "not_converged");
  EXPECT_EQ(to_string(Status::failed), "failed");
}

}  // namespace
}  // namespace treadmark
