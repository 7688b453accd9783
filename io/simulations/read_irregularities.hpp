// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/model/vehicle/irregularities.hpp"

namespace treadmark::io {

/// What a recording of a track does not say by itself.
struct RecordingSettings {
  double nominal_gauge = 0.0;   ///< that a whole gauge (1436.2 mm) is counted from [m]; 0: see below
  double track_gauge = 0.0;     ///< of the track that gets the irregularities [m]; 0: not known
  double sampling = 0.0;        ///< way between two rows, whatever their distances say [m]; 0: by the distances
  bool as_stated = false;       ///< distances are used as they stand, also where they jump; they must increase then
  bool seen_backwards = false;  ///< left, right and signs are as seen along falling distances
};

/// Reads measured irregularities (docs/layout.md, "Files"): lines with names of columns and their units, then numbers,
/// separated by commas, semicolons, tabs or blanks, in UTF-8, UTF-16 or Latin-1. Columns are a distance, and functions
/// of the track or of each rail, by the names of recording_names.hpp. A whole gauge is counted from settings, from what
/// the file states, from the track's gauge where that lies within 40 mm, or from the nearest gauge in use. Cross level
/// and gauge beside both rails are checked against them. notes: all that was assumed, and columns that are not used.
/// Errors: Error(configuration) for a file that cannot be opened, Error(input_data) with file:line:column for what is
/// wrong in it. Safe to call from several threads.
IrregularityTable read_irregularity_file(const std::filesystem::path& file, std::vector<std::string>* notes = nullptr,
                                         const RecordingSettings& settings = {});

/// The same for text in memory; name serves for messages.
IrregularityTable parse_irregularity_text(std::string_view text, const std::string& name,
                                          std::vector<std::string>* notes = nullptr,
                                          const RecordingSettings& settings = {});

/// The text of a file from which the reader makes the same table to the bit.
std::string irregularity_text(const IrregularityTable& table);

}  // namespace treadmark::io
