// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace treadmark::testing {

struct PngImage {
  std::size_t width = 0, height = 0;
  std::vector<std::array<int, 4>> pixels;  ///< red, green, blue, opacity, from the upper left
};

/// Reads PNG files of 8-bit palette colours without filters; checks signature, order and CRC of the chunks (computed
/// bit by bit). Throws std::runtime_error for anything else.
PngImage read_png(std::span<const std::byte> bytes);

/// Base64 (RFC 4648); throws std::runtime_error for other characters.
std::vector<std::byte> from_base64(const std::string& text);

}  // namespace treadmark::testing
