// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string_view>

namespace treadmark::io {

/// A file that appears under its name only when it is complete: it is written beside the target under another name and
/// renamed by commit(). Without a commit the target stays as it was and the temporary file is removed.
/// Missing parent folders are made. Errors: Error(configuration) naming the target. One object, one thread.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write.
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

  /// Renames the temporary file to the target, replacing what was there.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Removes what processes that died have left behind: unfinished files of this kind. Nobody may be writing into the
/// folder.
void remove_leftovers(const std::filesystem::path& folder);

/// Writes a whole text in this manner.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace treadmark::io
