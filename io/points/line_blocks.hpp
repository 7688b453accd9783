// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/byte_blocks.hpp"

namespace treadmark::io::points {

/// The lines of a text that is read in blocks. Lines end with LF or CR LF; where the first block has no LF, with CR.
class LineBlocks : public profiles::TextLine {
 public:
  /// Skips a byte order mark of UTF-8; Error(input_data) for UTF-16. first: number of the first line.
  explicit LineBlocks(ByteBlocks& bytes, int first = 1);

  /// The next line without its end; false at the end of the text. The view is valid until the next call.
  bool next(std::string_view& line) {
    std::size_t searched = 0;
    for (;;) {
      const std::string_view window = bytes_.window();
      const void* const end = window.size() > searched
                                  ? std::memchr(window.data() + searched, end_of_line_, window.size() - searched)
                                  : nullptr;
      if (end != nullptr) {
        const auto length = static_cast<std::size_t>(static_cast<const char*>(end) - window.data());
        take(window.substr(0, length), length + 1);
        line = line_;
        return true;
      }
      searched = window.size();
      if (!more(searched)) {
        line = line_;
        return searched > 0;
      }
    }
  }

  std::uint64_t start() const { return start_; }  ///< first byte in the file of the line that next() gave last
  const ByteBlocks& bytes() const { return bytes_; }

 private:
  void take(std::string_view line, std::size_t bytes) {
    if (number_ == kMostLines) too_many();
    ++number_;
    start_ = bytes_.offset();
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    line_ = line;
    bytes_.consume(bytes);
  }
  bool more(std::size_t searched);
  [[noreturn]] void too_many() const;

  static constexpr int kMostLines = 2'000'000'000;
  ByteBlocks& bytes_;
  char end_of_line_ = '\n';
  std::uint64_t start_ = 0;
};

}  // namespace treadmark::io::points
