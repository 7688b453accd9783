// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// A comparison as aligned columns for people, one line a candidate, units in the head; "-" where nothing was measured.
/// Errors are the largest over the cases, times the mean per case. Below: what failed and the notes of the builders.
/// Ends in a newline. Thread-safe.
std::string comparison_table(const Comparison& comparison);

}  // namespace treadmark::io
