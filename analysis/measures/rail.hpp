// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "treadmark/analysis/measured/section.hpp"
#include "treadmark/analysis/measures/section.hpp"

namespace treadmark::measures {

/// How a measured rail is laid upon its nominal section.
enum class RailAlignment {
  unworn,  ///< least squares, with rotation, of what does not wear: field side, underside of the head, web, foot
  top,     ///< tops at one height, gauge sides 14 mm below at one place: hides wear there by construction
  none,    ///< as it lies in its own axes
};
/// "unworn", "top", "none".
std::string_view name_of(RailAlignment alignment);

/// Where a rail is measured. Gauge side: y < 0.
struct RailGauge {
  double side_depth = 14e-3;            ///< of the side wear below the nominal top; of the head width below the top [m]
  double oblique = 0.7853981633974483;  ///< inclination of the oblique wear [rad]
  double face_from = 10e-3, face_to = 25e-3;  ///< depths between which the worn gauge face is looked at [m]
  double crown_half = 10e-3;                  ///< half width over which the crown's radius is fitted [m]
  RailAlignment alignment = RailAlignment::unworn;
};

/// What one section of a rail says. SI; wear is positive where metal is missing.
struct RailMeasures {
  Measure w1;          ///< vertical, at the middle of the section
  Measure w2;          ///< sideways, on the gauge side
  Measure w3;          ///< along the normal where the nominal section is inclined by 45 degrees
  Measure equivalent;  ///< w1 + w2/2
  Measure loss;        ///< of area of the head, down to the lower end of the nominal sides [m^2]
  Measure loss_top;    ///< the part of it between the places where the nominal section is inclined by 45 degrees [m^2]
  Measure loss_side;   ///< the rest [m^2]
  Measure loss_part;   ///< of the nominal head's area
  Measure lip;         ///< area outside the nominal section [m^2]
  Measure face_angle;  ///< inclination of the gauge face, a right angle = upright [rad]
  Measure head_width;
  Measure crown_radius;
  Measure inclination;  ///< of the section in its own axes, positive towards the gauge side [rad]
  double lost_gauge = kUnknown, lost_field = kUnknown;  ///< of both sides, mean from side_depth down to their nominal
                                                        ///< lower end [m]; the field side does not wear
  RailAlignment alignment = RailAlignment::none;        ///< that was used
  double shift_y = 0.0, shift_z = 0.0;                  ///< of the section onto the nominal one, after the turn [m]
  double residual = kUnknown;                           ///< of the parts that were laid upon each other, rms [m]
  std::vector<measured::Doubt> doubts;  ///< "nominal_profile": whether the nominal section is this rail's
};

/// Measures a rail against a nominal section (its whole outline or its head, crown at the origin), which may be null:
/// then only what needs none. What cannot be measured has a reason. A nominal section is doubted where what does not
/// wear lies off it by more than rails are rolled to, or metal would have grown. Thread-safe. Errors: Error(input_data)
/// for a section that does not look like a rail (a wheel, upside down), or where the alignment that is asked for has
/// nothing to hold on.
RailMeasures measure_rail(const Section& section, const Section* nominal, const RailGauge& gauge = {});

}  // namespace treadmark::measures
