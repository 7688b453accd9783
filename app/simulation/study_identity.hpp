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

/// Everything that the results of some runs depend on, as text: build, base, then its files and settings, run by run.
/// Figures and titles are not part of it, so that they may change. Reads the base once for each of the runs. Errors:
/// those of the readers; Error(input_data) for files that cannot be read. Thread-safe.
std::string study_identity(const io::StudyFile& study, const io::RunRange& runs = {});

/// Whether that of all runs agrees with that of these.
bool same_study(const std::string& all, const std::string& some, const io::RunRange& runs);

}  // namespace treadmark::app
