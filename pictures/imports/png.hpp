// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treadmark::io {

/// A picture whose pixels name colours of a palette, row after row from the top.
struct PaletteImage {
  std::size_t width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> palette;  ///< red, green, blue, opacity; at most 256
  std::vector<std::uint8_t> index;                   ///< width * height, each below the size of the palette
};

/// The bytes of a PNG file (ISO/IEC 15948). The same image gives the same bytes. Thread-safe.
/// Errors: Error(numerical) for an image without pixels or colours, or one whose sizes do not match.
std::vector<std::byte> to_png(const PaletteImage& image);

}  // namespace treadmark::io
