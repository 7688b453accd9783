// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "treadmark/model/shape/slices.hpp"

namespace treadmark::io {

/// Writes slices so that read_slices gives them back to 1e-9 mm: the file itself, .slcs for a rail or .slcw for a
/// wheel, and beside it a folder NAME-SUM with one two-column file (y, z in mm) a slice, where SUM is the start of
/// their check sum. Positions are in mm or mrad. Without features. Until the new file stands the old one and its slices
/// stay; then folders of earlier writings go. Errors: Error(configuration) for an extension of the other body, fewer
/// than four slices, features, slices nearer than 1e-6 m or rad, or a file that cannot be written. comments: lines put
/// at the top of the slices file, without line ends; covered: the same behind the check sum, which covers them.
/// Returns the number of bytes of all of it.
std::uintmax_t write_slices(const std::filesystem::path& file, const SliceSet& slices,
                            std::span<const std::string> comments = {}, std::span<const std::string> covered = {});

/// Removes the folders of slices that earlier writings of a slices file made: those NAME-SUM beside it that it does not
/// name. For one that was written elsewhere and moved. Never throws.
void remove_other_slices(const std::filesystem::path& file) noexcept;

}  // namespace treadmark::io
