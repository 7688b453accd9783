// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/report/pictures/png_reader.hpp"

#include <zlib.h>

#include <stdexcept>

namespace treadmark::testing {
namespace {

std::uint32_t number(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i) out = out << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return out;
}

std::uint32_t crc(std::span<const std::byte> bytes) {
  std::uint32_t out = 0xFFFFFFFFu;
  for (const std::byte b : bytes) {
    out ^= std::to_integer<std::uint32_t>(b);
    for (int bit = 0; bit < 8; ++bit) out = out >> 1 ^ (out & 1u ? 0xEDB88320u : 0u);
  }
  return ~out;
}

void need(bool good, const char* what) {
  if (!good) throw std::runtime_error(what);
}

}  // namespace

PngImage read_png(std::span<const std::byte> bytes) {
  static constexpr unsigned char kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  need(bytes.size() > 8, "no signature");
  for (std::size_t i = 0; i < 8; ++i) need(std::to_integer<unsigned char>(bytes[i]) == kSignature[i], "signature");
  PngImage image;
  std::string order;
  std::span<const std::byte> palette, opacity, data;
  for (std::size_t at = 8; at < bytes.size();) {
    need(at + 12 <= bytes.size(), "chunk cut off");
    const std::size_t length = number(bytes, at);
    need(at + 12 + length <= bytes.size(), "chunk too long");
    const std::string name(reinterpret_cast<const char*>(bytes.data() + at + 4), 4);
    const auto body = bytes.subspan(at + 8, length);
    need(crc(bytes.subspan(at + 4, 4 + length)) == number(bytes, at + 8 + length), "CRC");
    order += name + " ";
    if (name == "IHDR") {
      need(length == 13, "IHDR");
      image.width = number(body, 0);
      image.height = number(body, 4);
      const int wanted[5] = {8, 3, 0, 0, 0};
      for (std::size_t i = 0; i < 5; ++i) need(std::to_integer<int>(body[8 + i]) == wanted[i], "not an 8-bit palette");
    }
    if (name == "PLTE") palette = body;
    if (name == "tRNS") opacity = body;
    if (name == "IDAT") data = body;
    at += 12 + length;
  }
  need(order == "IHDR PLTE tRNS IDAT IEND ", "order of chunks");
  need(palette.size() % 3 == 0 && opacity.size() * 3 <= palette.size(), "palette");

  std::vector<unsigned char> raw(image.height * (image.width + 1) + 1);
  uLongf size = static_cast<uLongf>(raw.size());
  need(::uncompress(raw.data(), &size, reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size())) ==
           Z_OK,
       "deflated data");
  need(size + 1 == raw.size(), "number of pixels");
  for (std::size_t row = 0; row < image.height; ++row) {
    need(raw[row * (image.width + 1)] == 0, "filter");
    for (std::size_t i = 0; i < image.width; ++i) {
      const std::size_t index = raw[row * (image.width + 1) + 1 + i];
      need(3 * index + 2 < palette.size(), "index beyond the palette");
      const auto of = [](std::byte b) { return std::to_integer<int>(b); };
      image.pixels.push_back({of(palette[3 * index]), of(palette[3 * index + 1]), of(palette[3 * index + 2]),
                              index < opacity.size() ? of(opacity[index]) : 255});
    }
  }
  return image;
}

std::vector<std::byte> from_base64(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::byte> out;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    need(digit != std::string::npos, "not base64");
    group = group << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8) out.push_back(static_cast<std::byte>(group >> (bits -= 8) & 0xFFu));
  }
  return out;
}

}  // namespace treadmark::testing
