// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/file_lock.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"

namespace treadmark::app {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
  throw Error(ErrorKind::configuration, std::string(what) + ": " + std::strerror(errno), {file.string()});
}

int open_file(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(file, "cannot open the lock file");
  return descriptor;
}

int lock(int descriptor, int operation) {
  int result = 0;
  do result = ::flock(descriptor, operation);
  while (result != 0 && errno == EINTR);
  return result;
}

}  // namespace

std::optional<FileLock> FileLock::attempt(const std::filesystem::path& file) {
  const int descriptor = open_file(file);
  if (lock(descriptor, LOCK_EX | LOCK_NB) == 0) return FileLock(descriptor);
  const bool held = errno == EWOULDBLOCK;
  ::close(descriptor);
  if (!held) fail(file, "cannot lock the file");
  return std::nullopt;
}

FileLock FileLock::wait(const std::filesystem::path& file) {
  const int descriptor = open_file(file);
  if (lock(descriptor, LOCK_EX) != 0) {
    ::close(descriptor);
    fail(file, "cannot lock the file");
  }
  return FileLock(descriptor);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FileLock claim_folder(const std::filesystem::path& folder) {
  make_folder(folder);
  auto lock = FileLock::attempt(folder / "lock");
  if (!lock)
    throw Error(ErrorKind::configuration, "another simulation is writing into " + folder.string(), {},
                "choose another folder");
  remove_leftovers(folder);
  return std::move(*lock);
}

}  // namespace treadmark::app
