// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/output_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "treadmark/core/copy_bytes.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using treadmark::testing::refusal_of;

class OutputFiles : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  void put(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  static std::string read(const fs::path& file) { return treadmark::testing::content_of(file); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      all.push_back(entry.path().lexically_relative(folder_.path()).string());
    std::sort(all.begin(), all.end());
    return all;
  }
  /// In a process that is killed there.
  template <class Action>
  void killed(Action action) const {
    const pid_t child = ::fork();
    if (child == 0) {
      action();
      ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
  }

  testing::TemporaryFolder folder_;
};

TEST_F(OutputFiles, AppearWhole) {
  put("a.txt", "old");
  ::chmod(path("a.txt").c_str(), 0640);
  {
    OutputFile file(path("a.txt"));
    file.write("ne");
    EXPECT_EQ(read(path("a.txt")), "old");
    EXPECT_EQ(names().size(), 2u);
  }
  EXPECT_EQ(read(path("a.txt")), "old") << "without a commit";
  EXPECT_THAT(names(), ElementsAre("a.txt"));
  write_file(path("a.txt"), "new");
  EXPECT_EQ(read(path("a.txt")), "new");
  EXPECT_EQ(fs::status(path("a.txt")).permissions(), fs::perms(0640));
  write_file(path("deep/er/b.txt"), "b");
  EXPECT_EQ(read(path("deep/er/b.txt")), "b");
}

TEST_F(OutputFiles, FollowLinks) {
  put("target", "old");
  fs::create_symlink("target", path("link"));
  fs::create_symlink("link", path("link2"));
  write_file(path("link2"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link2")) && fs::is_symlink(path("link")));
  EXPECT_EQ(read(path("target")), "new");
  fs::create_symlink("nowhere", path("dangling"));
  write_file(path("dangling"), "made");
  EXPECT_EQ(read(path("nowhere")), "made");
  fs::create_symlink("l2", path("l1"));
  fs::create_symlink("l1", path("l2"));
  EXPECT_THAT(refusal_of([&] { write_file(path("l1"), "x"); }), HasSubstr("mend the symbolic link"));
}

TEST_F(OutputFiles, GoStraightIntoDevicesPipesAndDescriptors) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read(path("pipe")); });
  write_file(path("pipe"), "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_NO_THROW(write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(refusal_of([] { write_file("/dev/full", "x"); }), HasSubstr("make room on the disk"));

  const int descriptor = ::open(path("redirected").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::write(descriptor, "first ", 6), 6);
  write_file("/proc/self/fd/" + std::to_string(descriptor), "second");
  write_file("/dev/fd/" + std::to_string(descriptor), " third");
  ::close(descriptor);
  EXPECT_EQ(read(path("redirected")), "first second third");
}

TEST_F(OutputFiles, WhatCannotBeWrittenIsNamed) {
  put("file", "x");
  fs::create_directory(path("folder"));
  for (const fs::path& target : {path("file/below"), path("folder"), fs::path("/proc/nowhere/x"), path("")})
    EXPECT_THAT(refusal_of([&] { write_file(target, "x"); }), HasSubstr("cannot write")) << target;
  EXPECT_EQ(names().size(), 2u);
}

TEST_F(OutputFiles, NamesOfAnyLengthThatFileSystemsTake) {
  const std::string name(255, 'n');
  write_file(path(name), "long");
  EXPECT_EQ(read(path(name)), "long");
  EXPECT_EQ(names().size(), 1u);
}

TEST_F(OutputFiles, WhatTheDeadLeaveIsRemovedAndWhatTheLivingWriteIsNot) {
  OutputFile living(path("a.txt"));
  living.write("living");
  killed([&] {
    auto* file = new OutputFile(path("a.txt"));
    file->write("half");
    auto* other = new OutputFolder(path("out"), OutputFolder::Old::kept);
    write_file(other->path() / "x", "half");
  });
  put(".a.txt.partial", "of somebody else");
  put(".hidden", "of somebody else");
  EXPECT_GE(names().size(), 5u);
  write_file(path("a.txt"), "new");
  OutputFolder(path("out"), OutputFolder::Old::kept).move_into();
  living.commit();
  EXPECT_THAT(names(), ElementsAre(".a.txt.partial", ".hidden", "a.txt", "out"));
  EXPECT_EQ(read(path("a.txt")), "living") << "the later one stays";
}

TEST_F(OutputFiles, TwoWritersDoNotMeet) {
  constexpr int kTimes = 400;
  const std::string a(100'000, 'a'), b(50'000, 'b');
  const auto write = [&](const std::string& text) {
    for (int i = 0; i < kTimes; ++i) write_file(path("x"), text);
  };
  std::thread other([&] { EXPECT_NO_THROW(write(a)); });
  EXPECT_NO_THROW(write(b));
  other.join();
  const std::string content = read(path("x"));
  EXPECT_TRUE(content == a || content == b);
  EXPECT_THAT(names(), ElementsAre("x"));
}

TEST_F(OutputFiles, AFolderIsReplacedAsAWhole) {
  put("out/old", "old");
  {
    OutputFolder folder(path("out"), OutputFolder::Old::replaced);
    write_file(folder.path() / "new", "new");
    EXPECT_EQ(read(path("out/old")), "old");
  }
  EXPECT_THAT(names(), ElementsAre("out", "out/old"));
  OutputFolder folder(path("out"), OutputFolder::Old::replaced);
  write_file(folder.path() / "new", "new");
  folder.replace();
  EXPECT_THAT(names(), ElementsAre("out", "out/new"));
}

TEST_F(OutputFiles, FilesMoveIntoAFolderThatIsKept) {
  put("out/own", "own");
  put("out/last", "old");
  {
    OutputFolder folder(path("out"), OutputFolder::Old::kept);
    write_file(folder.path() / "last", "new");
  }
  EXPECT_EQ(read(path("out/last")), "old");
  OutputFolder folder(path("out"), OutputFolder::Old::kept);
  write_file(folder.path() / "sub" / "a", "a");
  write_file(folder.path() / "last", "new");
  folder.move_into("last");
  EXPECT_THAT(names(), ElementsAre("out", "out/last", "out/own", "out/sub", "out/sub/a"));
  EXPECT_EQ(read(path("out/last")), "new");
  {
    OutputFolder none(path("x/y"), OutputFolder::Old::kept);
    EXPECT_TRUE(fs::is_directory(path("x/y")));
  }
  EXPECT_FALSE(fs::exists(path("x"))) << "folders that were made for nothing go";
  put("file", "x");
  EXPECT_THAT(refusal_of([&] { OutputFolder(path("file"), OutputFolder::Old::kept); }), HasSubstr("it is a file"));
}

TEST_F(OutputFiles, FilesMoveIntoWhatLinksAndPipesLeadTo) {
  put("elsewhere", "old");
  put("out/own", "own");
  fs::create_symlink(path("elsewhere"), path("out/link"));
  ASSERT_EQ(mkfifo(path("out/pipe").c_str(), 0600), 0);
  EXPECT_TRUE(is_stream(path("out/pipe")));
  for (const char* other : {"out", "out/own", "out/link", "none"}) EXPECT_FALSE(is_stream(path(other))) << other;
  std::string read_from_pipe;
  std::thread reader([&] { read_from_pipe = read(path("out/pipe")); });
  OutputFolder folder(path("out"), OutputFolder::Old::kept);
  write_file(folder.path() / "link", "new");
  write_file(folder.path() / "pipe", "piped");
  folder.move_into();
  reader.join();
  EXPECT_EQ(read_from_pipe, "piped");
  EXPECT_TRUE(fs::is_fifo(path("out/pipe")));
  EXPECT_TRUE(fs::is_symlink(path("out/link")));
  EXPECT_EQ(read(path("elsewhere")), "new");
}

TEST_F(OutputFiles, RemovingIsDoneOrSaid) {
  put("a", "a");
  remove_file(path("a"));
  EXPECT_FALSE(fs::exists(path("a")));
  remove_file(path("a"));
  put("full/b", "b");
  EXPECT_THAT(refusal_of([&] { remove_file(path("full")); }), HasSubstr("cannot write " + path("full").string()));
}

TEST_F(OutputFiles, OfOnesOwnAreCopiedIntoWhatCannotBeRenamed) {
  put("made", std::string(3'000'000, 'x'));
  put("target", "old");
  fs::create_symlink(path("target"), path("link"));
  copy_bytes(path("made"), path("link"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read(path("target")), read(path("made")));
  put("target", "old");
  EXPECT_THAT(refusal_of([&] { copy_bytes(path("none"), path("target")); }),
              ::testing::AllOf(HasSubstr("cannot write " + path("target").string()), HasSubstr("cannot be read back")));
  EXPECT_THAT(refusal_of([&] { copy_bytes(folder_.path(), path("target")); }), HasSubstr("cannot be read back"));
  EXPECT_EQ(read(path("target")), "old");
  EXPECT_THAT(names(), ElementsAre("link", "made", "target"));
}

}  // namespace
}  // namespace treadmark
