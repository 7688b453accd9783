// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "fuzz_scan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  treadmark::fuzz::parse_scan(data, size, treadmark::io::scans::parse_ptx);
  return 0;
}
