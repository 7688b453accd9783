// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/heights/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool mesh = enter_heights("mesh", {1.0, 0.5, 0.25});
[[maybe_unused]] const bool mesh_flat = enter_heights("mesh-flat", {1.0, 0.5, 0.25});

}  // namespace treadmark::bench
