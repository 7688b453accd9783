// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

bool operator==(const ProfileOptions& a, const ProfileOptions& b) {
  const SmoothingOptions &s = a.smoothing, &t = b.smoothing;
  return a.mirror_y == b.mirror_y && a.mirror_z == b.mirror_z && a.placement == b.placement &&
         a.back_told == b.back_told && a.scale == b.scale && s.method == t.method && s.strength == t.strength &&
         s.kink_high == t.kink_high && s.kink_low == t.kink_low && s.kink_width == t.kink_width &&
         a.zigzag_threshold == b.zigzag_threshold && a.max_omit == b.max_omit && a.error_handling == b.error_handling;
}

double rolling_rate(const WheelRailCase& c) {
  const double rolled = c.roller ? c.roller->pitch_rate * c.roller->nominal_radius : c.state.velocity.x;
  return -rolled / c.wheelset.nominal_radius;
}

}  // namespace treadmark::io
