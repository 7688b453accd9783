// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark::testing {

inline std::string decode_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (digit < 0) throw std::runtime_error("not base64");
    group = group << 6 | static_cast<std::uint32_t>(digit);
    if ((bits += 6) >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255u);
  }
  return bytes;
}

/// Values of a DataArray: the header and the data are two base64 texts, the first of 8 bytes (12 digits).
template <class T>
std::vector<T> vtk_values(const XmlElement& root, const std::string& name) {
  const std::string& text = root.find("DataArray", "Name", name).at(0)->text;
  const std::string header = decode_base64(text.substr(0, 12)), data = decode_base64(text.substr(12));
  std::uint64_t size = 0;
  std::memcpy(&size, header.data(), sizeof size);
  if (size != data.size()) throw std::runtime_error("an array of another size than it says");
  std::vector<T> out(data.size() / sizeof(T));
  std::memcpy(out.data(), data.data(), out.size() * sizeof(T));
  return out;
}

}  // namespace treadmark::testing
