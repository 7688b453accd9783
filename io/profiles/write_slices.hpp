// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/model/slices.hpp"

namespace treadmark::io {

/// Writes slices so that read_slices gives them back to 1e-9 mm: the file itself, .slcs for a rail or .slcw for a
/// wheel, and beside it a folder of its stem with one two-column file (y, z in mm) a slice. Positions are in mm or
/// mrad. Without features. The slices file comes last, so that what it names is complete. Errors: Error(configuration)
/// for an extension of the other body, fewer than four slices, features, slices nearer than 1e-6 m or rad, or a file
/// that cannot be written. comments: lines put at the top of the slices file, without line ends.
void write_slices(const std::filesystem::path& file, const SliceSet& slices,
                  std::span<const std::string> comments = {});

}  // namespace treadmark::io
