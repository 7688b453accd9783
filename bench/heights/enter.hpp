// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <initializer_list>

namespace treadmark::bench {

/// Enters a backend: heights level and tilted, with slopes, at points without a grid, and inverse evaluation, of wheel
/// and rail. resolutions_mm: of the samples; 0 = as given.
bool enter_heights(const char* backend, std::initializer_list<double> resolutions_mm);

}  // namespace treadmark::bench
