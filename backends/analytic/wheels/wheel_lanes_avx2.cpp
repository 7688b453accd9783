// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#if defined(__AVX2__) && defined(__FMA__)
#include "treadmark/backends/analytic/wheels/wheel_lanes_kernel.hpp"

namespace treadmark::analytic {
WheelLanesKernel wheel_lanes_avx2() { return wheel_lanes; }
}  // namespace treadmark::analytic
#else
#include "treadmark/backends/analytic/wheels/wheel_lanes.hpp"

namespace treadmark::analytic {
WheelLanesKernel wheel_lanes_avx2() { return nullptr; }
}  // namespace treadmark::analytic
#endif
