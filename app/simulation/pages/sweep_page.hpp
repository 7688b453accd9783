// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/histories/study_model.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// A study as it lies in its folder, finished or not.
struct StudyOnDisk {
  io::StudyResult study;                                      ///< runs that left a store
  std::vector<std::size_t> unfinished;                        ///< numbers of the others
  std::vector<std::pair<std::string, std::string>> pictures;  ///< (file name, SVG)
};

/// Report of a study: summaries over the swept keys, the history of the chosen run, the pictures that the study asked
/// for. Reads the histories from the stores of the runs. Errors: Error(input_data). Not to be called from two threads
/// at once.
report::Page sweep_page(const StudyOnDisk& study);

/// The folder of a study, also while runs are being solved or after they were interrupted. Errors: Error(input_data).
/// Not to be called from two threads at once.
StudyOnDisk read_study_folder(const std::filesystem::path& folder);

}  // namespace treadmark::app::pages
