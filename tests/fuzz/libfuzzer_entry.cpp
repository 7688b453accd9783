// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Linked into every program of one target for libFuzzer.
#include "treadmark/tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return treadmark::fuzz::targets().front().run(data, size);
}
