// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a study with the tables of its base in it.
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"

TREADMARK_FUZZ_TARGET(fuzz_study) {
  static const treadmark::fuzz::TemporaryFile file("fuzz_study", ".toml");
  try {
    treadmark::io::read_study_file(file.hold(treadmark::fuzz::as_text(data, size)));
  } catch (const treadmark::Error&) {
  }
  return 0;
}
