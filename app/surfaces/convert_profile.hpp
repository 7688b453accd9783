// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/app/surfaces/convert_surface.hpp"

namespace treadmark::app {

struct ProfileConversion {
  double lambda_mm3 = 0.0;     ///< smoothing as shape.smoothing_lambda_mm3; 0: none
  double wavelength_mm = 0.0;  ///< smoothing as shape.smoothing_wavelength_mm; 0: none
  bool derivatives = false;    ///< columns of arc length, inclination and curvature
};

/// Reads a profile (a file, or the wheel or rail of the first case of a case file) and writes it as a profile, see
/// io::write_profile. The points stay where they are unless smoothing is asked for. Returns what was written, in words.
/// The file appears only where it is read again as what it was made from. Errors: those of readers, writers and
/// require_as_written; Error(configuration) where the input is no profile.
std::string convert_profile(const std::filesystem::path& input, const std::filesystem::path& output,
                            const ConvertSettings& settings, const ProfileConversion& how);

/// The same of a surface that is there already and whose section is the same everywhere; of a roller the rail that its
/// section would be.
std::string write_section(const NaturalSurface& surface, const std::filesystem::path& output);

}  // namespace treadmark::app
