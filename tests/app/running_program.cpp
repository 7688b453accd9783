// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/app/running_program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

namespace treadmark::testing {
namespace {

std::string slurp(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  for (std::string& word : words)
    if (word == "treadmark") word = TREADMARK_PROGRAM;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, (folder_.path() / "out").c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, (folder_.path() / "err").c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int failure = posix_spawnp(&process_, arguments.front(), &streams, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (failure != 0) throw std::system_error(failure, std::generic_category(), "cannot run " + words.front());
}

RunningProgram::~RunningProgram() {
  if (running()) {
    send(SIGKILL);
    wait();
  }
}

bool RunningProgram::running() {
  int status = 0;
  if (!ended_ && waitpid(process_, &status, WNOHANG) == process_) ended_ = status;
  return !ended_;
}

void RunningProgram::send(int signal) {
  if (running()) ::kill(process_, signal);
}

ProgramResult RunningProgram::wait() {
  int status = 0;
  while (!ended_)
    if (waitpid(process_, &status, 0) == process_)
      ended_ = status;
    else if (errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "waitpid");
  return {WIFEXITED(*ended_) ? WEXITSTATUS(*ended_) : -1, slurp(folder_.path() / "out"), slurp(folder_.path() / "err")};
}

}  // namespace treadmark::testing
