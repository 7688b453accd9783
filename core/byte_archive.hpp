// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/grid.hpp"

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

/// Another one for any change of one byte, which would go on as another state (Fowler, Noll and Vo: FNV-1a, 64 bits).
std::uint64_t check_sum(std::span<const std::byte> bytes);

[[noreturn]] inline void refuse_saved_state(const char* what) {
  throw Error(ErrorKind::input_data, std::string("a saved state is damaged: ") + what, {}, "start anew");
}

inline void write(const Grid2& grid, ByteWriter& out) {
  for (const double value : {grid.x0, grid.y0, grid.dx, grid.dy}) out.put(value);
  for (const int value : {grid.nx, grid.ny}) out.put(value);
}

/// Errors: Error(input_data) for numbers that are not finite, or steps and counts that no grid has. A grid without
/// points may have any steps.
inline Grid2 read_grid(ByteReader& in) {
  Grid2 grid;
  for (double* value : {&grid.x0, &grid.y0, &grid.dx, &grid.dy}) {
    in.get(*value);
    if (!std::isfinite(*value)) refuse_saved_state("a grid is not finite");
  }
  for (int* value : {&grid.nx, &grid.ny}) in.get(*value);
  const bool none = grid.nx == 0 && grid.ny == 0;
  if (!none && (grid.nx < 1 || grid.ny < 1 || !(grid.dx > 0.0) || !(grid.dy > 0.0)))
    refuse_saved_state("a grid has no elements");
  return grid;
}

/// Values on a grid: one for each point, or none where that is allowed.
/// Errors: Error(input_data) for another number of values or one that is not a number.
inline void read_field(ByteReader& in, const Grid2& grid, bool may_be_empty, std::vector<double>& field) {
  in.get(field);
  if (field.size() != grid.size() && !(may_be_empty && field.empty()))
    refuse_saved_state("a field does not fit its grid");
  for (const double value : field)
    if (std::isnan(value)) refuse_saved_state("a field holds what is not a number");
}

}  // namespace treadmark
