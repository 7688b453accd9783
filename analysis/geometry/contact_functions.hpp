// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/analysis/geometry/radius_difference.hpp"
#include "treadmark/analysis/geometry/wheelset_on_track.hpp"

namespace treadmark::geometry {

/// A contact that changes its place at once while the wheelset is shifted.
struct Jump {
  Position before, after;  ///< at the same shift, within kJumpWidth
  bool right = true;       ///< side that jumps
};
inline constexpr double kJumpWidth = 1e-7;   ///< to which a jump's shift is bisected [m]
inline constexpr double kJumpLength = 1e-3;  ///< what moves less on wheel and rail between two rows is no jump [m]

/// A contact besides the first one.
struct FurtherTouch {
  double y = 0.0;  ///< shift [m]
  bool right = true;
  Touch touch;  ///< gap: above that of the first contact [m]
};

/// What ends the shifts that a wheelset can make to one side.
struct ShiftLimit {
  bool limited = false;  ///< false: the rows end there because no more were asked for
  double y = 0.0;        ///< of the last sound row [m]
  std::string reason;    ///< "the right wheel has climbed over its flange"
};

/// Contact over the shift of the wheelset.
struct ContactFunctions {
  double step = 0.0;                 ///< between rows [m]
  std::vector<Position> rows;        ///< sound ones only, y increasing
  std::vector<Jump> jumps;           ///< y increasing
  std::vector<FurtherTouch> others;  ///< only where they were asked for
  ShiftLimit to_left, to_right;      ///< ends of the rows
};

struct FunctionSettings {
  double step = 0.1e-3;     ///< of the shift [m]
  double farthest = 10e-3;  ///< shifts are looked at from - to + this [m]
  double second = 0.0;      ///< further contacts with gaps up to this are looked for; 0: none [m]
};

/// Rows over shifts about 0 up to where the wheelset can be. Errors: Error(numerical) where it cannot be in the middle
/// of the track or between its flanges: it falls through the gauge, its flanges jam between the rails, a profile is too
/// short. Each names what it is.
ContactFunctions contact_functions(const WheelsetOnTrack& wheelset, const FunctionSettings& settings);

/// Difference of rolling radii over the shift, with its jumps.
RadiusDifference radius_difference(const ContactFunctions& functions);

}  // namespace treadmark::geometry
