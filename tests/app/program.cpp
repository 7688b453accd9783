// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/app/program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace treadmark::testing {
namespace {

std::string quoted(const std::string& text) {
  std::string result("'");
  for (const char c : text) {
    if (c == '\'')
      result.append("'\\''");
    else
      result.push_back(c);
  }
  result.push_back('\'');
  return result;
}

std::string slurp(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments) {
  static std::atomic<int> count{0};
  const auto base = std::filesystem::temp_directory_path() /
                    ("treadmark_run_" + std::to_string(getpid()) + "_" + std::to_string(count.fetch_add(1)));
  const std::string out = base.string() + ".out", err = base.string() + ".err";
  std::string command = quoted(TREADMARK_PROGRAM);
  for (const auto& argument : arguments) command.append(" ").append(quoted(argument));
  command.append(" >").append(quoted(out)).append(" 2>").append(quoted(err)).append(" </dev/null");
  const int raw = std::system(command.c_str());
  ProgramResult result{WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, slurp(out), slurp(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return result;
}

}  // namespace treadmark::testing
