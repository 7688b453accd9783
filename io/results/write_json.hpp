// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// The result file of a run as JSON text: names and units as in docs/results.md and docs/result.schema.json.
/// Numbers have 12 significant digits; what is not finite becomes null. Field arrays are not part of it.
/// Thread-safe.
std::string to_json(const RunResult& run);

/// Writes the text to a file that appears only when complete. Errors: Error(configuration).
void write_json(const std::filesystem::path& path, const RunResult& run);

}  // namespace treadmark::io
