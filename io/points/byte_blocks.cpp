// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/byte_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io::points {

namespace fs = std::filesystem;

ByteBlocks::ByteBlocks(const fs::path& file, const SourcePosition& asked_by, const Progress& progress,
                       std::size_t block)
    : file_(file.string()),
      what_("reading " + file.filename().string()),
      progress_(progress),
      block_(std::max<std::size_t>(block, 1)) {
  const SourcePosition where = asked_by.file.empty() ? SourcePosition{file_, 0, 0} : asked_by;
  const auto refuse = [&](const std::string& why, const std::string& advice) {
    throw Error(ErrorKind::input_data,
                fmt::format("the scan file {} {}", profiles::printable(file.filename().string()), why), where, advice);
  };
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  if (status.type() == fs::file_type::not_found)
    throw MissingFile(ErrorKind::input_data,
                      fmt::format("the scan file {} does not exist", profiles::printable(file.filename().string())),
                      where, advice_on_missing(file));
  if (status.type() == fs::file_type::none) refuse("cannot be looked up: " + code.message(), "check its name");
  if (fs::is_directory(status)) refuse("is a folder", "name a file in it");
  if (!fs::is_regular_file(status)) refuse("is not a regular file", "name a file of points");
  refuse_output_as_input(file);
  size_ = fs::file_size(file, code);
  if (code) refuse("cannot be read: " + code.message(), "check its permissions");
  if (size_ == 0) refuse("is empty", "was it copied to its end?");
  const auto stream = std::make_shared<std::ifstream>();
  stream->rdbuf()->pubsetbuf(nullptr, 0);  // the blocks are the buffer
  stream->open(file, std::ios::binary);
  if (!*stream) refuse("cannot be opened", "check its permissions");
  read_ = [stream, at = std::uint64_t{0}](std::uint64_t from, char* to, std::size_t bytes) mutable {
    if (from != at) stream->seekg(static_cast<std::streamoff>(from));
    at = from + bytes;
    stream->read(to, static_cast<std::streamsize>(bytes));
    return static_cast<std::size_t>(stream->gcount());
  };
}

ByteBlocks::ByteBlocks(std::string_view bytes, std::string name, std::size_t block, const Progress& progress)
    : file_(std::move(name)),
      what_("reading " + file_),
      progress_(progress),
      size_(bytes.size()),
      block_(std::max<std::size_t>(block, 1)) {
  read_ = [bytes](std::uint64_t from, char* to, std::size_t count) {
    const std::string_view rest = bytes.substr(static_cast<std::size_t>(from), count);
    std::memcpy(to, rest.data(), rest.size());
    return rest.size();
  };
}

void ByteBlocks::fill(std::size_t bytes) {
  check_cancelled();
  if (progress_.stop_requested()) fail("reading was stopped", "nothing was changed");
  const std::size_t carried = end_ - begin_;
  if (begin_ > 0 && carried > 0) std::memmove(buffer_.data(), buffer_.data() + begin_, carried);
  start_of_buffer_ += begin_;
  begin_ = 0;
  end_ = carried;
  const std::uint64_t unread = size_ - (start_of_buffer_ + end_);
  // never room for more than the file has
  const auto room =
      static_cast<std::size_t>(std::min<std::uint64_t>(carried + unread, std::max(bytes, carried + block_)));
  if (buffer_.size() < room) buffer_.resize(room);
  const std::size_t got = read_(start_of_buffer_ + end_, buffer_.data() + end_, room - end_);
  end_ += got;
  if (end_ < room) fail("the file ends before its size says so", "was it changed while it was read?");
  if (progress_.report) progress_.report(static_cast<std::size_t>(offset()), static_cast<std::size_t>(size_), what_);
}

std::size_t ByteBlocks::want(std::size_t bytes) {
  if (end_ - begin_ < bytes && end_ - begin_ < left()) fill(bytes);
  return end_ - begin_;
}

void ByteBlocks::skip(std::uint64_t bytes) {
  if (bytes > left()) ends();
  while (bytes > 0) {
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, want(1)));
    consume(step);
    bytes -= step;
  }
}

void ByteBlocks::seek(std::uint64_t to) {
  if (to > size_) ends();
  if (to >= start_of_buffer_ && to <= start_of_buffer_ + end_) {
    begin_ = static_cast<std::size_t>(to - start_of_buffer_);
    return;
  }
  start_of_buffer_ = to;
  begin_ = end_ = 0;
}

void ByteBlocks::fail(const std::string& message, const std::string& advice) const {
  throw Error(ErrorKind::input_data, fmt::format("at byte {}: {}", offset(), message), {file_, 0, 0}, advice);
}

void ByteBlocks::finish() const {
  if (progress_.report) progress_.report(static_cast<std::size_t>(size_), static_cast<std::size_t>(size_), what_);
}

}  // namespace treadmark::io::points
