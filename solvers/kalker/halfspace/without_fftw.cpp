// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"

namespace treadmark::kalker {

std::shared_ptr<const FftPlan> make_fft_plan(int nx, int ny, int active_rows) {
  return make_lanes_fft_plan(nx, ny, active_rows);
}

}  // namespace treadmark::kalker
