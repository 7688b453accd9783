// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/heights/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool spline = enter_heights("spline", {1.0, 0.5, 0.25});

}  // namespace treadmark::bench
