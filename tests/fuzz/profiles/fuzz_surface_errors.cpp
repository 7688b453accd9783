// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/surface_doubts.hpp"
#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_surface_errors) {
  std::istringstream text{std::string(treadmark::fuzz::as_text(data, size))};
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  treadmark::to_lines(treadmark::doubts_of_lines(lines));
  try {
    if (const auto errors = treadmark::errors_of_lines(lines)) treadmark::to_lines(*errors);
  } catch (const treadmark::Error&) {
  }
  return 0;
}
