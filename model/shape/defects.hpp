// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark {

/// Damage and machining of running surfaces, as parametrised shapes on any wheel or rail. All lengths in metres, angles
/// in radians. Wheel shapes change the radius, rail shapes the height z (down): every depth is positive where material
/// is gone. Lateral positions are profile coordinates y; width 0 = the whole profile. Formulas and pictures:
/// docs/defects.md.

/// A flat worn into a wheel.
struct WheelFlat {
  /// How the flat ends.
  enum class Shape {
    fresh,    ///< chord: dr(theta) of a straight cut; depth follows from the length
    rounded,  ///< depth/2 (1 + cos(2 pi x / length)) along the circumference
  };
  Shape shape = Shape::rounded;
  double length = 0.0;        ///< along the circumference at the nominal radius
  double depth = 0.0;         ///< greatest radial depth; rounded only (fresh: length^2/(8 R) exactly by the chord)
  double theta_center = 0.0;  ///< material angle of the middle
  double y_center = 0.0;      ///< lateral middle
  double width = 0.0;         ///< full lateral width over which the depth fades to 0 by 1/2 (1 + cos)
  double edge_radius = 0.0;   ///< of the rounded edges of a fresh flat, along the circumference; 0: sharp
  friend bool operator==(const WheelFlat&, const WheelFlat&) = default;
};

/// An out-of-round wheel: dr(theta) = sum of amplitude cos(order theta - phase), over the lateral band of y_center,
/// width. Order 1 is an eccentric wheel, order 2 an oval one; polygonal wheels have orders of about 6 to 30.
struct Polygonization {
  /// One wave round the circumference.
  struct Harmonic {
    int order = 0;           ///< waves round the circumference, >= 1
    double amplitude = 0.0;  ///< half of peak to peak
    double phase = 0.0;      ///< the radius is greatest at theta = phase/order
    friend bool operator==(const Harmonic&, const Harmonic&) = default;
  };
  std::vector<Harmonic> harmonics;
  double y_center = 0.0, width = 0.0;  ///< fades as a flat does
  friend bool operator==(const Polygonization&, const Polygonization&) = default;
};

/// A squat: a kidney-like depression of the running band, with one dip or two behind each other (the typical two
/// lungs). Each dip is depth/4 (1 + cos(2 pi x/length)) (1 + cos(2 pi y/width)) about its middle; where they overlap
/// they add up.
struct Squat {
  double length = 0.0, width = 0.0, depth = 0.0;   ///< of the first (leading, greater x) or only dip; all > 0
  double x_center = 0.0, y_center = 0.0;           ///< middle of the first dip
  double second_length = 0.0, second_width = 0.0;  ///< 0 = as the first dip
  double second_depth = 0.0;                       ///< 0 = single dip
  double second_distance = 0.0;                    ///< from the first middle back (towards -x) to the second one
  double second_y_offset = 0.0;                    ///< lateral shift of the second middle
  friend bool operator==(const Squat&, const Squat&) = default;
};

/// Rail corrugation: dz(x) = sum of amplitude cos(2 pi (x - x_start)/wavelength - phase) between x_start and x_end,
/// run in and out over ramp by 1/2 (1 - cos). Positive values lie deeper.
struct Corrugation {
  /// One wave along the rail.
  struct Wave {
    double wavelength = 0.0, amplitude = 0.0, phase = 0.0;  ///< amplitude: half of peak to peak
    friend bool operator==(const Wave&, const Wave&) = default;
  };
  std::vector<Wave> waves;
  double x_start = 0.0, x_end = 0.0, ramp = 0.0;  ///< ramp > 0, at most half of the stretch
  double y_center = 0.0, width = 0.0;             ///< fades as a flat does
  friend bool operator==(const Corrugation&, const Corrugation&) = default;
};

/// Gauge-corner collapse: the corner beyond y_start (towards gauge_side) sinks; depth grows smoothly from 0 at y_start
/// to its greatest value at y_start + gauge_side * width, by 1/2 (1 - cos), and stays there. Along x a trough of the
/// given length, 1/2 (1 + cos(2 pi x/length)).
struct GaugeCornerCollapse {
  double length = 0.0, depth = 0.0, width = 0.0;  ///< along x, down, and across until the depth is whole; all > 0
  double x_center = 0.0;                          ///< middle of the trough
  double y_start = 0.0;                           ///< where the corner begins
  int gauge_side = -1;                            ///< -1: the corner lies towards -y (a right rail), +1: towards +y
  friend bool operator==(const GaugeCornerCollapse&, const GaugeCornerCollapse&) = default;
};

/// A spall of a rail: a chip broken out of the running band, a pit with a flat floor: depth w(x) w(y), where w is 1
/// inside, 0 outside and rises over the width of the edge by 1/2 (1 - cos).
struct Spall {
  double length = 0.0, width = 0.0, depth = 0.0;  ///< over the rims; all > 0
  double edge = 0.0;                              ///< width of the edge, > 0, at most half of length and width
  double x_center = 0.0, y_center = 0.0;          ///< middle
  friend bool operator==(const Spall&, const Spall&) = default;
};

/// A spall of a wheel's tread: the same, with lengths along the circumference at the nominal radius.
struct WheelSpall {
  double length = 0.0, width = 0.0, depth = 0.0;  ///< over the rims, depth along the radius; all > 0
  double edge = 0.0;                              ///< width of the edge, > 0, at most half of length and width
  double theta_center = 0.0, y_center = 0.0;      ///< middle: material angle, lateral
  friend bool operator==(const WheelSpall&, const WheelSpall&) = default;
};

/// A flattened rail head: over the running band the crown is worn down to a plane across the rail. The plane touches
/// the highest point of the base between x_start and x_end (highest as seen along the plane's own inclination) and
/// sinks from there to depth below it over ramp, by t^2 (3 - 2 t); what lies above it is gone.
struct FlattenedHead {
  double x_start = 0.0, x_end = 0.0, ramp = 0.0;  ///< ramp at least 1.5 depth and at most half of the stretch
  double depth = 0.0;                             ///< along z below the highest point of the base
  double roll = 0.0;                              ///< inclination of the plane about x, within +-45 degrees
  double edge_radius = 0.0;                       ///< least one of its rounded edges, across the rail; 0: sharp
  friend bool operator==(const FlattenedHead&, const FlattenedHead&) = default;
};

/// Material milled off a rail: a cutter section swept along a path. The section is a chain of arcs in cutter
/// coordinates (its lowest point usually at the origin, z down); everything above it is removed, between its two ends
/// and between the first and the last station. Positions are interpolated between the stations by natural cubic
/// splines. The section stands perpendicular to the x axis everywhere.
struct MillingPath {
  /// A place of the path.
  struct Station {
    double x = 0.0, y = 0.0, z = 0.0;  ///< where the origin of the cutter section passes
    double roll = 0.0;                 ///< of the cutter about x
    friend bool operator==(const Station&, const Station&) = default;
  };
  /// A part of the cutter's section.
  struct Segment {
    double length = 0.0, curvature = 0.0;  ///< arc length; d(angle)/ds [1/m], as in ArcChain: a concave cutter has < 0
    friend bool operator==(const Segment&, const Segment&) = default;
  };
  std::vector<Station> stations;                           ///< at least two, x strictly increasing
  double start_y = 0.0, start_z = 0.0, start_angle = 0.0;  ///< of the section, which runs with increasing y
  std::vector<Segment> section;  ///< inclined by less than 80 degrees everywhere, also when rolled
  friend bool operator==(const MillingPath&, const MillingPath&) = default;
};

/// Everything that is wrong with one surface. Depths of several shapes add up; milling comes last.
struct Defects {
  std::vector<WheelFlat> flats{};
  std::vector<Polygonization> polygonizations{};
  std::vector<WheelSpall> wheel_spalls{};
  std::vector<Squat> squats{};
  std::vector<Corrugation> corrugations{};
  std::vector<GaugeCornerCollapse> gauge_corner_collapses{};
  std::vector<Spall> spalls{};
  std::vector<FlattenedHead> flattened_heads{};
  std::vector<MillingPath> milling_paths{};

  /// Calls visit(key of case files, body that can have them, list) for every kind; defects may be const.
  template <class Self, class Visit>
  static void each(Self&& defects, const Visit& visit) {
    visit("wheel.flats", Body::wheel, defects.flats);
    visit("wheel.polygonizations", Body::wheel, defects.polygonizations);
    visit("wheel.spalls", Body::wheel, defects.wheel_spalls);
    visit("rail.squats", Body::rail, defects.squats);
    visit("rail.corrugations", Body::rail, defects.corrugations);
    visit("rail.gauge_corner_collapses", Body::rail, defects.gauge_corner_collapses);
    visit("rail.spalls", Body::rail, defects.spalls);
    visit("rail.flattened_heads", Body::rail, defects.flattened_heads);
    visit("rail.milling_paths", Body::rail, defects.milling_paths);
  }

  /// Whether there are none.
  bool empty() const {
    bool none = true;
    each(*this, [&none](const char*, Body, const auto& list) { none &= list.empty(); });
    return none;
  }
  friend bool operator==(const Defects&, const Defects&) = default;
};

/// Throws Error(configuration) where a body cannot have them: "squats belong to rails, not to wheels".
void check_body(const Defects& defects, Body body);

/// Throws Error(configuration) for parameters that make no sense, naming the list and the number of the shape in it,
/// counted from 0 as in overrides: "rail.squats[1]: ...". Wheel shapes on a rail and the reverse are refused too.
/// Slopes of paths between the stations of a milling path are checked when the surface is made. nominal_radius: wheel
/// only.
void check_defects(const Defects& defects, Body body, double nominal_radius);

}  // namespace treadmark
