// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/analysis/measured/section.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/scans/placement/elements.hpp"
#include "treadmark/scans/placement/match_nominal.hpp"
#include "treadmark/scans/placement/refine_axis.hpp"
#include "treadmark/scans/placement/rough_axis.hpp"

namespace treadmark::scans {

/// Where a wheel or rail roughly is in a scan, in the scan's own unit, whatever that is.
struct RoughPlace {
  SurfaceElements elements;
  RoughAxis rough;
  double size = 0.0;  ///< radius of a wheel, width of a rail's section
};

/// Errors: those of find_elements and of the rough axes.
RoughPlace find_roughly(std::span<const Vec3> points, std::span<const std::uint8_t> keep, Body body);

/// The unit in which the size is that of a wheel (radius 0.15 to 0.75 m) or a rail (30 to 220 mm wide).
/// Errors: Error(input_data) that lists the size in every unit if none fits.
LengthUnit unit_by_size(Body body, double size);

/// Errors: Error(input_data) if the size in that unit is not that of a wheel or rail; the advice names the unit that
/// would be.
void check_unit(Body body, double size, LengthUnit unit);

struct PlaceSettings {
  Body body = Body::rail;
  std::optional<Section> nominal;  ///< (y, z) of a wheel, (y, -z) of a rail's profile; none: the scan's own features
  std::optional<double> radius;    ///< wheel: its nominal radius [m], which helps to find the axle of a short arc
  std::optional<Vec3> up;          ///< rail: in the cloud's frame, roughly out of the head
  std::optional<Vec3>
      forward;  ///< rail: roughly +x; wheel: roughly +y (from the flange to the field side); in the cloud's frame
};

/// A wheel or rail found in a scan.
struct Placement {
  Pose X_CS;                            ///< surface frame in the cloud's; its u = 0 is not settled yet
  double nominal_radius = 0.0;          ///< wheel [m]
  Section section;                      ///< of the undamaged part, in (y, v) of the surface frame: v the radius, or -z
  std::optional<SectionMatch> match;    ///< of the section with the nominal one
  double moved_by_back = 0.0;           ///< y of a wheel, from where the nominal section's flange would have put it [m]
  std::vector<measured::Doubt> doubts;  ///< about its section; "no_flange", "no_sides": was not scanned
  double scatter = 0.0;                 ///< of most points about the section: robust standard deviation [m]
  double undamaged = 0.0;               ///< part of the points that fixed the axis
  double position_error = 0.0, direction_error = 0.0;  ///< standard errors of the axis [m], [rad]
  double radius_error = 0.0;                           ///< of a wheel's radius at the datum [m]
  double arc = 0.0;                                    ///< of the circumference of a wheel that was scanned [rad]
  int iterations = 0;
  std::vector<SurfaceErrors::Motion> errors;  ///< that the place may have: lateral, tilt, height
};

/// The frame that place() begins with: x along a rail by the settings, or as the axis of the cloud does that is nearest
/// (of a wheel y along its axle); its origin in the middle. Errors: Error(configuration) for a direction up that runs
/// along the rail.
Pose first_frame(const RoughPlace& roughly, const PlaceSettings& settings);

/// The axis of the file along which a direction runs most; of two that are about equal, as in a cloud turned by 45
/// degrees, the first.
Eigen::Index nearest_axis(const Vec3& direction);

/// points: [m]; roughly: of the same points in metres too. Deterministic.
/// Errors: those of refine_axis and match_nominal; Error(input_data) for an arc too short to find an axle from.
Placement place(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const RoughPlace& roughly,
                const PlaceSettings& settings);

/// What helps where the axle of a wheel is not known well.
inline constexpr const char* kKnowMore =
    "give its nominal radius if it is known (placement.nominal_radius_mm), or scan more of the circumference";

/// The same place in another unit: lengths times factor.
void scale(RoughPlace& roughly, double factor);

}  // namespace treadmark::scans
