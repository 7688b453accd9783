// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// A comparison as JSON text: names and units as in docs/results.md and docs/compare.schema.json. Numbers have 12
/// significant digits; what is not finite, was not measured or belongs to a patch that is not there becomes null.
/// Field arrays are not part of it. Thread-safe.
std::string to_json(const Comparison& comparison);

/// Writes the text to a file that appears only when complete. Errors: Error(configuration).
void write_json(const std::filesystem::path& path, const Comparison& comparison);

}  // namespace treadmark::io
