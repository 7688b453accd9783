// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io {

/// What a curve through the points has at each of them.
struct ProfileDerivatives {
  std::vector<double> s;            ///< arc length, 0 where y is 0 [m]
  std::vector<double> inclination;  ///< atan2(dz/ds, dy/ds) [rad]
  std::vector<double> curvature;    ///< positive where a rail head or a flange tip is round [1/m]
};

/// Whether the name ends in .prr, .prw, .ban, .whl or .csv.
bool is_writable_profile(const std::filesystem::path& file);

/// Writes a profile in mm: .prr .prw Simpack, z down; .ban .whl MiniProf, z up; .csv with names of columns, z down.
/// Reading the file again gives the same points: bit by bit those of files in mm, others within 1e-15 m. derivatives:
/// further columns of .csv (arc length, inclination, curvature) and of .ban and .whl (A, C); null: none. Errors:
/// Error(configuration) for a name of the other body, for derivatives in Simpack files, and for points that would not
/// be read again as they are.
void write_profile(const std::filesystem::path& file, const Profile& profile,
                   const ProfileDerivatives* derivatives = nullptr);

}  // namespace treadmark::io
