// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a simulation beside the examples, whose vehicles and tracks it may name.
#include <filesystem>

#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_simulation) {
  static const std::filesystem::path name = std::filesystem::path(TREADMARK_SOURCE_DIR) / "examples" / "fuzz.toml";
  try {
    treadmark::io::parse_simulation_text(treadmark::fuzz::as_text(data, size), name);
  } catch (const treadmark::Error&) {
  }
  return 0;
}
