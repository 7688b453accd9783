// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <string_view>

#include "treadmark/io/points/byte_blocks.hpp"

namespace treadmark::io::scans {

using namespace points;

/// The content of an E57 file without the check sums (CRC-32C) at the end of each page of 1024 bytes, which are
/// checked.
class E57Pages {
 public:
  static constexpr std::uint64_t kPage = 1024, kContent = 1020;

  explicit E57Pages(ByteBlocks& bytes) : bytes_(bytes) {}

  /// Goes to a byte as the file counts them, check sums included. Error(input_data) behind the end or in a check sum.
  void seek(std::uint64_t physical);

  /// At least one byte of what comes next, at most `most`. Error(input_data) at the end of the file and for a page
  /// whose check sum is wrong.
  std::string_view take(std::uint64_t most);

  void read(char* to, std::size_t count);
  void skip(std::uint64_t count);

 private:
  ByteBlocks& bytes_;
  std::uint64_t page_ = 0, at_ = kContent;  ///< page that comes after the one at hand; next byte in the latter
  std::string content_;
};

/// The check sum of Castagnoli, Braeuer and Herrmann 1993.
std::uint32_t crc32c(std::string_view bytes);

}  // namespace treadmark::io::scans
