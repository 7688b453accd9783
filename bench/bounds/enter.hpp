// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <initializer_list>

namespace treadmark::bench {

/// Enters a backend: conservative bounds over squares of 1, 5 and 25 mm, of wheel and rail.
/// resolutions_mm: of the samples; 0 = as given.
bool enter_bounds(const char* backend, std::initializer_list<double> resolutions_mm);

}  // namespace treadmark::bench
