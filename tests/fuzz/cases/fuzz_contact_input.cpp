// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a CONTACT input file: only treadmark::Error may leave the reader.

#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_contact_input) {
  try {
    treadmark::io::parse_contact_input(treadmark::fuzz::as_text(data, size), "fuzz.inp");
  } catch (const treadmark::Error&) {
  }
  return 0;
}
