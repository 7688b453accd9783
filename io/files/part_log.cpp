// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/part_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/sha256.hpp"

namespace treadmark::io {
namespace {

constexpr const char* kFormat = "treadmark-parts-1";

/// What stands before a part.
struct Head {
  std::uint64_t part, size, sum;
};

/// Another one also where the number of the part is damaged.
std::uint64_t sum_of(std::uint64_t part, std::span<const std::byte> content) { return check_sum(content) ^ part; }

/// False where the file ends before.
bool read_at(int descriptor, std::uint64_t at, void* to, std::size_t size) {
  char* next = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t done = ::pread(descriptor, next, size, static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    next += done, at += static_cast<std::uint64_t>(done), size -= static_cast<std::size_t>(done);
  }
  return true;
}

bool write_at(int descriptor, std::uint64_t at, const void* from, std::size_t size) {
  const char* next = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t done = ::pwrite(descriptor, next, size, static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    next += done, at += static_cast<std::uint64_t>(done), size -= static_cast<std::size_t>(done);
  }
  return true;
}

std::uint64_t size_of(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

}  // namespace

void PartLog::fail(const char* what, int error) const {
  throw Error(ErrorKind::configuration,
              fmt::format("cannot {} {}: {}", what, file_.string(), std::generic_category().message(error)), {},
              error == ENOSPC || error == EDQUOT ? "make room on the disk: the same command goes on"
                                                 : "check the folder and its disk");
}

PartLog::PartLog(std::filesystem::path file, const std::string& identity) : file_(std::move(file)) {
  open();
  const std::string head = fmt::format("{} {}\n", kFormat, sha256_hex(identity));
  try {
    find_parts(head);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

PartLog::~PartLog() { ::close(descriptor_); }

void PartLog::open() {
  named_ = !file_.empty();
  if (named_) {
    if (!file_.parent_path().empty()) make_folder(file_.parent_path());
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  } else {
    std::string name = (std::filesystem::temp_directory_path() / "treadmark-XXXXXX").string();
    file_ = name;
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ >= 0) ::unlink(name.c_str());
  }
  if (descriptor_ < 0) fail("open", errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw Error(ErrorKind::configuration, fmt::format("another process is at work with {}", file_.string()), {},
                "wait for it, or choose another output");
  }
}

void PartLog::find_parts(const std::string& head) {
  const std::uint64_t size = size_of(descriptor_);
  std::string found(std::min<std::uint64_t>(size, head.size()), '\0');
  if (!read_at(descriptor_, 0, found.data(), found.size())) fail("read", errno);
  const bool empty = size <= head.size() && found.starts_with(kFormat);  // nothing is lost with one of other work
  if (!head.starts_with(found) && !empty)
    throw Error(
        ErrorKind::configuration,
        fmt::format(
            "{} holds something else that is unfinished: input, files, settings or version of the program differ",
            file_.string()),
        {}, "go on with what they were, remove it, or choose another output");
  end_ = head.size();
  if (found != head && !write_at(descriptor_, 0, head.data(), head.size())) fail("write", errno);
  std::vector<std::byte> bytes;
  for (Head part{}; read_at(descriptor_, end_, &part, sizeof part);) {
    check_cancelled();
    const std::uint64_t at = end_ + sizeof part;
    if (part.size > size - at) break;
    bytes.resize(part.size);
    if (!read_at(descriptor_, at, bytes.data(), bytes.size()) || sum_of(part.part, bytes) != part.sum) break;
    places_[part.part] = {at, part.size, part.sum};
    end_ = at + part.size;
  }
  if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0) fail("write", errno);
}

bool PartLog::has(std::size_t part) const {
  const std::lock_guard lock(mutex_);
  return places_.contains(part);
}

std::size_t PartLog::parts() const {
  const std::lock_guard lock(mutex_);
  return places_.size();
}

void PartLog::add(std::size_t part, std::span<const std::byte> content) {
  const Head head{part, content.size(), sum_of(part, content)};
  std::vector<std::byte> frame(sizeof head + content.size());
  std::memcpy(frame.data(), &head, sizeof head);
  if (!content.empty()) std::memcpy(frame.data() + sizeof head, content.data(), content.size());
  const std::lock_guard lock(mutex_);
  if (!write_at(descriptor_, end_, frame.data(), frame.size())) fail("write", errno);
  places_[part] = {end_ + sizeof head, head.size, head.sum};
  end_ += frame.size();
}

std::vector<std::byte> PartLog::content(std::size_t part) const {
  const Place place = [&] {
    const std::lock_guard lock(mutex_);
    return places_.at(part);
  }();
  std::vector<std::byte> bytes(place.size);
  if (!read_at(descriptor_, place.offset, bytes.data(), bytes.size()) || sum_of(part, bytes) != place.sum)
    throw Error(ErrorKind::configuration, fmt::format("{} has changed while it was in use", file_.string()), {},
                "start anew, and leave it alone meanwhile");
  return bytes;
}

void PartLog::remove() {
  if (named_) remove_file(file_);
}

}  // namespace treadmark::io
