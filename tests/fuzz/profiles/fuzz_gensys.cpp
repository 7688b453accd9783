// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "fuzz_profile.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_gensys) {
  treadmark::fuzz::read_both_bodies(data, size, treadmark::io::ProfileFormat::gensys);
  return 0;
}
