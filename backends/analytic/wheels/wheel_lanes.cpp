// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/wheel_lanes.hpp"

#include "treadmark/core/cpu.hpp"

namespace treadmark::analytic {

WheelLanesKernel wheel_lanes_kernel() {
  static const WheelLanesKernel kernel =
      cpu_has_avx2() && wheel_lanes_avx2() != nullptr ? wheel_lanes_avx2() : wheel_lanes_generic();
  return kernel;
}

}  // namespace treadmark::analytic
