// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// Blocks of points below the surface as the text file that the plotting tools of CONTACT load. A block: "% NX NY NZ"
/// above a line with the three numbers, a line of names, then a line a point (x running fastest, then y, then z) with X
/// Y Z UX UY UZ [mm], SIGHYD SIGVM and, with full_tensor, SIGXX SIGXY SIGXZ SIGYY SIGYZ SIGZZ [N/mm^2]. Numbers have 13
/// significant digits. Thread-safe. Errors: Error(configuration) for a block whose values are not nx ny nz.
std::string blocks_to_subs(std::span<const SubsurfaceBlock> blocks, bool full_tensor);

/// Writes the text to a file that appears only when complete. Errors: as above, and when the file cannot be written.
void write_subs(const std::filesystem::path& path, std::span<const SubsurfaceBlock> blocks, bool full_tensor);

}  // namespace treadmark::io
