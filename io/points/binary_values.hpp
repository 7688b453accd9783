// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "treadmark/core/pose.hpp"

namespace treadmark::io::points {

/// A number in the bytes of a file.
template <class T>
T load(const char* from, bool big_endian = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, from, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof(T));
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

/// Three floats.
inline Vec3 load_floats(const char* from, bool big_endian = false) {
  return Eigen::Vector3f(load<float>(from, big_endian), load<float>(from + 4, big_endian),
                         load<float>(from + 8, big_endian))
      .cast<double>();
}

/// Appends little-endian bytes.
template <class T>
void put(std::string& out, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof(T));
  out.append(raw, sizeof(T));
}

}  // namespace treadmark::io::points
