// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/slices.hpp"

namespace treadmark::spline {

/// Slices cut along their kinks: each part of the sections is a surface of its own, so that it may turn sharply where
/// the next one begins; both have the same edge. Without kinks the slices themselves. Errors: Error(input_data) for a
/// kink that is not an inner feature, or kinks that do not increase.
std::vector<SliceSet> split_at_kinks(const SliceSet& slices);

}  // namespace treadmark::spline
