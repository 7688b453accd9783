// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/byte_blocks.hpp"

namespace treadmark::io::points {

/// The lines of a text that is read in blocks. Lines end with LF, CR LF or a lone CR. Where the first block has no LF,
/// they end with CR only.
class LineBlocks : public profiles::TextLine {
 public:
  /// Skips a byte order mark of UTF-8; Error(input_data) for UTF-16. first: number of the first line.
  explicit LineBlocks(ByteBlocks& bytes, int first = 1);

  /// The next line without its end; false at the end of the text. The view is valid until the next call.
  bool next(std::string_view& line) {
    std::size_t searched = 0;
    for (;;) {
      const std::string_view window = bytes_.window();
      const std::uint64_t here = bytes_.offset();
      if (next_ <= here && window.size() > searched)
        if (const void* end = std::memchr(window.data() + searched, end_of_line_, window.size() - searched))
          next_ = here + 1 + static_cast<std::uint64_t>(static_cast<const char*>(end) - window.data());
      if (next_ > here && !window.empty()) {
        take_until(window, static_cast<std::size_t>(next_ - here - 1));
        line = line_;
        return true;
      }
      searched = window.size();
      if (!more(searched)) return false;
    }
  }

  std::uint64_t start() const { return start_; }  ///< first byte in the file of the line that next() gave last
  const ByteBlocks& bytes() const { return bytes_; }

 private:
  /// The next line of a window whose byte number `length` ends one: up to there, or to a lone CR before.
  void take_until(std::string_view window, std::size_t length) {
    const void* const cr = end_of_line_ == '\n' ? std::memchr(window.data(), '\r', length) : nullptr;
    const std::size_t at =
        cr == nullptr ? length : static_cast<std::size_t>(static_cast<const char*>(cr) - window.data());
    if (at + 1 < length)
      take(window.substr(0, at), at + 1);
    else
      take(window.substr(0, length), std::min(length + 1, window.size()));
  }
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
  std::uint64_t next_ = 0;  ///< byte behind the next line end that is known; the end of the file counts as one
  std::uint64_t start_ = 0;
};

}  // namespace treadmark::io::points
