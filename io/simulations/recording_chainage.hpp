// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace treadmark::io {

/// The rows of a recording of a track as they were read; NaN: no value.
struct RecordedRows {
  std::string file;
  std::vector<int> lines;                    ///< of the file, for messages
  std::vector<double> distance;              ///< [m]
  std::vector<std::vector<double>> signals;  ///< as long as distance

  /// Error(input_data) at the line of a row.
  [[noreturn]] void fail(std::size_t row, const std::string& message, const std::string& advice = {}) const;
};

/// Missing rows and cells over a longer way are not bridged [m].
inline constexpr double kLongestBridge = 5.0;

/// Puts the rows in order of distances that increase. A recording listed from high to low kilometres is turned over.
/// Where an even chainage jumps (kilometre stones, broken chains) while all signals go on, rows are counted on; where
/// the signals jump with it, rows are missing, and the way is bridged up to kLongestBridge. Rows recorded twice are
/// left out. Coarse kilometres become even distances. All of it with notes. sampling: way between two rows [m] that
/// replaces all but the first distance; 0: none. Errors: Error(input_data) for a chainage that nothing of this
/// explains.
void put_in_order(RecordedRows& rows, double sampling, std::vector<std::string>& notes);

/// Cubic curves over cells without a value, up to kLongestBridge long; Error(input_data) for longer ways. Rows without
/// a value at the ends are taken away. names: of the signals.
void fill_empty_cells(RecordedRows& rows, std::span<const std::string> names, std::vector<std::string>& notes);

}  // namespace treadmark::io
