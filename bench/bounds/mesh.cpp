// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/bounds/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool mesh = enter_bounds("mesh", {1.0, 0.5, 0.25});
[[maybe_unused]] const bool mesh_flat = enter_bounds("mesh-flat", {1.0, 0.5, 0.25});

}  // namespace treadmark::bench
