// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/app/bench/bench_model.hpp"
#include "treadmark/io/results/comparison_fields.hpp"

namespace treadmark::app {

/// A row as the JSON and the CSV file have it: always the same names in the same order, values in the units of their
/// names, a number that is not finite where nothing was measured.
std::vector<io::NamedField> bench_fields(const BenchRow& row);

/// A report as JSON text (docs/bench.schema.json); what was not measured is null.
std::string bench_json(const BenchReport& report);

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
