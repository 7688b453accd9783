// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark::measured {

/// Points of one section of a wheel or rail in the order in which they were measured [m]; y and z of one size.
struct SectionPoints {
  Body body = Body::rail;
  std::vector<double> y, z;
};

/// What the keys of a shape say of one of its axes.
enum class Turn { decide, no, yes };

/// What is said of a section besides its points.
struct Words {
  Turn mirror_y = Turn::decide, mirror_z = Turn::decide;
  bool place = true;         ///< put y = 0 on the tape line and z = 0 on the tread where the points show where they are
  bool z_is_radius = false;  ///< a column of radii stands in place of z
};

/// The two ways in which an axis can point, and what speaks for each of them.
struct Readings {
  double as_it_is = 0.0, turned = 0.0;  ///< evidence [mm; of a crown: 1]; the larger one decides
  std::string evidence;                 ///< what it is: "a flange that reaches 28.1 mm beyond the tread"
  bool marked = false;                  ///< a mark shows it (flange, head, crown), not a trend alone

  bool is_turned() const { return turned > as_it_is; }
  /// Whether the better reading is at least three times as well founded as the other one.
  bool sure() const;
};

/// A doubt about a section: its name, and what is seen, where, and what to set.
struct Doubt {
  std::string name;  ///< "upside_down", "flange_side", "gauge_side", "tape_line", "flange_height"
  std::string text;
};

/// Slope of a tread or top, by pairs of points half of its extent apart.
struct Trend {
  double slope = 0.0;   ///< dz/dy, median
  double spread = 0.0;  ///< median deviation from it: that of a hollow tread is large
};

/// The straight part of the back of a flange, which a gauge rests on.
struct FlangeBack {
  double y = 0.0;       ///< of it, or of its continuation, where the fillet to the tip begins [m]
  double lean = 0.0;    ///< against the upright, positive: rolled so that z grows with y [rad]
  double length = 0.0;  ///< that was measured [m]
  double beyond = 0.0;  ///< how far anything stands out of it [m]
  double error = 0.0;   ///< standard deviation of y where the points scatter by one
};

/// The marks of a wheel's section, z down [m].
struct WheelMarks {
  std::optional<double> tip_y, tip_z;  ///< of the flange, where there is one
  bool tip_seen = false;               ///< false: the section ends on the flange before it
  std::optional<double> face_y;        ///< of the flange 10 mm beyond the tread at y = 0
  std::optional<double> back_y;        ///< of the flange, where the section reaches it
  std::optional<FlangeBack> straight;  ///< part of the back; nothing where less than 6 mm of it are measured
  bool second_flange = false;          ///< one on the other side too
  std::optional<double> tips_lean;     ///< of the line through the tips of two flanges, as the lean of a back [rad]
  std::optional<double> tape_z;        ///< of the tread at y = 0
  std::optional<Trend> tread;          ///< nothing where less than 30 mm of it are measured
};

/// What was understood of a section.
struct Understanding {
  Readings y, z;  ///< which way the axes point
  bool mirrored_y = false, mirrored_z = false;
  bool taken_as_it_is = false;          ///< nothing shows which way y and z of a wheel point, and nothing was said
  double shift_y = 0.0, shift_z = 0.0;  ///< that were added after mirroring [m]
  WheelMarks wheel;                     ///< of a wheel, after all that
  std::optional<Trend> head;            ///< of the top of a rail
  std::vector<std::string> notes;       ///< what was done to the points
  std::vector<Doubt> doubts;
};

/// Turns the points of a section into the axes of core/README.md (y to the right, z down) and puts a wheel's tape line
/// at y = 0, 70 mm from the back of its flange, by what the points show. What reaches 15 mm beyond the rest of a wheel
/// is its flange and points down; the head of a rail is what is widest near its top. Each decision comes with its
/// evidence; where two readings are about as likely there is a doubt that names both. Never throws; thread-safe.
Understanding understand(SectionPoints& points, const Words& words);

/// Of the points of a section behind the tip of its flange, in their order, z down [m]; tip_z: of the tip. Most of what
/// is 18.5 to 58.5 mm below the tip must lie within 0.15 mm of a line less than 11 degrees off the upright, and 6 mm of
/// it; nothing else counts. Thread-safe.
std::optional<FlangeBack> straight_back(std::span<const double> y, std::span<const double> z, double tip_z);

/// Indices of the points of the outline of a rail, in its order.
struct RailOutline {
  std::vector<std::size_t> head;   ///< down to where its sides turn under it
  std::vector<std::size_t> whole;  ///< from one end to the other, of a closed one from the middle of its foot
};

/// Of the outline of a rail, with its web, with or without a foot (90 to 300 mm high, closed or not). Empty for any
/// other section. Thread-safe.
RailOutline outline_of_rail(const SectionPoints& points);

}  // namespace treadmark::measured
