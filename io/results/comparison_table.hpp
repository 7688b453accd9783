// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// A comparison as aligned columns for people: errors of the surfaces, errors of the contact, costs, each with one line
/// a candidate, units in the head; "-" where nothing was measured. Errors are the largest over the cases, times the
/// mean per case. Below: what failed and the notes of the builders. Ends in a newline. Thread-safe.
std::string comparison_table(const Comparison& comparison);

/// The rows of a comparison as comma-separated values (RFC 4180, lines ended by a line feed): a head with the names of
/// the rows in the JSON file, then one line a row. What is null or absent there is empty here. Thread-safe.
std::string to_csv(const Comparison& comparison);

/// Writes the text to a file that appears only when complete. Errors: Error(configuration).
void write_csv(const std::filesystem::path& path, const Comparison& comparison);

}  // namespace treadmark::io
