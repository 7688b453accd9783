// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/faults/faulted_program.hpp"
#include "treadmark/tests/faults/file_tree.hpp"
#include "treadmark/tests/faults/output_rows.hpp"

namespace treadmark::testing {
namespace {

using namespace std::chrono_literals;

template <class Done>
bool in_time(std::chrono::seconds time, Done done) {
  for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) {
    if (done()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

/// For a lock that another process holds: a line "1: -> FLOCK ADVISORY WRITE <process> ..." of the system says so.
bool waits_for_lock(pid_t process) {
  std::ifstream locks("/proc/locks");
  std::string number, state, kind, how, what;
  pid_t whose = 0;
  for (std::string line; std::getline(locks, line);)
    if (std::istringstream(line) >> number >> state >> kind >> how >> what >> whose && state == "->" &&
        whose == process)
      return true;
  return false;
}

class TwoWriters : public ::testing::TestWithParam<OutputRow> {};

/// One is stopped at one of its operations while the other writes the same files from beginning to end.
TEST_P(TwoWriters, OneOfThemHasWritten) {
  const OutputRow& row = GetParam();
  TREADMARK_NEEDS_PARTS_OF(row);
  const OutputScene scene;
  scene.prepare(row);
  const auto made_by = [&](const char* command) {
    restore(scene.out(), {});
    FaultedProgram program(scene.out(), scene.words(command));
    EXPECT_EQ(program.wait().status, 0);
    return std::pair(tree_of(scene.out()), program.calls(faults::Class::any));
  };
  const auto [first, operations] = made_by(row.command);
  const FileTree second = made_by(row.older).first;
  constexpr std::uint64_t kMost = 6;
  const std::uint64_t step = std::max<std::uint64_t>(1, (operations + kMost - 1) / kMost);
  for (std::uint64_t n = 1; n <= operations; n += step) {
    restore(scene.out(), {});
    FaultedProgram slow(scene.out(), scene.words(row.command), "any:" + std::to_string(n) + ":STOP");
    ASSERT_TRUE(in_time(20s, [&] { return slow.fired() > 0; })) << n;
    FaultedProgram fast(scene.out(), scene.words(row.older));
    // where the stopped one holds a folder to rename its files, the other one waits for it
    in_time(2s, [&] { return !fast.program().running() || waits_for_lock(fast.program().process()); });
    slow.program().send(SIGCONT);
    const ProgramResult fast_end = fast.wait(), slow_end = slow.wait();
    EXPECT_EQ(fast_end.status, 0) << n << ": " << fast_end.err;
    EXPECT_EQ(slow_end.status, 0) << n << ": " << slow_end.err;
    const FileTree now = tree_of(scene.out());
    EXPECT_EQ(neither_old_nor_new(now, first, second), "") << n;
    EXPECT_EQ(now, visible(now)) << n << ": left unfinished files behind";
  }
}

std::vector<OutputRow> rows_of_two() {
  std::vector<OutputRow> out;
  for (const OutputRow& row : output_rows()) {
    if (row.older != nullptr && row.points > 0) out.push_back(row);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Rows, TwoWriters, ::testing::ValuesIn(rows_of_two()),
                         [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace treadmark::testing
