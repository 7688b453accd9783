// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_splines) {
  if (!treadmark::has_part("expat")) return 0;
  try {
    treadmark::io::parse_splines(treadmark::fuzz::as_text(data, size), "fuzz.xml");
  } catch (const treadmark::Error&) {
    // a fair answer
  }
  return 0;
}
