// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace treadmark::io {

/// The finished parts of a long work, appended to a file while it goes on, so that after a kill or a power cut the same
/// work goes on from there: every part has a check sum, and what is broken at the end of the file counts as not done.
/// Memory grows by some bytes a part. Errors: Error(configuration) that names the file. Thread-safe.
class PartLog {
 public:
  /// identity: everything that the parts depend on. An empty name: a file that has none, which nobody goes on with.
  /// Errors: also where the file holds something else, or another process is at the same work.
  PartLog(std::filesystem::path file, const std::string& identity);
  ~PartLog();
  PartLog(const PartLog&) = delete;
  PartLog& operator=(const PartLog&) = delete;

  bool has(std::size_t part) const;
  std::size_t parts() const;

  void add(std::size_t part, std::span<const std::byte> content);
  /// Of a part that is there. Errors: also where the file has changed since.
  std::vector<std::byte> content(std::size_t part) const;

  /// Removes the file: the work is done.
  void remove();

 private:
  struct Place {
    std::uint64_t offset, size, sum;
  };
  void open();
  void find_parts(const std::string& head);
  [[noreturn]] void fail(const char* what, int error) const;

  std::filesystem::path file_;
  bool named_ = true;
  int descriptor_ = -1;
  mutable std::mutex mutex_;
  std::uint64_t end_ = 0;
  std::unordered_map<std::size_t, Place> places_;
};

}  // namespace treadmark::io
