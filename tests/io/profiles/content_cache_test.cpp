// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/content_cache.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

Bytes content_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

class ContentCacheTest : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder;
  const ContentCache cache{folder.path() / "in" / "here"};
};

TEST_F(ContentCacheTest, FindsWhatWasKeptByItsKeyAlone) {
  EXPECT_FALSE(cache.find("a"));
  const Bytes content = content_of(std::string("zero \0 and more", 15));
  cache.keep("a", content);
  cache.keep("nothing in it", {});
  EXPECT_EQ(cache.find("a"), content);
  EXPECT_EQ(cache.find("nothing in it"), Bytes());
  EXPECT_FALSE(cache.find("ab"));
  EXPECT_EQ(ContentCache(folder.path() / "in" / "here").find("a"), content);
  cache.keep("a", content_of("another"));
  EXPECT_EQ(cache.find("a"), content_of("another"));
}

TEST_F(ContentCacheTest, WhatIsCutOrChangedAnywhereIsNotThere) {
  const std::string key = "what decides it";
  cache.keep(key, content_of("some content"));
  const fs::path file = cache.file_of(key);
  const std::string whole = testing::content_of(file);
  ASSERT_GT(whole.size(), 100u);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_text(file, whole.substr(0, length));
    ASSERT_FALSE(cache.find(key)) << "cut to " << length;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    write_text(file, changed);
    ASSERT_FALSE(cache.find(key)) << "changed at " << i;
  }
  write_text(file, whole + "x");
  EXPECT_FALSE(cache.find(key));
  // It is made anew over what lies there.
  cache.keep(key, content_of("some content"));
  EXPECT_EQ(testing::content_of(file), whole);
}

TEST_F(ContentCacheTest, AnEntryUnderTheNameOfAnotherIsNotTakenForIt) {
  cache.keep("one", content_of("of one"));
  fs::copy_file(cache.file_of("one"), cache.file_of("other"));
  EXPECT_FALSE(cache.find("other"));
  EXPECT_EQ(cache.find("one"), content_of("of one"));
}

TEST_F(ContentCacheTest, AFolderThatCannotBeUsedDoesNoHarm) {
  // In place of the folder, of one it lies in, or of an entry lies something else.
  write_text(folder.path() / "file", "");
  for (const fs::path& place : {folder.path() / "file", folder.path() / "file" / "below", fs::path("/proc/nowhere")}) {
    const ContentCache none(place);
    none.keep("a", content_of("x"));
    EXPECT_FALSE(none.find("a")) << place;
  }
  fs::create_directories(cache.file_of("a"));
  cache.keep("a", content_of("x"));
  EXPECT_FALSE(cache.find("a"));

  if (geteuid() == 0) return;  // to whom nothing is read-only
  const fs::path closed = folder.path() / "closed";
  fs::create_directory(closed);
  ContentCache(closed).keep("a", content_of("x"));
  fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
  ContentCache(closed).keep("b", content_of("y"));
  EXPECT_EQ(ContentCache(closed).find("a"), content_of("x"));
  EXPECT_FALSE(ContentCache(closed).find("b"));
  fs::permissions(closed, fs::perms::owner_all);
}

TEST_F(ContentCacheTest, AFullDiskDoesNoHarm) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  fs::create_directories(cache.folder());
  fs::create_symlink("/dev/full", cache.file_of("a"));
  cache.keep("a", content_of("x"));
  EXPECT_FALSE(cache.find("a"));
}

TEST_F(ContentCacheTest, WhatIsUnusedLongestGoesFirst) {
  const ContentCache small(folder.path() / "small", 3000);
  const std::string thousand(800, 'x');  // with its key and head less than 1000
  const auto at = [](int seconds) {
    return fs::file_time_type::clock::now() - std::chrono::hours(2) + std::chrono::seconds(seconds);
  };
  const std::vector<std::string> keys{"a", "b", "c"};
  for (int i = 0; i < 3; ++i) {
    small.keep(keys[static_cast<std::size_t>(i)], content_of(thousand));
    fs::last_write_time(small.file_of(keys[static_cast<std::size_t>(i)]), at(i));
  }
  write_text(small.folder() / "of somebody else", std::string(5000, 'y'));
  EXPECT_TRUE(small.find("a"));  // used: no longer the oldest
  small.keep("d", content_of(thousand));
  EXPECT_FALSE(small.find("b"));
  for (const char* key : {"a", "c", "d"}) EXPECT_TRUE(small.find(key)) << key;
  EXPECT_TRUE(fs::exists(small.folder() / "of somebody else"));
}

TEST_F(ContentCacheTest, WritersAndReadersDoNotMeet) {
  const std::string long_text(200000, 'z');
  const Bytes content = content_of(long_text);
  std::atomic<bool> wrong{false};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 25; ++i) {
        if (t % 2 == 0) cache.keep("a", content);
        if (const auto found = cache.find("a"); found && *found != content) wrong = true;
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_FALSE(wrong);
  EXPECT_EQ(cache.find("a"), content);
  int files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(cache.folder())) ++files;
  EXPECT_EQ(files, 1) << "something was left behind";
}

/// Sets a variable of the environment, and what was before at the end.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    if (value != nullptr)
      setenv(name, value, 1);
    else
      unsetenv(name);
  }
  ~Variable() {
    if (before_)
      setenv(name_, before_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(ContentCacheFolder, IsThatOfTheEnvironment) {
  const auto folder = [](const char* own, const char* base, const char* home) {
    const Variable a("TREADMARK_CACHE", own), b("XDG_CACHE_HOME", base), c("HOME", home);
    const auto cache = ContentCache::from_environment();
    return cache ? cache->folder().string() : std::string("none");
  };
  EXPECT_EQ(folder("/own", "/base", "/home/x"), "/own");
  EXPECT_EQ(folder("off", "/base", "/home/x"), "none");
  EXPECT_EQ(folder(nullptr, "/base", "/home/x"), "/base/treadmark");
  EXPECT_EQ(folder("", "", "/home/x"), "/home/x/.cache/treadmark");
  EXPECT_EQ(folder(nullptr, "relative", "/home/x"), "/home/x/.cache/treadmark");
  EXPECT_EQ(folder(nullptr, nullptr, nullptr), "none");
}

}  // namespace
}  // namespace treadmark::io
