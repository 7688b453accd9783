// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark {

/// Values as bytes of this machine's order, to be read again by ByteReader in the same order: for checkpoints, not for
/// exchange. Floating-point numbers keep every bit. Not thread-safe.
class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void put(T value) { append(&value, sizeof value); }
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void put(std::span<const T> values) {
    put(values.size());
    if (!values.empty()) append(values.data(), values.size_bytes());
  }
  void put(const std::vector<double>& values) { put(std::span<const double>(values)); }
  void put(const std::string& text) { put(std::span<const char>(text)); }

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void append(const void* first, std::size_t size);

  std::vector<std::byte> bytes_;
};

/// Errors: Error(input_data) where bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void get(T& value) {
    const auto bytes = take(sizeof value);
    if constexpr (std::is_same_v<T, bool>)
      value = bytes.front() != std::byte{0};  // no other bytes are values of it
    else
      std::memcpy(&value, bytes.data(), sizeof value);
  }
  template <class T>
  T get() {
    T value{};
    get(value);
    return value;
  }
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void get(std::vector<T>& values) {
    const auto count = get<std::size_t>();
    if (count > rest_.size() / sizeof(T)) end_of_bytes();
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), take(count * sizeof(T)).data(), count * sizeof(T));
  }
  void get(std::string& text) {
    std::vector<char> characters;
    get(characters);
    text.assign(characters.begin(), characters.end());
  }
  bool at_end() const { return rest_.empty(); }

 private:
  [[noreturn]] static void end_of_bytes() {
    throw Error(ErrorKind::input_data, "a saved state ends too early", {}, "start anew");
  }
  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) end_of_bytes();
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  std::span<const std::byte> rest_;
};

}  // namespace treadmark
