// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/model/irregularities.hpp"

namespace treadmark::io {

/// Reads measured irregularities (docs/layout.md, "Files"): a line that names columns with their units, then numbers,
/// separated by commas, semicolons or tabs. Columns: distance_m or distance_km, and functions in mm, m or um
/// ("longitudinal_level_mm"), of the track or of each rail ("alignment_left_mm", "alignment_right_mm"). notes: columns
/// that are not used. Errors: Error(configuration) for a file that cannot be opened, Error(input_data) with
/// file:line:column for what is wrong in it. Safe to call from several threads.
IrregularityTable read_irregularity_file(const std::filesystem::path& file, std::vector<std::string>* notes = nullptr);

/// The same for text in memory; name serves for messages.
IrregularityTable parse_irregularity_text(std::string_view text, const std::string& name,
                                          std::vector<std::string>* notes = nullptr);

/// The text of a file from which the reader makes the same table to the bit.
std::string irregularity_text(const IrregularityTable& table);

}  // namespace treadmark::io
