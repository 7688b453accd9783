// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Runs one path of the library a chosen number of times, for tools that count instructions.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include "treadmark/app/bench/machine.hpp"
#include "treadmark/bench/instructions/paths.hpp"
#include "treadmark/core/parallel.hpp"

namespace {

using namespace treadmark;

constexpr const char* kUsage =
    "usage: bench_instructions list              names of the paths\n"
    "       bench_instructions compiler          compiler of this program\n"
    "       bench_instructions check [PATH...]   checks the answers of these paths or of all\n"
    "       bench_instructions run PATH N        runs a path N times; prints unit and units of one run\n"
    "       bench_instructions count PATH...     runs each path once and once more in counted_run(); prints path, "
    "unit, units\n";

int check(int count, char** names) {
  std::vector<std::string> chosen(names, names + count);
  if (chosen.empty()) chosen = bench::path_names();
  int status = 0;
  for (const std::string& name : chosen) {
    const std::string reason = bench::make_path(name).check();
    if (reason.empty()) continue;
    std::fprintf(stderr, "%s: %s\n", name.c_str(), reason.c_str());
    status = 1;
  }
  return status;
}

int run(const char* name, long times) {
  const bench::MeasuredPath path = bench::make_path(name);
  for (long i = 0; i < times; ++i) path.run();
  std::printf("%s %zu\n", path.unit.c_str(), path.units);
  return 0;
}

/// A name for tools that are told where to count.
[[gnu::noinline]] void counted_run(const bench::MeasuredPath& path) {
  path.run();
  asm volatile("" ::: "memory");  // not the tail of this function: it must be seen to end
}

int count(int paths, char** names) {
  for (int i = 0; i < paths; ++i) {
    const bench::MeasuredPath path = bench::make_path(names[i]);
    path.run();  // what is made once
    counted_run(path);
    std::printf("%s %s %zu\n", names[i], path.unit.c_str(), path.units);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const ThreadLimit one(1);
  const std::string_view verb = argc > 1 ? argv[1] : "";
  try {
    if (verb == "list" && argc == 2) {
      for (const std::string& name : bench::path_names()) std::puts(name.c_str());
      return 0;
    }
    if (verb == "compiler" && argc == 2) return std::puts(app::compiler_name().c_str()) < 0;
    if (verb == "check") return check(argc - 2, argv + 2);
    if (verb == "count" && argc > 2) return count(argc - 2, argv + 2);
    if (verb == "run" && argc == 4) return run(argv[2], std::atol(argv[3]));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_instructions: %s\n", e.what());
    return 1;
  }
  std::fputs(kUsage, stderr);
  return 2;
}
