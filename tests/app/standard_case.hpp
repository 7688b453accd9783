// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::testing {

inline const std::string kWheelWithFlat =
    "shape.standard = \"S1002\"\n[[wheel.flats]]\nlength_mm = 60\ndepth_mm = 0.3\n";

/// A wheel, given by the keys of [wheel], rolls freely on 60E1, as a case file with elements of this size. more: what
/// follows.
inline std::string standard_case(const char* element_mm, const std::string& wheel = "shape.standard = \"S1002\"\n",
                                 const std::string& more = {}) {
  return "[wheel]\n" + wheel +
         "[rail]\nshape.standard = \"60E1\"\n"
         "[track]\ncant = \"1:40\"\n"
         "[wheelset]\nvertical_force_N = 80e3\nvelocity_m_s = 2\nvpitch_rad_s = -4.3478\n"
         "[discretisation]\ndx_mm = " +
         element_mm + "\nds_mm = " + element_mm + "\n" + more;
}

/// A wheel with a flat, at it and beside it.
inline std::string flat_wheel_case() {
  return standard_case("1.0", kWheelWithFlat, "[[cases]]\nwheelset.pitch_deg = [0, 2]\n");
}

}  // namespace treadmark::testing
