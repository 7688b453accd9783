// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::io {

/// Whether the extension is .slcs (rail) or .slcw (wheel), upper or lower case.
bool is_slices_file(const std::filesystem::path& file);

/// Reads a slices file and the profiles that it names, relative to its own folder and with '/' or '\' between folders.
/// The options hold for each of the profiles; mirror_z = 0 mirrors z of all or of none, as most of them ask. u =
/// SCALE*(OFFSET + value), rails in metres, wheels in rad.
///
/// Refused besides what read_profile refuses: fewer than 4 or more than 1000000 slices, values that do not increase by
/// more than 1e-3, an angle outside [-1.5 pi, 1.5 pi] or a range of angles that neither lies in [-pi, pi] nor contains
/// it, features that are not in increasing order, that lie beyond the end of the profile (save for the last one, which
/// is moved to the end) or that are missing between others, and data after the last record.
/// Throws Error(input_data) at the line and column at fault, Error(configuration) for an extension of the other body.
/// Thread-safe.
SliceSet read_slices(const std::filesystem::path& file, Body body, const ProfileOptions& options,
                     const SourcePosition& referenced_from = {});

/// Gives the profile for a name in a slices file; the position is that of the name.
using SliceLoader = std::function<Profile(const std::string& name, const SourcePosition& where)>;

/// The same from text in memory; `file` is only used for messages and the name of the set.
SliceSet parse_slices(std::string_view text, const std::string& file, Body body, const SliceLoader& load);

}  // namespace treadmark::io
