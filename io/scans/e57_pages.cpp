// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/e57_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "treadmark/io/points/binary_values.hpp"

namespace treadmark::io::scans {

namespace {

constexpr std::size_t kSlices = 8;
using CrcTables = std::array<std::array<std::uint32_t, 256>, kSlices>;

/// Table k: what a byte changes that k more bytes follow.
constexpr CrcTables crc_tables() {
  constexpr std::uint32_t kPolynomial = 0x82f63b78;  // bits reversed
  CrcTables out{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1u) != 0 ? kPolynomial : 0u);
    out[0][i] = c;
  }
  for (std::size_t k = 1; k < kSlices; ++k)
    for (std::size_t i = 0; i < 256; ++i) out[k][i] = (out[k - 1][i] >> 8) ^ out[0][out[k - 1][i] & 255u];
  return out;
}

constexpr CrcTables kCrc = crc_tables();

}  // namespace

std::uint32_t crc32c(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (; bytes.size() >= kSlices; bytes.remove_prefix(kSlices)) {
    const std::uint64_t eight = load<std::uint64_t>(bytes.data()) ^ crc;
    crc = 0;
    for (std::size_t k = 0; k < kSlices; ++k) crc ^= kCrc[kSlices - 1 - k][(eight >> (8 * k)) & 255u];
  }
  for (const char byte : bytes) crc = (crc >> 8) ^ kCrc[0][(crc ^ static_cast<std::uint8_t>(byte)) & 255u];
  return ~crc;
}

void E57Pages::seek(std::uint64_t physical) {
  if (physical % kPage >= kContent || physical >= bytes_.size())
    bytes_.fail(fmt::format("something should lie at byte {}, where nothing can be", physical), "is the file damaged?");
  page_ = physical / kPage;
  at_ = kContent;
  take(1);
  at_ = physical % kPage;
}

std::string_view E57Pages::take(std::uint64_t most) {
  if (at_ == kContent) {
    bytes_.seek(std::min(page_ * kPage, bytes_.size()));
    const std::string_view page(bytes_.need(kPage), kPage);
    if (crc32c(page.substr(0, kContent)) != load<std::uint32_t>(page.data() + kContent, true))
      bytes_.fail(fmt::format("page {} is damaged: its check sum is wrong", page_),
                  "copy the file again from where it is sound, or export the scan again");
    content_.assign(page.substr(0, kContent));
    at_ = 0;
    ++page_;
  }
  const auto count = static_cast<std::size_t>(std::min(most, kContent - at_));
  const std::string_view out = std::string_view(content_).substr(static_cast<std::size_t>(at_), count);
  at_ += count;
  return out;
}

void E57Pages::read(char* to, std::size_t count) {
  while (count > 0) {
    const std::string_view piece = take(count);
    std::memcpy(to, piece.data(), piece.size());
    to += piece.size();
    count -= piece.size();
  }
}

void E57Pages::skip(std::uint64_t count) {
  while (count > 0) count -= take(count).size();
}

}  // namespace treadmark::io::scans
