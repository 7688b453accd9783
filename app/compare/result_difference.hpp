// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/results/quantities.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Where two results differ most in one quantity.
struct QuantityDifference {
  std::string key;           ///< "object.key" of the quantity, as in JSON
  std::string_view meaning;  ///< of the quantity, or of the group that it begins or belongs to
  int case_number = 0;
  int patch = 0;            ///< from 1; 0: a number of the case
  double a = 0.0, b = 0.0;  ///< in the unit of the JSON file
  double relative = 0.0;    ///< see compare_results
  double sigmas = NAN;      ///< |a - b| over its standard deviation, where one of both results knows its own
  io::Unit unit = {};       ///< of both numbers
  double si_a = 0.0, si_b = 0.0;
};

struct ResultDifference {
  std::vector<std::string> unmatched;          ///< what one of them lacks, and cases that ended differently, in words
  std::vector<QuantityDifference> quantities;  ///< one of every quantity that both have, largest first
};

/// Compares all numbers of cases and patches (io/results/quantities.hpp) but times; cases are matched by their numbers,
/// patches by their order. relative: |a - b| over the larger of the two sizes, but at least over a thousandth of the
/// largest size that the quantity has anywhere in either result, so that rounding about zero does not count.
ResultDifference compare_results(const io::RunResult& a, const io::RunResult& b);

/// Whether everything is matched and no difference is beyond a relative tolerance.
bool agree(const ResultDifference& difference, double tolerance);

}  // namespace treadmark::app
