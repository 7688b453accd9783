// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/analysis/measured/lumps.hpp"
#include "treadmark/analysis/measured/section.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/model/shape/length_unit.hpp"

namespace treadmark::io {

/// What a profile file says besides its points, and what reading it changed.
struct ProfileSource {
  std::string kind;                      ///< of the file: "MiniProf, lines Key=value", "columns y z, separated by ';'"
  std::optional<LengthUnit> unit;        ///< that the file states
  std::optional<double> nominal_radius;  ///< of a wheel [m]: half the diameter at the tape line
  std::vector<std::pair<std::string, std::string>> said;  ///< names and values in the file that the points do not show
  std::vector<std::string> notes;                         ///< repairs, and what was not used
  std::vector<measured::Doubt> doubts;                    ///< about what its words mean: "columns", "unit"
  std::optional<points::UnknownUnit> unknown_unit;        ///< that the file states
  std::size_t points_in_file = 0;                         ///< before repairs
  double scale_to_mm = 1.0;                               ///< from numbers of the file to mm
  bool mirrored_y = false, mirrored_z = false;            ///< in all, with what the file's own flags ask for
  bool reversed = false;                                  ///< the order of the points
  std::optional<measured::Lump> lump;                     ///< dirt, in the points before they were smoothed
  measured::Understanding understood;                     ///< of the points; y of the back counts after placing
  std::vector<int> lines;                                 ///< where in the file each point of the profile stands
};

}  // namespace treadmark::io
