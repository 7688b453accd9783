// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail {

/// Errors: Error(configuration) for numbers that are not finite or have no meaning, and for settings that exclude each
/// other.
void validate(const Problem& problem);

}  // namespace treadmark::wheelrail
