// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defects/moving_section.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::analytic {
namespace {

constexpr double kSteepest = 1.0;

/// A ramp max(t, 0) whose slope changes over r.
double rounded_ramp(double t, double r) {
  if (t <= -0.5 * r) return 0.0;
  if (t > 0.0) return t + rounded_ramp(-t, r);
  const double from_start = t + 0.5 * r;
  return 2.0 * from_start * from_start * from_start / (3.0 * r * r);
}

void check(const MovingSection& m) {
  const auto refuse = [](const char* message) { throw Error(ErrorKind::configuration, message); };
  for (const double number : {m.x, m.y, m.z, m.slope_y_before, m.slope_z_before, m.slope_y_after, m.slope_z_after,
                              m.length_before, m.length_after, m.rounding})
    if (!std::isfinite(number)) refuse("a moving section needs finite numbers");
  for (const double slope : {m.slope_y_before, m.slope_z_before, m.slope_y_after, m.slope_z_after})
    if (std::fabs(slope) > kSteepest) refuse("a section can move along the track with slopes of at most 1:1");
  if (!(m.rounding > 0.0)) refuse("the rounding of a moving section must be positive");
  if (!(std::min(m.length_before, m.length_after) > 0.5 * m.rounding))
    refuse("the lines of a moving section must be longer than half of the rounding between them");
}

}  // namespace

SectionOffset section_offset(const MovingSection& m, double x) {
  const double t = std::clamp(x - m.x, -m.length_before, m.length_after), ramp = rounded_ramp(t, m.rounding);
  return {m.y + m.slope_y_before * t + (m.slope_y_after - m.slope_y_before) * ramp,
          m.z + m.slope_z_before * t + (m.slope_z_after - m.slope_z_before) * ramp};
}

SliceSet moving_section_slices(const Profile& section, const MovingSection& m) {
  if (section.body != Body::rail)
    throw Error(ErrorKind::configuration, "the section of a wheel cannot move along the track");
  check(m);
  const double half = 0.5 * m.rounding;
  SliceSet slices;
  slices.name = section.name;
  // one more station on each line: splines have no joint at the second and the last but one
  for (const double t : {-m.length_before, -0.5 * (m.length_before + half), -half, 0.0, half,
                         0.5 * (half + m.length_after), m.length_after}) {
    slices.u.push_back(m.x + t);
    const SectionOffset offset = section_offset(m, m.x + t);
    Profile moved = section;
    for (double& y : moved.y) y += offset.y;
    for (double& z : moved.z) z += offset.z;
    slices.profiles.push_back(std::move(moved));
  }
  return slices;
}

}  // namespace treadmark::analytic
