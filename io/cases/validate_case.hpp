// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// Checks that a case is complete, consistent and within what the program supports; throws Error (configuration) at the
/// position of the case otherwise.
void validate_case(const Case& c);

}  // namespace treadmark::io
