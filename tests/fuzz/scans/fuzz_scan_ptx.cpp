// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "fuzz_scan.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_scan_ptx) {
  treadmark::fuzz::parse_scan(data, size, treadmark::io::scans::parse_ptx);
  return 0;
}
