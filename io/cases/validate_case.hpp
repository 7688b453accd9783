// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

inline constexpr long kMostElements = 4000000;  ///< of a potential contact

/// Checks that a case is complete, consistent and within what the program supports; throws Error (configuration) at the
/// position of the case otherwise.
void validate_case(const Case& c);

/// Lets the first case of each sequence start, as it has nothing to continue, and checks that the others fit to what
/// they continue; throws like validate_case. notes: gets a remark on rolling steps that do not fit the positions, which
/// are errors where they are too long; null: steps are not looked at.
void settle_sequences(std::vector<Case>& cases, std::vector<std::string>* notes = nullptr);

}  // namespace treadmark::io
