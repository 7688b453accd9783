// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a vehicle: only treadmark::Error may leave the reader.
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_vehicle) {
  try {
    treadmark::io::parse_vehicle_text(treadmark::fuzz::as_text(data, size), "fuzz.toml");
  } catch (const treadmark::Error&) {
  }
  return 0;
}
