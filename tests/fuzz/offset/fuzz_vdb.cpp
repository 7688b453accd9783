// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cstddef>
#include <cstdint>
#include <fstream>

#include "temporary_file.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/core/error.hpp"

/// Any bytes as a file. Nearly all end at the check sum; fuzz_vdb_content goes past it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const treadmark::fuzz::TemporaryFile file("fuzz_vdb");
  std::ofstream(file.path(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    treadmark::offset::read_vdb(file.path());
  } catch (const treadmark::Error&) {
  }
  return 0;
}
