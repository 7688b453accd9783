// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/io/simulations/recording_chainage.hpp"
#include "treadmark/io/simulations/recording_header.hpp"
#include "treadmark/model/vehicle/irregularities.hpp"

namespace treadmark::io::recording {

/// The functions of the track from the columns of a recording, without gaps: level and alignment as they stand or as
/// the mean of both rails, cross level and gauge as they stand or as right less left rail. What is there twice is
/// compared, with a note. columns: of the signals of rows. seen_backwards: left, right and signs are as seen along
/// falling distances.
IrregularityTable functions_of(const RecordedRows& rows, std::span<const Column> columns, bool seen_backwards,
                               std::vector<std::string>& notes);

}  // namespace treadmark::io::recording
