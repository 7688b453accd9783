// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as measured irregularities of a track; what is read is written and read again as the same.
#include <cstdlib>

#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_irregularities.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_irregularities) {
  try {
    treadmark::IrregularitySpec spec;
    spec.table = treadmark::io::parse_irregularity_text(treadmark::fuzz::as_text(data, size), "fuzz.csv");
    check(spec);
    const auto again =
        treadmark::io::parse_irregularity_text(treadmark::io::irregularity_text(*spec.table), "again.csv");
    if (again.distance != spec.table->distance || again.values != spec.table->values) std::abort();
  } catch (const treadmark::Error&) {
  }
  return 0;
}
