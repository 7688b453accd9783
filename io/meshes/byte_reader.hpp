// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark::io::meshes {

/// Walks over binary data; never past its end.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string file, bool big_endian, std::size_t offset = 0)
      : bytes_(bytes),
        file_(std::move(file)),
        swap_(big_endian != (std::endian::native == std::endian::big)),
        offset_(offset) {}

  std::size_t offset() const { return offset_; }
  std::size_t left() const { return bytes_.size() - offset_; }

  void skip(std::uint64_t count) {
    if (count > left()) ends();
    offset_ += static_cast<std::size_t>(count);
  }

  template <class T>
  T read() {
    if (sizeof(T) > left()) ends();
    unsigned char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset_, sizeof(T));
    if (swap_)
      for (std::size_t k = 0; k < sizeof(T) / 2; ++k) std::swap(raw[k], raw[sizeof(T) - 1 - k]);
    offset_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  [[noreturn]] void fail(const std::string& message, const std::string& advice = {}) const {
    throw Error(ErrorKind::input_data, fmt::format("at byte {}: {}", offset_, message), {file_, 0, 0}, advice);
  }

 private:
  [[noreturn]] void ends() const { fail("the file ends in the middle of its data", "is it truncated?"); }

  std::string_view bytes_;
  std::string file_;
  bool swap_;
  std::size_t offset_;
};

}  // namespace treadmark::io::meshes
