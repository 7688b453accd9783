// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "treadmark/core/parallel.hpp"
#include "treadmark/io/files/part_log.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::content_of;
using treadmark::testing::error_of;

std::vector<std::byte> bytes_of(std::size_t part) {
  return std::vector<std::byte>(3 * part + 1, static_cast<std::byte>(part));
}

class PartLogFile : public ::testing::Test {
 protected:
  treadmark::testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "new/parts";
};

TEST_F(PartLogFile, KeepsPartsFromAnyThread) {
  {
    PartLog log(file_, "work");
    parallel_for(200, [&](std::size_t k) { log.add(k, bytes_of(k)); });
    EXPECT_EQ(log.content(7), bytes_of(7));
    EXPECT_THAT(error_of([&] { PartLog(file_, "work"); }), HasSubstr("another process"));
  }
  PartLog again(file_, "work");
  EXPECT_EQ(again.parts(), 200u);
  for (std::size_t k = 0; k < 200; ++k) EXPECT_EQ(again.content(k), bytes_of(k));
  EXPECT_FALSE(again.has(200));
  again.remove();
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(PartLogFile, GoesOnBeforeWhatIsBroken) {
  {
    PartLog log(file_, "work");
    for (std::size_t k = 0; k < 5; ++k) log.add(k, bytes_of(k));
  }
  const std::string whole = content_of(file_);
  // wherever it ends: parts before are there, those behind are not, and it goes on
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    std::ofstream(file_, std::ios::binary) << whole.substr(0, size);
    PartLog log(file_, "work");
    const std::size_t there = log.parts();
    EXPECT_EQ(there == 5, size == whole.size());
    for (std::size_t k = 0; k < 5; ++k) {
      if (k >= there) log.add(k, bytes_of(k));
      EXPECT_EQ(log.content(k), bytes_of(k)) << size;
    }
  }
  // a changed byte, wherever it is behind the line that says what it is: of the last part's number, size, sum, content
  const std::size_t content = bytes_of(4).size();
  for (const std::size_t from_end : {content + 24, content + 16, content + 8, content, std::size_t{1}}) {
    std::string damaged = whole;
    damaged[damaged.size() - from_end] ^= 1;
    std::ofstream(file_, std::ios::binary) << damaged;
    EXPECT_EQ(PartLog(file_, "work").parts(), 4u) << from_end;
  }
}

TEST_F(PartLogFile, RefusesAnotherWork) {
  { PartLog(file_, "one").add(0, bytes_of(0)); }
  EXPECT_THAT(error_of([&] { PartLog(file_, "other"); }), HasSubstr("something else"));
  EXPECT_EQ(PartLog(file_, "one").parts(), 1u);
  for (const std::string& text : {std::string("something else"), std::string(1000, 'x')}) {
    const std::filesystem::path other = folder_.write("text", text);
    EXPECT_THAT(error_of([&] { PartLog(other, "one"); }), HasSubstr("something else"));
    EXPECT_EQ(content_of(other), text);
  }
}

TEST_F(PartLogFile, TakesTheNameOfWorkThatHasNoParts) {
  { PartLog(file_, "one"); }
  { PartLog(file_, "other").add(0, bytes_of(0)); }
  EXPECT_EQ(PartLog(file_, "other").parts(), 1u);
}

TEST_F(PartLogFile, MayHaveNoName) {
  PartLog log({}, "work"), other({}, "work");
  log.add(3, bytes_of(3));
  EXPECT_EQ(log.content(3), bytes_of(3));
  EXPECT_FALSE(other.has(3));
  log.remove();
}

}  // namespace
}  // namespace treadmark::io
