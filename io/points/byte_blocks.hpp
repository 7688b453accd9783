// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/progress.hpp"

namespace treadmark::io::points {

/// Bytes of a file, read block by block: only the unread rest of a block is carried over to the next.
class ByteBlocks {
 public:
  static constexpr std::size_t kBlock = 4'000'000;
  /// The longest line of text and the longest record.
  static constexpr std::size_t kLongestPiece = 64'000'000;

  /// Opens a regular file. Error(input_data), placed at asked_by where that is known, for anything else.
  ByteBlocks(const std::filesystem::path& file, const SourcePosition& asked_by, const Progress& progress,
             std::size_t block = kBlock);

  /// Bytes in memory, which must outlive this; small blocks show what goes wrong at their ends.
  ByteBlocks(std::string_view bytes, std::string name, std::size_t block = kBlock, const Progress& progress = {});

  const std::string& file() const { return file_; }
  std::uint64_t size() const { return size_; }
  std::uint64_t offset() const { return start_of_buffer_ + begin_; }  ///< of the first unread byte
  std::uint64_t left() const { return size_ - offset(); }

  /// Unread bytes at hand; valid until more bytes are asked for.
  std::string_view window() const { return {buffer_.data() + begin_, end_ - begin_}; }

  /// Brings at least this many unread bytes into the window, or all there are. Returns the size of the window.
  std::size_t want(std::size_t bytes);

  /// As want, but Error(input_data) where the file ends before.
  const char* need(std::size_t bytes) {
    if (end_ - begin_ < bytes && want(bytes) < bytes) ends();
    return buffer_.data() + begin_;
  }

  /// Marks bytes of the window as read.
  void consume(std::size_t bytes) { begin_ += bytes; }

  /// Passes over bytes, in the window or not. Error(input_data) where the file ends before.
  void skip(std::uint64_t bytes);

  /// Goes to a byte of the file, forwards or back. Error(input_data) behind its end.
  void seek(std::uint64_t to);

  [[noreturn]] void fail(const std::string& message, const std::string& advice = {}) const;

  /// Tells that all has been read, also where the end of a file did not matter.
  void finish() const;

 private:
  void fill(std::size_t bytes);
  [[noreturn]] void ends() const { fail("the file ends in the middle of its data", "is it truncated?"); }

  std::string file_;
  std::string what_;  ///< for the progress
  Progress progress_;
  std::uint64_t size_ = 0;
  std::size_t block_ = kBlock;
  std::function<std::size_t(std::uint64_t from, char* to, std::size_t bytes)> read_;
  std::vector<char> buffer_;
  std::uint64_t start_of_buffer_ = 0;
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace treadmark::io::points
