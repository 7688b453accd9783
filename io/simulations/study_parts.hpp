// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/simulations/study_model.hpp"
#include "treadmark/io/simulations/table_reader.hpp"

namespace treadmark::io {

/// Parts of the reader of study files. Error(configuration) at the place of what is wrong.

/// [[study.vary]].
std::vector<Variation> read_variations(const TableReader& study);

/// All combinations, the last variation fastest. common: overrides of all runs.
std::vector<StudyRun> runs_of(const std::vector<Variation>& variations, const std::vector<std::string>& common);

/// [[study.figures]].
std::vector<StudyFigure> read_figures(const TableReader& study, const std::vector<Variation>& variations);

}  // namespace treadmark::io
