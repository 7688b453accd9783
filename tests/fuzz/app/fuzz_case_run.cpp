// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A whole command: text of a case file, read, checked and solved.
#include "small_run.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_case_run) {
  using namespace treadmark;
  try {
    fuzz::run_if_small(io::parse_case_text(fuzz::as_text(data, size), "fuzz.toml"));
  } catch (const Error&) {
  }
  return 0;
}
