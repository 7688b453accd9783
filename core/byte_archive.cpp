// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/core/byte_archive.hpp"

namespace treadmark {

void ByteWriter::append(const void* first, std::size_t size) {
  const auto* byte = static_cast<const std::byte*>(first);
  bytes_.insert(bytes_.end(), byte, byte + size);
}

std::uint64_t check_sum(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::byte b : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(b)) * 0x100000001b3u;
  return hash;
}

}  // namespace treadmark
