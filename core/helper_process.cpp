// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/helper_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>

#include "treadmark/core/error.hpp"
#include "treadmark/core/modules.hpp"
#include "treadmark/core/version.hpp"

extern char** environ;

namespace treadmark {
namespace {

namespace fs = std::filesystem;

constexpr int kSlice = 50;  // [ms] between questions whether the work is to end

fs::path program_of(const Helper& helper) {
  std::string tried;
  for (const fs::path& folder : module_folders()) {
    if (::access((folder / helper.program).c_str(), X_OK) == 0) return folder / helper.program;
    tried += "\n  " + folder.string();
  }
  throw Error(ErrorKind::configuration,
              std::string("cannot find ") + helper.program + ", which " + helper.needed_by + " need, in" + tried, {},
              module_advice(helper.part));
}

/// A run of the program. It ends with this object.
class ProcessChannel final : public SocketChannel {
 public:
  ProcessChannel(const Helper& helper, const std::string& file)
      : SocketChannel(-1),
        path_(program_of(helper).string()),
        part_(helper.part),
        longest_silence_(helper.longest_silence) {
    std::string path = path_, release = version();
    int ends[2] = {-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw Error(ErrorKind::configuration, std::string("no socket can be opened for ") + helper.library, {file},
                  "are too many files open?");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // in this order, as who closed its own streams has the socket in their place
    posix_spawn_file_actions_adddup2(&actions, ends[1], kHelperSocket);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    char* arguments[] = {path.data(), release.data(), nullptr};
    const int failed = ::posix_spawn(&process_, path.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    socket_ = ends[0];
    if (failed == 0) return;
    ::close(socket_);
    throw Error(ErrorKind::configuration, "cannot start " + path, {file}, module_advice(helper.part));
  }
  ProcessChannel(const ProcessChannel&) = delete;
  ProcessChannel& operator=(const ProcessChannel&) = delete;
  ~ProcessChannel() override {
    ::close(socket_);
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

 private:
  void put_bytes(const void* data, std::size_t size) override {
    for (const char* bytes = static_cast<const char*>(data); size > 0;) {
      const std::size_t n = moved(POLLOUT, [&] { return ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT); });
      bytes += n, size -= n;
    }
  }
  void take_bytes(void* data, std::size_t size) override {
    for (char* bytes = static_cast<char*>(data); size > 0;) {
      const std::size_t n = moved(POLLIN, [&] { return ::recv(socket_, bytes, size, MSG_DONTWAIT); });
      bytes += n, size -= n;
    }
  }
  /// Bytes that a call moves once the socket is ready for it.
  template <class Call>
  std::size_t moved(short ready, Call call) {
    for (int slices = 0; slices < longest_silence_ * 1000 / kSlice;) {
      check_cancelled();
      const ssize_t n = call();
      if (n > 0) return static_cast<std::size_t>(n);
      if (n == 0 || (errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)) gone();
      pollfd wait{socket_, ready, 0};
      if (::poll(&wait, 1, kSlice) == 0) ++slices;
    }
    throw Broken{};
  }

  [[noreturn]] void gone() const {
    ::kill(process_, SIGKILL);
    siginfo_t end{};
    if (::waitid(P_PID, static_cast<id_t>(process_), &end, WEXITED | WNOWAIT) == 0 && end.si_code == CLD_EXITED &&
        end.si_status == kOtherVersion)
      throw Error(ErrorKind::configuration, path_ + " is of another version", {}, module_advice(part_));
    throw Broken{};
  }

  std::string path_, part_;
  pid_t process_ = -1;
  int longest_silence_;  ///< [s]
};

}  // namespace

std::unique_ptr<Channel> start_helper(const Helper& helper, const std::string& file) {
  return std::make_unique<ProcessChannel>(helper, file);
}

}  // namespace treadmark
