// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/tests/support/refusal.hpp"

namespace treadmark::io::testing {

inline constexpr double kDegree = kPi / 180.0;  // rad

/// The content of the case at a place of its file; of another kind: an exception, which fails the test.
inline const WheelRailCase& rail_case(const CaseFile& f, std::size_t i) {
  return std::get<WheelRailCase>(f.cases.at(i).content);
}
inline const BasicCase& basic_case(const CaseFile& f, std::size_t i) {
  return std::get<BasicCase>(f.cases.at(i).content);
}

/// The least that a case of a wheel on a rail says.
inline const std::string kRail =
    "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1e5\n";

/// Reads a case file, and what a user is told where it must not be read.
inline CaseFile parse_study(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_case_text(text, "folder/study.toml", overrides);
}
inline std::string study_refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return treadmark::testing::refusal_of([&] { parse_study(text, overrides); }, ErrorKind::configuration);
}

/// What must not be read, and a part of what a user is told.
struct Wrong {
  std::string text, expected;
};

}  // namespace treadmark::io::testing
