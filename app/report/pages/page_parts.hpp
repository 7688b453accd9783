// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// What every result says about its origin.
struct Origin {
  std::string version, git, input_file, input_sha256;
  std::vector<std::pair<std::string, std::string>> geometry_sha256;
  std::vector<std::string> settings;
};

/// Version, input and settings as facts.
Facts origin_facts(const Origin& origin);

/// A number with the 12 digits of the result files, so that a page is the same from a result and from its files; NaN
/// where it is not finite.
double in_file(double value);

/// "wheel-flat" of "some/where/wheel-flat.toml"; "result" of nothing.
std::string title_of(const std::string& input_file);

/// "1 case", "3 cases".
std::string counted(std::size_t count, const std::string& word);

/// Seconds as people say them: "0.53 s", "2 min 5 s", "1 h 12 min".
std::string duration_text(double seconds);

/// Forces in N, or in kN where some are larger than 2 kN: factor and unit.
std::pair<double, std::string> force_unit(const std::vector<double>& newtons);

}  // namespace treadmark::app::report
