// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace treadmark::fuzz {

/// One reader that takes any bytes.
struct Target {
  const char* name;  ///< that of its source
  int (*run)(const std::uint8_t* data, std::size_t size);
};

/// All of the program: one under libFuzzer, many in the program that replays.
inline std::vector<Target>& targets() {
  static std::vector<Target> all;
  return all;
}

inline bool add_target(const char* name, int (*run)(const std::uint8_t*, std::size_t)) {
  targets().push_back({name, run});
  return true;
}

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace treadmark::fuzz

/// Begins a function of `data` and `size` that returns 0, as LLVMFuzzerTestOneInput does.
#define TREADMARK_FUZZ_TARGET(name)                                                              \
  static int name(const std::uint8_t* data, std::size_t size);                                   \
  [[maybe_unused]] static const bool name##_added = treadmark::fuzz::add_target(#name, &(name)); \
  static int name(const std::uint8_t* data, std::size_t size)
