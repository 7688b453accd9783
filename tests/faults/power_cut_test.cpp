// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/faults/power_cut.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/faults/faulted_program.hpp"
#include "treadmark/tests/faults/output_rows.hpp"

namespace treadmark::testing {
namespace {

std::vector<Loss> losses() {
  using Data = Loss::Data;
  using Names = Loss::Names;
  std::vector<Loss> out{{Data::kept, Names::dropped},
                        {Data::dropped, Names::dropped},
                        {Data::dropped, Names::kept},
                        {Data::halved, Names::kept},
                        {Data::zeroed, Names::kept}};
  for (unsigned seed = 0; seed < 5; ++seed) out.push_back({Data::random, Names::random, seed});
  return out;
}

/// The first thing that is wrong after a cut, and how many states were looked at.
std::string worst_of(const FileTree& before, const FileTree& after, const std::vector<Operation>& log,
                     std::size_t& states) {
  Disk disk(before);
  const Versions between = named_in(before, log);
  for (std::size_t n = 0; n <= log.size(); ++n) {
    if (n > 0) disk.apply(log[n - 1]);
    for (const Loss& loss : losses()) {
      ++states;
      const std::string bad = neither_old_nor_new(disk.after_cut(loss), before, after, between);
      if (!bad.empty())
        return "after " + std::to_string(n) + " of " + std::to_string(log.size()) + " operations: " + bad;
    }
  }
  // what was said to be written is there for good
  for (const Loss& loss : losses()) {
    const FileTree found = disk.after_cut(loss);
    for (const auto& [path, content] : after)
      if (const auto own = found.find(path); own == found.end() || own->second != content)
        return "after the end " + path + " is not there";
  }
  return {};
}

TEST(PowerCut, TheDiskLosesWhatWasNotSynchronised) {
  const FileTree before{{"x", "old"}}, after{{"x", "new!"}};
  const Operation create{'c', ".x.part", {}, {}, 0}, write{'w', ".x.part", {}, "new!", 0},
      sync{'s', ".x.part", {}, {}, 0}, rename{'r', ".x.part", "x", {}, 0}, sync_folder{'s', "", {}, {}, 0};
  std::size_t states = 0;
  EXPECT_EQ(worst_of(before, after, {create, write, sync, rename, sync_folder}, states), "");
  EXPECT_EQ(states, 6 * losses().size());
  EXPECT_NE(worst_of(before, after, {create, write, rename, sync_folder}, states), "");
  EXPECT_NE(worst_of(before, after, {create, write, sync, rename}, states), "");
  const Operation straight{'t', "x", {}, {}, 0}, write_x{'w', "x", {}, "new!", 0}, sync_x{'s', "x", {}, {}, 0};
  EXPECT_NE(worst_of(before, after, {straight, write_x, sync_x}, states), "");
}

TEST(PowerCut, AnIndexStandsWithItsSlices) {
  const FileTree before{{"a.slcw", "1"}, {"a.slcw-1/s", "one"}}, after{{"a.slcw", "2"}, {"a.slcw-2/s", "two"}};
  FileTree mixed = before;
  mixed["a.slcw"] = "2";
  EXPECT_NE(neither_old_nor_new(mixed, before, after), "");
  mixed["a.slcw-2/s"] = "tw";
  EXPECT_NE(neither_old_nor_new(mixed, before, after), "");
  mixed["a.slcw-2/s"] = "two";
  EXPECT_EQ(neither_old_nor_new(mixed, before, after), "");
}

TEST(PowerCut, TheLastFileStandsForItsFolder) {
  const FileTree before{{"o/a", "1"}, {"o/result.json", "1"}}, after{{"o/a", "2"}, {"o/result.json", "2"}};
  EXPECT_EQ(neither_old_nor_new({{"o/a", "2"}}, before, after), "");
  EXPECT_NE(neither_old_nor_new({{"o/a", "2"}, {"o/result.json", "1"}}, before, after), "");
  EXPECT_NE(neither_old_nor_new({{"o/a", "1"}, {"o/result.json", "2"}}, before, after), "");
  EXPECT_NE(neither_old_nor_new({{"o/result.json", "2"}}, before, after), "");
}

class PowerCuts : public ::testing::TestWithParam<OutputRow> {};

TEST_P(PowerCuts, LeaveTheOldFilesOrTheNewOnes) {
  const OutputRow& row = GetParam();
  TREADMARK_NEEDS_PARTS_OF(row);
  const OutputScene scene;
  scene.prepare(row);
  const std::filesystem::path log = scene.input().folder() / "log";
  std::size_t states = 0, operations = 0;
  const auto run = [&](const char* command) {
    const FileTree before = tree_of(scene.out());
    FaultedProgram program(scene.out(), scene.words(command), {}, log);
    const ProgramResult end = program.wait();
    ASSERT_EQ(end.status, 0) << end.err;
    const std::vector<Operation> done = read_log(log, scene.out());
    const FileTree after = tree_of(scene.out());
    operations += done.size();
    // the log has the bytes as they were written
    Disk disk(before);
    for (const Operation& operation : done) disk.apply(operation);
    ASSERT_EQ(disk.after_cut({}), after) << "the log misses something";
    EXPECT_EQ(worst_of(before, after, done, states), "") << command;
  };
  if (row.older != nullptr) run(row.older);
  run(row.command);
  EXPECT_GE(operations, 3u);  // something is written, kept and named
  EXPECT_GE(states, operations);
  std::printf("| %s | %zu operations | %zu states |\n", row.name, operations, states);
}

INSTANTIATE_TEST_SUITE_P(Rows, PowerCuts, ::testing::ValuesIn(output_rows()),
                         [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace treadmark::testing
