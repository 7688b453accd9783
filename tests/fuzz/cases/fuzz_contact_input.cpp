// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a CONTACT input file: only treadmark::Error may leave the reader.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "treadmark/io/cases/read_inp.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    treadmark::io::parse_contact_input({reinterpret_cast<const char*>(data), size}, "fuzz.inp");
  } catch (const treadmark::Error&) {
  }
  return 0;
}
