// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/representation/example_cases.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"

namespace treadmark::testing {

io::WheelRailCase& wheel_rail(io::Case& c) { return std::get<io::WheelRailCase>(c.content); }

io::CaseFile wheel_flat_example(const std::vector<double>& pitch_deg) {
  io::CaseFile file = io::read_any_case(std::string(TREADMARK_SOURCE_DIR) + "/examples/wheel-flat.toml", {});
  std::vector<io::Case> chosen;
  for (const double pitch : pitch_deg) {
    const auto found = ranges::find_if(file.cases, [&](io::Case& c) {
      return std::fabs(wheel_rail(c).state.position.pitch * 180.0 / std::numbers::pi - pitch) < 1e-9;
    });
    if (found == file.cases.end()) throw std::logic_error("examples/wheel-flat.toml has no such pitch angle");
    chosen.push_back(*found);
  }
  file.cases = std::move(chosen);
  return file;
}

}  // namespace treadmark::testing
