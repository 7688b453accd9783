// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace treadmark {

/// How every output is written. What stands under its final name is complete, also after a kill or a power cut: a file
/// is written beside its target under a hidden name, brought to the disk, renamed, and the folder's entry is brought to
/// the disk, too. Without a commit the target stays as it was. Symbolic links are followed. Devices, pipes and
/// descriptors (/dev/stdout) are written straight. Two writers of one target do not meet: the later one stays. What
/// dead processes left behind is removed by the next writer of the same target. Missing parent folders are made. Errors
/// of all functions: Error(configuration) naming the target and what to do. One object, one thread.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends.
  void write(std::string_view bytes);

  /// Gives the file its name, replacing what was there.
  void commit();

 private:
  [[noreturn]] void fail(int error) const;
  std::filesystem::path named_, target_, temporary_;  ///< as given; links resolved; empty: straight
  int descriptor_ = -1;
};

/// Writes a whole file in this manner.
void write_file(const std::filesystem::path& target, std::string_view bytes);

/// Whether a target is there and is a pipe, a device or the like: what is written to it cannot be read again.
bool is_stream(const std::filesystem::path& target) noexcept;

/// Makes a folder, with those that it lies in, for good; does nothing where it is. Errors as for OutputFile.
void make_folder(const std::filesystem::path& folder);

/// Removes a file for good, if there is one. Errors as for OutputFile.
void remove_file(const std::filesystem::path& file);

/// Files that belong together, written into a hidden folder beside the target. Without a commit the target stays as it
/// was. Errors as for OutputFile. One object, one thread.
class OutputFolder {
 public:
  /// The hidden folder lies beside the target or, where that is a folder already and is to be kept, in it.
  enum class Old { replaced, kept };
  OutputFolder(const std::filesystem::path& target, Old old);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const noexcept { return temporary_; }

  /// Gives the folder this name; what had it before is removed last. as: beside the target; empty: the target.
  void replace(const std::filesystem::path& as = {});

  /// Moves the files into the target, each in place of its namesake, those in folders first. The one named last comes
  /// last, and its old namesake goes first: where it stands, the others are of the same making. Empty: there is none.
  /// then: done before other writers may go on.
  void move_into(const std::string& last = {}, const std::function<void()>& then = {});

 private:
  [[noreturn]] void fail(const std::error_code& error) const;
  std::filesystem::path target_, temporary_;
  int lock_ = -1;
  std::vector<std::filesystem::path> made_;  ///< folders that were not there, the inner ones first
};

/// Holds the folder in which targets lie against other writers that ask for it, for the time in which several names
/// change together. Does nothing where the file system knows no locks.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Removes a folder with all that it holds; leaves what cannot be removed. Never throws.
void remove_quietly(const std::filesystem::path& folder) noexcept;

/// Removes the hidden files and folders that dead processes left in a folder. Never throws.
void remove_leftovers(const std::filesystem::path& folder) noexcept;

}  // namespace treadmark
