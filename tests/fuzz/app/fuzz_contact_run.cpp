// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A whole command: text of an input file of CONTACT, read, checked and solved.
#include "small_run.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_contact_run) {
  using namespace treadmark;
  try {
    fuzz::run_if_small(io::parse_contact_input(fuzz::as_text(data, size), "fuzz.inp"));
  } catch (const Error&) {
  }
  return 0;
}
