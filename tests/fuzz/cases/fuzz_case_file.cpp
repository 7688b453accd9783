// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a Treadmark case file: only treadmark::Error may leave the reader.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "treadmark/io/cases/read_toml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    treadmark::io::parse_case_text({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  } catch (const treadmark::Error&) {
  }
  return 0;
}
