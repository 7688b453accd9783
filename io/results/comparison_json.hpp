// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// A comparison as JSON text: names and units as in docs/results.md and by comparison_schema. Numbers have 12
/// significant digits; what is not finite, was not measured or belongs to a patch that is not there becomes null.
/// Field arrays are not part of it. Thread-safe.
std::string to_json(const Comparison& comparison);

/// JSON Schema of it.
std::string comparison_schema();

/// Writes the text to a file that appears only when complete. Errors: Error(configuration).
void write_json(const std::filesystem::path& path, const Comparison& comparison);

/// The comparison in a folder of `treadmark compare`: compare.json and, where it is there, fields.h5, which has the
/// results and the surfaces. Numbers have the 12 digits of the file; messages of rows are in the results only. Errors:
/// Error(input_data) for files that are missing, broken, lack keys, or do not belong together. Not to be called from
/// two threads at once (HDF5).
Comparison read_comparison(const std::filesystem::path& folder);

}  // namespace treadmark::io
