// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace treadmark::cli {

/// What was read from strangers' files and stands in messages cannot command the terminal: as long as this lives, all
/// that a stream is given is UTF-8 with line ends and tabs, and '?' in place of other control characters and of bytes
/// that are no character. One stream, one thread at a time.
class PrintableStream final : std::streambuf {
 public:
  explicit PrintableStream(std::ostream& stream) : stream_(stream), to_(stream.rdbuf(this)) {}
  ~PrintableStream() override {
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

  std::ostream& stream_;
  std::streambuf* to_;
  std::string waiting_;  ///< an unfinished character
};

}  // namespace treadmark::cli
