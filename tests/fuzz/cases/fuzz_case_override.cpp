// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a --set override of a small case: only treadmark::Error may leave the reader.

#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_case_override) {
  static const treadmark::io::CaseFile base = treadmark::io::parse_case_text(
      "rail.shape.standard = '60E1'\nwheel.shape.standard = 'S1002'\nwheelset.z_mm = 1\n"
      "wheel.flats = [ { length_mm = 30, depth_mm = 1 } ]\n",
      "fuzz.toml");
  treadmark::io::Case c = base.cases.front();
  try {
    treadmark::io::apply_override(c, treadmark::fuzz::as_text(data, size));
  } catch (const treadmark::Error&) {
  }
  return 0;
}
