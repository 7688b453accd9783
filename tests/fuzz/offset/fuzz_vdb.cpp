// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"

/// Any bytes as a file. Nearly all end at the check sum; fuzz_vdb_content goes past it.
TREADMARK_FUZZ_TARGET(fuzz_vdb) {
  static const treadmark::fuzz::TemporaryFile file("fuzz_vdb", ".vdb");
  try {
    treadmark::offset::read_vdb(file.hold(treadmark::fuzz::as_text(data, size)));
  } catch (const treadmark::Error&) {
  }
  return 0;
}
