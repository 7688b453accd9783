// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/bounds/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool offset = enter_bounds("offset", {1.0, 0.5, 0.25});
[[maybe_unused]] const bool offset_quadratic = enter_bounds("offset-quadratic", {1.0, 0.5, 0.25});
[[maybe_unused]] const bool offset_bilinear = enter_bounds("offset-bilinear", {1.0, 0.5, 0.25});

}  // namespace treadmark::bench
