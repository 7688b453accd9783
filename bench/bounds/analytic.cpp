// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/bounds/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool analytic = enter_bounds("analytic", {0.0});

}  // namespace treadmark::bench
