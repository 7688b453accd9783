// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// Derivatives of all cases that have them: a line for each number of a case, a column for each key by which any case
/// has some, "wheelset.y_mm"; empty cells where a case has none. Empty text where no case has any.
std::string derivatives_csv(const RunResult& run);

/// Those of one case for people: a line for each number, keys beside each other, and what is left out and why.
std::string derivatives_text(const CaseDerivatives& derivatives);

/// The source of most of the variance of a number, "72 % wheelset.y_mm"; empty where no share is known.
std::string dominant_source(const CaseUncertainty& uncertainty, const CaseUncertainty::Number& number);
/// A line for each number that is not certain: "pmax_MPa = 1790 +- 140", for people.
std::string uncertainty_text(const CaseUncertainty& uncertainty);

}  // namespace treadmark::io
