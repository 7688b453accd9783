// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace treadmark::cli {

/// What was read from strangers' files and stands in messages cannot command the terminal: as long as this lives, all
/// that a stream is given is UTF-8 with line ends and tabs, and '?' in place of other control characters and of bytes
/// that are no character. coloured: what a line is called at its beginning ("warning:") has a colour. columns: longer
/// lines are folded, and shown when they are whole; 0: none is. One stream, one thread at a time.
class PrintableStream final : std::streambuf {
 public:
  PrintableStream(std::ostream& stream, bool coloured, std::size_t columns)
      : stream_(stream), to_(stream.rdbuf(this)), coloured_(coloured), columns_(columns) {}
  ~PrintableStream() override {
    columns_ = 0;
    sync();
    const std::ios::iostate state = stream_.rdstate();
    stream_.rdbuf(to_);  // clears the state
    stream_.setstate(state);
  }
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  int_type overflow(int_type c) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override;
  bool pass(bool all);
  bool put(std::string_view printable);

  std::ostream& stream_;
  std::streambuf* to_;
  std::string waiting_;  ///< an unfinished character
  std::string held_;     ///< an unfinished line
  bool coloured_, line_begins_ = true;
  std::size_t columns_;
};

}  // namespace treadmark::cli
