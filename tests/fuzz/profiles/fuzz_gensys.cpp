// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "fuzz_profile.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  treadmark::fuzz::read_both_bodies(data, size, treadmark::io::ProfileFormat::gensys);
  return 0;
}
