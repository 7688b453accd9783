// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/histories/study_model.hpp"
#include "treadmark/io/simulations/study_model.hpp"

namespace treadmark::app {

/// What can be told of figures before anything runs. Errors: Error(configuration) for those that no study can draw.
void check_study_figures(const io::StudyFile& file);

/// Draws the figures that a study asks for, each as SVG with its numbers as CSV beside it, from the stores of its runs.
/// Errors: Error(configuration) for columns, keys and quantities that the runs do not have.
void write_study_figures(const io::StudyFile& file, const std::filesystem::path& folder, const io::StudyResult& study);

}  // namespace treadmark::app
