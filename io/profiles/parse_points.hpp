// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

#include "treadmark/io/profiles/profile_source.hpp"
#include "treadmark/io/profiles/raw_points.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io::profiles {

/// Content of a Simpack rail or wheel profile: points as they stand and what the header asks to do with them.
struct SimpackContent {
  RawPoints points;                     ///< file units
  double near_distance = 1e-4;          ///< point.dist.min, file units
  double shift_y = 0.0, shift_z = 0.0;  ///< file units
  double y_min = 1.0, y_max = 0.0;      ///< points outside are deleted; no bound unless min < max
  double z_min = 1.0, z_max = 0.0;      ///< z is clipped; no bound unless min < max
  bool mirror_y = false, mirror_z = false;
  bool inversion = false;        ///< points stand in the wrong order
  double units_per_metre = 1.0;  ///< 1000 for points in mm
};

/// Content of a MiniProf file or of a file of columns.
struct ColumnContent {
  RawPoints points;  ///< file units
  double offset_y = 0.0, offset_z = 0.0;
  double radius_factor = 0.0;  ///< z holds radii (1) or diameters (0.5); 0: heights
  ProfileSource source;
};

/// Whether the text begins like a Simpack or a MiniProf file, whatever its name.
bool begins_like_simpack(std::string_view text);
bool begins_like_miniprof(std::string_view text);

/// The parsers throw Error(input_data) with the line and column of what they cannot accept, and need no more memory
/// than a fixed multiple of the text. `file` is only used in messages.
SimpackContent parse_simpack(std::string_view text, const std::string& file, Body body);
/// section: of a file of several profiles the one with this number; 0: the one that was measured.
ColumnContent parse_miniprof(std::string_view text, const std::string& file, Body body, int section);
/// profile: of several side by side the one with this number; 0: the only one.
ColumnContent parse_plain_columns(std::string_view text, const std::string& file, int profile);

}  // namespace treadmark::io::profiles
