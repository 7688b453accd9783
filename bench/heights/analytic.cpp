// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/heights/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool analytic = enter_heights("analytic", {0.0});

}  // namespace treadmark::bench
