// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/faults/file_tree.hpp"
#include "treadmark/tests/faults/output_rows.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Where outputs may go that is no plain file. Each row writes one file, the last word of its command that begins with
/// @. Nothing here touches a device of the system: some are made in the temporary folder, where that is allowed.
class Targets : public ::testing::TestWithParam<OutputRow> {
 protected:
  void SetUp() override {
    const OutputRow& row = GetParam();
    TREADMARK_NEEDS_PARTS_OF(row);
    scene.prepare(row);
    const std::string command = row.command;
    const std::size_t at = command.find('@') + 1;
    name = command.substr(at, command.find(' ', at) - at);
    target = scene.out() / name;
    ASSERT_EQ(run().status, 0);
    expected = tree_of(scene.out());
    ASSERT_EQ(expected.size(), 1u);
    fs::remove(target);
  }

  ProgramResult run() const {
    std::vector<std::string> words{"--quiet", "--threads", "1"};
    for (const std::string& word : scene.words(GetParam().command)) words.push_back(word);
    return run_program(words);
  }

  /// Sizes, and where nothing but the content goes in also the bytes: times differ from run to run.
  static void expect_content(const std::string& content, const std::string& wanted, const std::string& file) {
    const auto shape = [](std::string text) {
      std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == 'e'; });
      return text;
    };
    EXPECT_FALSE(content.empty()) << file;
    if (!file.ends_with(".vdb") && !file.ends_with(".stl") && !file.ends_with(".ply")) {
      EXPECT_EQ(shape(content), shape(wanted)) << file;
    } else {
      EXPECT_EQ(content.size(), wanted.size()) << file;
    }
  }

  void expect_refused(const ProgramResult& end) const {
    EXPECT_GT(end.status, 0);
    EXPECT_LE(end.status, 4);
    EXPECT_THAT(end.err, HasSubstr(name));
    EXPECT_EQ(end.err.find("unexpected failure"), std::string::npos) << end.err;
  }

  OutputScene scene;
  std::string name;
  fs::path target;
  FileTree expected;
};

TEST_P(Targets, ALinkIsFollowedAndStays) {
  const fs::path real = scene.input().folder() / "elsewhere" / ("real-" + name);
  fs::create_directories(real.parent_path());
  std::ofstream(real) << "old";
  for (const char* what : {"to a file", "to where a file shall be"}) {
    fs::remove(target);
    fs::create_symlink(real, target);
    const ProgramResult end = run();
    EXPECT_EQ(end.status, 0) << what << ": " << end.err;
    EXPECT_TRUE(fs::is_symlink(target)) << what;
    EXPECT_TRUE(fs::is_regular_file(real)) << what;
    const FileTree tree = tree_of(real.parent_path());
    EXPECT_EQ(tree.size(), 1u) << what;
    expect_content(tree.begin()->second, expected.begin()->second, name);
    fs::remove(real);
  }
}

TEST_P(Targets, ALoopOfLinksIsRefused) {
  const fs::path other = scene.out() / "other";
  fs::create_symlink(other, target);
  fs::create_symlink(target, other);
  expect_refused(run());
  EXPECT_TRUE(fs::is_symlink(target));
  EXPECT_TRUE(fs::is_symlink(other));
}

TEST_P(Targets, AFolderIsRefused) {
  fs::create_directories(target / "kept");
  expect_refused(run());
  EXPECT_TRUE(fs::is_directory(target / "kept"));
}

TEST_P(Targets, AFileInTheWayOfAFolderIsRefused) {
  std::ofstream(target.parent_path() / "file") << "kept";
  std::string command = GetParam().command;
  command.insert(command.find('@') + 1, "file/");
  std::vector<std::string> words{"--quiet"};
  for (const std::string& word : scene.words(command)) words.push_back(word);
  expect_refused(run_program(words));
  EXPECT_EQ(tree_of(scene.out()), (FileTree{{"file", "kept"}}));
}

TEST_P(Targets, AReaderOfAPipeGetsAll) {
  ASSERT_EQ(mkfifo(target.c_str(), 0600), 0);
  RunningProgram reader({"timeout", "60", "cat", target.string()});
  const ProgramResult end = run();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_TRUE(fs::is_fifo(target));
  if (!fs::is_fifo(target)) reader.send(SIGTERM);
  const std::string content = reader.wait().out;
  expect_content(content, expected.begin()->second, name);
  EXPECT_EQ(std::distance(fs::directory_iterator(scene.out()), {}), 1);
}

TEST_P(Targets, ADeviceStaysADevice) {
  if (mknod(target.c_str(), S_IFCHR | 0666, makedev(1, 3)) != 0 || !std::ofstream(target))
    GTEST_SKIP() << "devices are not allowed here";
  const ProgramResult end = run();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_TRUE(fs::is_character_file(target));
  EXPECT_EQ(std::distance(fs::directory_iterator(scene.out()), {}), 1);
}

TEST_P(Targets, AFullDeviceIsSaid) {
  if (mknod(target.c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0 || !std::ofstream(target))
    GTEST_SKIP() << "devices are not allowed here";
  expect_refused(run());
  EXPECT_TRUE(fs::is_character_file(target));
}

TEST_P(Targets, TheLongestNameIsWritten) {
  constexpr std::size_t kMost = 255;
  std::string command = GetParam().command;
  const std::string longest(kMost - name.size(), 'x');
  command.insert(command.find('@') + 1, longest);
  std::vector<std::string> words{"--quiet"};
  for (const std::string& word : scene.words(command)) words.push_back(word);
  const ProgramResult end = run_program(words);
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(tree_of(scene.out()).count(longest + name), 1u);
}

std::vector<OutputRow> rows_of_one_file() {
  std::vector<OutputRow> out;
  for (const OutputRow& row : output_rows()) {
    const std::string command = row.command;
    const bool one = std::count(command.begin(), command.end(), '@') == 1;
    const bool index = command.find(".slc") != command.npos;
    const bool folder = command.substr(command.find('@')).find('.') == command.npos;
    if (one && !index && !folder) out.push_back(row);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Rows, Targets, ::testing::ValuesIn(rows_of_one_file()),
                         [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace treadmark::testing
