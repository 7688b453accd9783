// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/wheel_lanes_kernel.hpp"

namespace treadmark::analytic {

WheelLanesKernel wheel_lanes_generic() { return wheel_lanes; }

}  // namespace treadmark::analytic
