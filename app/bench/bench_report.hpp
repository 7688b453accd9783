// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/model/origin.hpp"
#include "treadmark/model/rows.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::app {

/// What one body in one representation costs. Times are NaN where nothing was measured, always so without agreement.
struct BenchRow {
  /// Not measured.
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string backend;
  double resolution = 0.0;  ///< of the samples [m]; 0 = as given
  Body body = Body::rail;
  bool agrees = false;           ///< with every oracle it was held against
  std::string reason;            ///< why it does not agree; empty if it does
  double difference = kNone;     ///< largest normal distance from the surface as given, over the measured grids [m]
  std::size_t memory_bytes = 0;  ///< of the surface
  std::size_t points = 0;        ///< of the grid of heights
  double build = kNone;          ///< [s]
  double height = kNone, height_tilted = kNone;  ///< a height in a level and in a tilted plane [s]
  double normal = kNone;                         ///< height with both slopes, tilted plane [s]
  double base_height = kNone;  ///< of backends over a base only: a height of the base, level plane [s]
  /// Of wheel and rail, both in this representation: first search, after a small move, undeformed distance [s].
  double search_cold = kNone, search_warm = kNone, distance = kNone;
  int patches = -1;  ///< -1: not searched
};

/// All that one run of the benchmark found out, with what is needed to read it.
struct BenchReport : Origin {
  std::string date, machine, compiler;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
  int threads = 1;                                             ///< that were allowed
  double seconds = 0.0;                                        ///< of the whole run
  double seconds_per_measure = 0.0;                            ///< as BenchSettings has it [s]
  std::string truth;                                           ///< representation of the surfaces as given
  bool complete = true;                                        ///< false when interrupted
  std::vector<BenchRow> rows;

  /// Whether all rows do.
  bool agrees() const {
    for (const BenchRow& row : rows)
      if (!row.agrees) return false;
    return true;
  }
};

/// A report as JSON text; what was not measured is null.
std::string bench_json(const BenchReport& report);

/// JSON Schema of it.
std::string bench_schema();

/// The report in such a file. Errors: Error(input_data) for a file that is missing, broken or lacks keys.
BenchReport read_bench(const std::filesystem::path& file);

/// The rows as comma-separated values (RFC 4180, lines ended by a line feed) below a head with the names.
std::string bench_csv(const BenchReport& report);

/// Aligned columns for people, a line a row, "-" where nothing was measured; below it what does not agree.
std::string bench_table(const BenchReport& report);

/// Date, machine and the same columns as a table in Markdown.
std::string bench_markdown(const BenchReport& report);

/// Costs by backend and resolution as an SVG picture: heights of the wheel and of the rail, search and distance, all on
/// logarithmic axes.
std::string bench_svg(const BenchReport& report);

/// Writes bench.svg, bench.csv and, last, bench.json to a folder that is made if it is missing; each file appears only
/// when it is complete. Errors: Error(configuration).
void write_bench_folder(const std::filesystem::path& folder, const BenchReport& report);

}  // namespace treadmark::app

namespace treadmark {

/// A row as JSON and CSV have it; NaN where nothing was measured.
template <>
std::span<const Column<app::BenchRow>> columns();

}  // namespace treadmark
