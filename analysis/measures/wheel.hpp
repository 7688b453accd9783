// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "treadmark/analysis/measured/section.hpp"
#include "treadmark/analysis/measures/section.hpp"

namespace treadmark::measures {

/// Where a wheel is measured; the defaults are those of EN 15313.
struct WheelGauge {
  double tape_line = 70e-3;      ///< from the flange back [m]
  double face_depth = 10e-3;     ///< of the point on the flange face below the tape line: thickness, gradient [m]
  double below_tip = 2e-3;       ///< of the upper point of the gradient below the flange tip [m]
  double field_end = 55e-3;      ///< how far to the field side of the tape line the tread is looked at [m]
  bool placed = false;           ///< y = 0 of the section is the tape line where the flange back is not seen
  bool from_flange_back = true;  ///< y counts from the flange back; else it is that of the section
  std::optional<double> back;  ///< y of the flange back where it is known and the section does not show it for sure [m]
};

/// What one section of a wheel says. SI.
struct WheelMeasures {
  Measure flange_height;     ///< Sh: from the tape line to the tip
  Measure flange_thickness;  ///< Sd: from the flange back to the face
  Measure flange_gradient;   ///< qR: across, between the face and the point below the tip
  Measure flange_angle;      ///< largest inclination of the face [rad]
  Measure hollow;            ///< greatest rise of the radius from the tread towards the field side; 0: none
  Measure rollover;          ///< metal beyond the plane of the outer rim face
  Measure diameter;          ///< at the tape line, of a section whose nominal radius is known
  Measure rim_width;         ///< from the flange back to the outer rim face
  // against the nominal section
  Measure tread_wear;         ///< at the tape line, both tips at one height
  Measure flange_wear;        ///< across, of the faces at one depth below the tips, counted from the backs
  Measure area_lost;          ///< of nominal section between tip and field end, both tips at one height [m^2]
  Measure area_gained;        ///< outside the nominal section
  Measure diameter_lost;      ///< by the mildest re-profiling
  std::string reprofiled_to;  ///< the profile that it leads to; empty: unknown
  double shift_y = 0.0;       ///< from the section's axes to those of the measures: y = 0 at the tape line [m]
  double shift_z = 0.0;       ///< z = 0 there
  bool back_seen = false;     ///< whether y counts from the flange back
  std::vector<measured::Doubt> doubts;  ///< "nominal_profile": whether the nominal section is this wheel's
};

/// A nominal wheel section in its own axes: tape line at the origin, flange back at y = -70 mm.
struct NominalWheel {
  std::string name;
  Section section;
};

/// Measures a wheel. nominal_radius [m]: at z = 0 of the section's axes; 0: unknown. nominals: the first is what wear
/// is counted against, each of them may be the aim of the re-profiling; empty: none. What the section does not hold is
/// not measured, with the reason. The nominal section is doubted where the flange's back and tip lie off it, or metal
/// would have grown. Thread-safe. Errors: Error(input_data) for a section that does not look like a wheel
/// (a rail, upside down, no flange), or that does not reach the tape line.
WheelMeasures measure_wheel(const Section& section, const WheelGauge& gauge = {}, double nominal_radius = 0.0,
                            const std::vector<NominalWheel>& nominals = {});

}  // namespace treadmark::measures
