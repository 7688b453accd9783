// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::cli {

/// Makes a folder for output, and those it lies in. Errors: Error(configuration).
void make_folder(const std::filesystem::path& folder);

/// Writes everything a result folder holds: result.json, fields.h5, ParaView files and a picture of the pressures.
/// The JSON file comes last: where it stands the folder is complete. Returns notes on files that this build leaves out.
std::vector<std::string> write_result_folder(const std::filesystem::path& folder, const io::RunResult& result);

/// Writes everything a comparison has: pressures.svg, errors.svg, costs.svg, fields.h5, table.txt, compare.csv and,
/// last, compare.json. Returns as above.
std::vector<std::string> write_comparison_folder(const std::filesystem::path& folder, const io::Comparison& comparison);

}  // namespace treadmark::cli
