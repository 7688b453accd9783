// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// The result file of a run as JSON text: names and units as in docs/results.md and by result_schema.
/// Numbers have 12 significant digits; what is not finite becomes null. Field arrays are not part of it.
/// Thread-safe.
std::string to_json(const RunResult& run);

/// JSON Schema of it.
std::string result_schema();

/// The same piece by piece, for more cases than fit into memory: what stands before the cases, each of them as it
/// stands there, commas and line ends between them (kBetweenCases), and what stands behind the last one. run: without
/// cases.
std::string case_text(const CaseResult& result);
std::string text_before_cases(const RunResult& run);  ///< of the file, up to the first case
inline constexpr std::string_view kBetweenCases = ",\n  ", kBehindCases = "\n ]\n}\n";

/// Writes the text to a file that appears only when complete. Errors: Error(configuration).
void write_json(const std::filesystem::path& path, const RunResult& run);

}  // namespace treadmark::io
