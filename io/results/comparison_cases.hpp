// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// Numbers of the cases worth a picture: the first, and those in which the errors of the largest pressure differ most
/// between the candidates (the truth's error is 0); equal ones in the order of the cases. At most count of them, in
/// the order of the cases. Thread-safe.
std::vector<int> telling_cases(const Comparison& comparison, std::size_t count);

/// Row or result of a case; null where the candidate has none.
const ComparisonRow* find_row(const ComparisonCandidate& candidate, int case_number);
const CaseResult* find_result(const ComparisonCandidate& candidate, int case_number);

/// The patch that carries most of the load; null without patches.
const PatchResult* main_patch(const CaseResult& result);

}  // namespace treadmark::io
