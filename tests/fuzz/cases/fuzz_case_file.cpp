// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a Treadmark case file: only treadmark::Error may leave the reader.

#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_case_file) {
  try {
    treadmark::io::parse_case_text(treadmark::fuzz::as_text(data, size), "fuzz.toml");
  } catch (const treadmark::Error&) {
  }
  return 0;
}
