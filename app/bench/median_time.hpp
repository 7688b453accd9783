// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>

namespace treadmark::app {

/// Median time of one call [s]: a first call does not count, then calls until the given seconds have passed and there
/// are at least three. Where one thread is allowed its processor time counts, which other programs lengthen less, else
/// the time of day.
double median_time(const std::function<void()>& call, double seconds);

}  // namespace treadmark::app
