// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark {

/// A railway line as plain data in SI units: elements one behind the other, seen from its beginning. Signs (see
/// docs/layout.md): curvature is positive to the right; cant, which is how much higher the left rail lies than the
/// right one, is therefore positive where it helps in a right-hand curve.

/// How curvature, cant and gauge go from the beginning of an element to its end.
enum class TransitionShape {
  linear,  ///< of curvature: a clothoid; of cant: a straight ramp
  bloss,   ///< 3u^2 - 2u^3 (Bloss 1936): slopes vanish at both ends
  rising,  ///< u^2, into a linear one: see rounded
  easing,  ///< 2u - u^2, out of a linear one
};

/// About what the track is turned by cant.
enum class CantAxis {
  centre,    ///< the track centre line keeps its height
  low_rail,  ///< the lower rail keeps its height: the centre line rises by half the cant
};

/// A number at the beginning and at the end of an element.
struct FromTo {
  double from = 0.0, to = 0.0;  ///< in the unit of the member
};

/// A piece of line. Straights and circles have equal ends.
struct LayoutElement {
  double length = 0.0;  ///< along the centre line in plan [m]; > 0
  FromTo curvature;     ///< [1/m]
  FromTo cant;          ///< [m]
  FromTo gauge;         ///< [m]
  TransitionShape shape = TransitionShape::linear;
  SourcePosition where;
};

/// Before the beginning and behind the end a line goes on with the curvature, cant and gauge that it has there.
struct TrackLayout {
  std::vector<LayoutElement> elements;
  double cant_base = 1.5;  ///< distance of the running circles, over which cant is measured [m]
  CantAxis cant_axis = CantAxis::centre;
  SourcePosition where;

  double length() const;  ///< of all elements [m]
};

inline constexpr double kTightestRadius = 10.0;  ///< of a curve [m]
inline constexpr double kLongestLine = 1e6;      ///< [m]

/// The same line with its kinks rounded over twice this length [m], or half of the shorter
/// element: where curvature and
/// cant begin or end to change linearly, and where the curvature steps. Headings of straights and circles stay.
TrackLayout rounded(const TrackLayout& layout, double half_length);

/// Errors: Error(configuration) at the element: lengths that are not positive, curves tighter than kTightestRadius,
/// cant of more than half its base, gauges that are not positive, steps of cant or gauge between elements (a step of
/// curvature is none of the rails), cant of both signs in one element about the low rail.
void check(const TrackLayout& layout);

}  // namespace treadmark
