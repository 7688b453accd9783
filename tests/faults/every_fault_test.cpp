// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/tests/faults/faulted_program.hpp"
#include "treadmark/tests/faults/file_tree.hpp"
#include "treadmark/tests/faults/output_rows.hpp"
#include "treadmark/tests/faults/power_cut.hpp"

namespace treadmark::testing {
namespace {

using faults::Class;
namespace fs = std::filesystem;

struct Fault {
  Class cls;
  const char* what;
  bool on;  ///< that call and all after it
};

constexpr Fault kFaults[] = {
    {Class::open, "EACCES", false},   {Class::open, "EMFILE", false},  {Class::open, "ENOSPC", false},
    {Class::write, "ENOSPC", false},  {Class::write, "ENOSPC", true},  {Class::write, "EIO", false},
    {Class::write, "EDQUOT", false},  {Class::write, "SHORT", false},  {Class::write, "EINTR", false},
    {Class::fsync, "EIO", false},     {Class::rename, "EIO", false},   {Class::rename, "EACCES", false},
    {Class::mkdir, "ENOSPC", false},  {Class::mkdir, "EACCES", false}, {Class::unlink, "EIO", false},
    {Class::close, "EIO", false},     {Class::truncate, "EIO", false}, {Class::lock, "ENOLCK", false},
    {Class::any, "EROFS", true},      {Class::any, "EIO", true},       {Class::any, "KILL", false},
    {Class::any, "TERM", false},      {Class::any, "INT", false},      {Class::any, "VANISH", false},
    {Class::memory, "ENOMEM", false},
};

/// With TREADMARK_FAULTS=all: every call, but no more allocations than this.
constexpr std::uint64_t kMostAllocations = 100;
constexpr int kHighestStatus = 4;  // as --help says

bool everywhere() {
  const char* wanted = std::getenv("TREADMARK_FAULTS");
  return wanted != nullptr && std::string(wanted) == "all";
}

/// Of calls 1 to n, some spread evenly; `which` shifts them, so that faults do not all meet the same calls.
std::vector<std::uint64_t> sampled(std::uint64_t n, std::uint64_t some, std::size_t which) {
  std::vector<std::uint64_t> out;
  const double shift = 0.618 * static_cast<double>(which + 1);
  for (std::uint64_t i = 0; i < std::min(some, n); ++i) {
    const double place = (static_cast<double>(i) + (n > some ? shift - static_cast<int>(shift) : 0.0)) /
                         static_cast<double>(std::min(some, n));
    out.push_back(1 + static_cast<std::uint64_t>(place * static_cast<double>(n)));
  }
  return out;
}

class EveryFault : public ::testing::TestWithParam<OutputRow> {
 protected:
  /// What a faultless run of the row makes of a folder.
  FileTree made_of(const FileTree& start, const char* command) {
    restore(scene.out(), start);
    const fs::path log = scene.input().folder() / "log";
    FaultedProgram program(scene.out(), scene.words(command), {}, log);
    const ProgramResult end = program.wait();
    EXPECT_EQ(end.status, 0) << command << ": " << end.err;
    for (std::size_t i = 0; i < calls.size(); ++i) calls[i] = program.calls(static_cast<Class>(i));
    between = named_in(start, read_log(log, scene.out()));
    return tree_of(scene.out());
  }

  /// Injects one fault and says what is wrong; empty where nothing is.
  std::string inject(const Fault& fault, std::uint64_t n, const FileTree& start, const FileTree& settled) {
    const std::string text = std::string(faults::kClassNames[static_cast<std::size_t>(fault.cls)]) + ":" +
                             std::to_string(n) + (fault.on ? "+:" : ":") + fault.what;
    const std::string what = fault.what;
    const bool kill = what == "KILL", signal = what == "TERM" || what == "INT", vanish = what == "VANISH";
    // what cannot remove cannot clean up either
    const bool blocked = fault.cls == Class::unlink || (fault.cls == Class::any && fault.on);
    const fs::path out = scene.out(), gone = out.string() + ".gone";
    FaultedProgram program(out, scene.words(GetParam().command), text);
    const ProgramResult end = program.wait();
    if (program.fired() == 0) return {};
    ++injected;
    const auto wrong = [&](const std::string& why) {
      return text + (start.empty() ? " into an empty folder: " : " over old files: ") + why + ", exit status " +
             std::to_string(end.status) + "\n" + end.err;
    };

    if (vanish) {
      const std::string bad = neither_old_nor_new(tree_of(gone), start, settled, between);
      fs::remove_all(gone);
      restore(out, start);
      if (end.status < 0 || end.status > kHighestStatus) return wrong("no status of a program");
      return bad.empty() ? "" : wrong(bad);
    }
    const FileTree now = tree_of(out);
    if (kill ? end.status >= 0 : end.status > kHighestStatus || (end.status < 0 && !signal))
      return wrong("no status of a program");
    if (end.status == 0) {
      for (const auto& [path, content] : visible(settled))
        if (const auto own = now.find(path); own == now.end() || own->second != content)
          return wrong("it said ok, but not all is there");
      if (!blocked && visible(now) != visible(settled)) return wrong("it said ok and left more");
    }
    if (end.status == 0 && fault.cls == Class::fsync) return wrong("it said ok without knowing");
    if (end.status > 0 && !signal) {
      const bool said = fault.cls == Class::memory ? !end.err.empty() : end.err.find(out.string()) != std::string::npos;
      if (!said) return wrong("no message that names what could not be written");
    }
    // where Ctrl-C ends a simulation between its steps there are files of what was done
    const std::string bad = signal && end.status == 1 && GetParam().resumes
                                ? first_half_written(now)
                                : neither_old_nor_new(now, start, settled, between);
    if (!bad.empty()) return wrong(bad);
    if (end.status >= 0 && !blocked && now != visible(now)) return wrong("left unfinished files behind");
    if (now == start || now == settled) return {};
    ++again;
    FaultedProgram next(out, scene.words(GetParam().command));
    const ProgramResult next_end = next.wait();
    const FileTree then = tree_of(out);
    restore(out, start);
    if (next_end.status != 0) return wrong("the next run failed: " + next_end.err);
    for (const auto& [path, content] : then)
      if (settled.count(path) == 0) return wrong("the next run left " + path);
    for (const auto& [path, content] : settled) {
      // What goes on has other times, which tables do not hold.
      const bool timed = GetParam().resumes && !path.ends_with(".csv");
      const auto own = then.find(path);
      if (own == then.end() || (!timed && own->second != content))
        return wrong("the next run wrote something else: " + path);
    }
    return {};
  }

  OutputScene scene;
  std::array<std::uint64_t, faults::kClasses> calls{};
  Versions between;
  std::size_t injected = 0, again = 0;
};

TEST_P(EveryFault, LeavesTheOldFilesOrTheNewOnes) {
  const OutputRow& row = GetParam();
  TREADMARK_NEEDS_PARTS_OF(row);
  scene.prepare(row);
  std::vector<FileTree> starts{{}};
  if (row.older != nullptr) starts.push_back(made_of({}, row.older));
  std::size_t wrong = 0, points = 0;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const FileTree settled = made_of(starts[s], row.command);
    ASSERT_FALSE(settled.empty());
    ASSERT_EQ(settled, visible(settled)) << "a faultless run leaves unfinished files";
    ASSERT_EQ(settled, made_of(starts[s], row.command)) << "two runs write different bytes";
    const auto faultless = calls;
    for (std::size_t f = 0; f < std::size(kFaults); ++f) {
      const Fault& fault = kFaults[f];
      const std::uint64_t n = faultless[static_cast<std::size_t>(fault.cls)];
      points += n;
      if (!everywhere() && row.points == 0 && f % 2 != s) continue;
      std::uint64_t some = everywhere() ? n : static_cast<std::uint64_t>(std::max(row.points, 1));
      if (fault.cls == Class::memory) some = std::min(some, kMostAllocations);
      restore(scene.out(), starts[s]);
      for (const std::uint64_t call : sampled(n, some, f)) {
        const std::string what = inject(fault, call, starts[s], settled);
        if (!what.empty()) {
          if (++wrong <= 10) ADD_FAILURE() << what;
        }
        if (tree_of(scene.out()) != starts[s]) restore(scene.out(), starts[s]);
      }
    }
  }
  EXPECT_EQ(wrong, 0u) << "of " << injected;
  std::printf("| %s | %zu of %zu | %zu | %zu |\n", row.name, injected, points, again, wrong);
}

INSTANTIATE_TEST_SUITE_P(Rows, EveryFault, ::testing::ValuesIn(output_rows()),
                         [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace treadmark::testing
