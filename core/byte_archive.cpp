// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/core/byte_archive.hpp"

namespace treadmark {

void ByteWriter::append(const void* first, std::size_t size) {
  const auto* byte = static_cast<const std::byte*>(first);
  bytes_.insert(bytes_.end(), byte, byte + size);
}

}  // namespace treadmark
