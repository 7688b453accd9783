// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/bounds/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool nurbs = enter_bounds("nurbs", {1.0, 0.5, 0.25});

}  // namespace treadmark::bench
