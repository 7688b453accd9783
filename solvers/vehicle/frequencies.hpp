// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

namespace treadmark::vehicle {

/// So many frequencies by equal ratios, both ends among them [Hz]. Errors: Error(configuration) unless 0 < from < to
/// and count > 1. Thread-safe.
std::vector<double> frequencies(double from, double to, int count);

}  // namespace treadmark::vehicle
