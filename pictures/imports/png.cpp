// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/pictures/imports/png.hpp"

#include <zlib.h>

#include <algorithm>
#include <span>

#include "treadmark/core/error.hpp"

namespace treadmark::io {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kLargestPng = 1u << 16;  // pixels along a side

void add_number(Bytes& out, std::size_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(value >> shift & 0xFFu));
}

/// Length, name, data, and the CRC of name and data.
void add_chunk(Bytes& out, const char (&name)[5], std::span<const std::byte> data) {
  add_number(out, data.size());
  const std::size_t start = out.size();
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::byte>(name[i]));
  out.insert(out.end(), data.begin(), data.end());
  const auto* checked = reinterpret_cast<const Bytef*>(out.data() + start);
  add_number(out, ::crc32(::crc32(0L, Z_NULL, 0), checked, static_cast<uInt>(out.size() - start)));
}

Bytes deflated(const Bytes& raw) {
  uLongf length = ::compressBound(static_cast<uLong>(raw.size()));
  Bytes out(length);
  const int status = ::compress2(reinterpret_cast<Bytef*>(out.data()), &length,
                                 reinterpret_cast<const Bytef*>(raw.data()), static_cast<uLong>(raw.size()), 9);
  if (status != Z_OK) throw Error(ErrorKind::numerical, "a picture could not be compressed");
  out.resize(length);
  return out;
}

}  // namespace

std::vector<std::byte> to_png(const PaletteImage& image) {
  const bool whole = image.width > 0 && image.height > 0 && image.width <= kLargestPng && image.height <= kLargestPng &&
                     image.index.size() == image.width * image.height && !image.palette.empty() &&
                     image.palette.size() <= 256 &&
                     *std::max_element(image.index.begin(), image.index.end()) < image.palette.size();
  if (!whole) throw Error(ErrorKind::numerical, "a picture whose pixels and colours do not match its size");

  Bytes out;
  for (const int c : {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A}) out.push_back(static_cast<std::byte>(c));
  Bytes header;
  add_number(header, image.width);
  add_number(header, image.height);
  for (const int c : {8, 3, 0, 0, 0}) header.push_back(static_cast<std::byte>(c));  // 8 bits, palette, not interlaced
  add_chunk(out, "IHDR", header);

  Bytes colours, opacity;
  for (const auto& colour : image.palette) {
    for (int i = 0; i < 3; ++i) colours.push_back(static_cast<std::byte>(colour[static_cast<std::size_t>(i)]));
    opacity.push_back(static_cast<std::byte>(colour[3]));
  }
  add_chunk(out, "PLTE", colours);
  add_chunk(out, "tRNS", opacity);

  Bytes raw;
  raw.reserve((image.width + 1) * image.height);
  for (std::size_t row = 0; row < image.height; ++row) {
    raw.push_back(std::byte{0});  // rows are not filtered
    for (std::size_t i = 0; i < image.width; ++i)
      raw.push_back(static_cast<std::byte>(image.index[row * image.width + i]));
  }
  add_chunk(out, "IDAT", deflated(raw));
  add_chunk(out, "IEND", {});
  return out;
}

}  // namespace treadmark::io
