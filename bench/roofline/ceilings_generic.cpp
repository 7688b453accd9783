// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/roofline/ceilings_kernel.hpp"

namespace treadmark::bench {

Ceilings ceilings_generic() { return kCeilings; }

}  // namespace treadmark::bench
