// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/simulations/study_model.hpp"

namespace treadmark::app {

/// (key, value) of what a run has of each variation.
std::vector<std::pair<std::string, std::string>> swept_of(const io::StudyFile& study, const io::StudyRun& run);

/// The values alone, for people.
std::string label_of(const io::StudyFile& study, const io::StudyRun& run);

/// Everything that the results of the runs depend on, as text: build, base, its files and settings, run by run. Figures
/// and titles are not part of it, so that they may change. Reads the base once for each run. Errors: those of the
/// readers; Error(input_data) for files that cannot be read. Thread-safe.
std::string study_identity(const io::StudyFile& study);

}  // namespace treadmark::app
