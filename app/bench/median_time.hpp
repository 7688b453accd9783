// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>

namespace treadmark::app {

/// Median time of one call [s]: a first call does not count, then calls until their times add up to the given seconds and
/// there are at least three.
double median_time(const std::function<void()>& call, double seconds);

}  // namespace treadmark::app
