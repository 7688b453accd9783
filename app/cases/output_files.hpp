// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// The folders for what becomes of input files: the one that was asked for, or where there are several files one with
/// the name of each in it. Errors: Error(configuration) where two files would share one.
std::vector<std::filesystem::path> output_folders(const std::filesystem::path& folder,
                                                  const std::vector<std::string>& inputs);

/// Files that results of a list, or of few cases, replace in a folder: no inputs of theirs. None where it has no name.
std::vector<std::string> result_files(const std::filesystem::path& folder, bool list);

/// Writes everything a result folder holds: result.json, fields.h5, ParaView files and a picture of the pressures;
/// `bodies`: wheel and rail for ParaView too.
/// The JSON file comes last: where it stands the folder is complete. Returns notes on files that this build leaves out.
std::vector<std::string> write_result_folder(const std::filesystem::path& folder, const io::RunResult& result,
                                             bool bodies = false);

/// Writes everything a comparison has: pressures.svg, errors.svg, costs.svg, fields.h5, table.txt, compare.csv and,
/// last, compare.json. Returns as above.
std::vector<std::string> write_comparison_folder(const std::filesystem::path& folder, const io::Comparison& comparison);

}  // namespace treadmark::app
