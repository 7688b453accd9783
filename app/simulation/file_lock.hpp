// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>

namespace treadmark::app {

/// A file that one holder at a time can lock, among all threads and processes that see it, on other machines too where
/// the file system passes locks on (NFS does). The lock goes with the object, and with the process however it ends.
class FileLock {
 public:
  /// Nothing if somebody else holds it. Errors: Error(configuration) where the file cannot be made.
  static std::optional<FileLock> attempt(const std::filesystem::path& file);
  /// Waits for it.
  static FileLock wait(const std::filesystem::path& file);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Nobody else writes into the folder as long as this lives. Makes it, and removes what broken runs left. Errors:
/// Error(configuration) where somebody else does.
FileLock claim_folder(const std::filesystem::path& folder);

}  // namespace treadmark::app
