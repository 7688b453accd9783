// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::app {

/// One or more runs side by side. Errors: Error(configuration) for files that cannot be written.

/// Of each section and quantity the wheel, wheelset or point that is nearest to the limit or largest.
std::string assessment_text(std::span<const AssessedRun> runs);
/// A line each run, section, place and quantity; numbers in SI units, exact.
std::string assessment_csv(std::span<const AssessedRun> runs);
/// A line each quantity, kind of section and place, of all runs together.
std::string estimates_csv(std::span<const AssessedRun> runs);
/// A line each channel and one-third octave, and each line of a density.
std::string spectra_csv(std::span<const AssessedRun> runs);
/// All of this.
std::string assessment_json(std::span<const AssessedRun> runs);
/// One-third octaves of all channels and runs. At least one run has a band.
std::string spectra_svg(std::span<const AssessedRun> runs);

/// Whose limits they are, and whether anybody has verified them.
std::string limits_text(const RunningLimits& limits);

/// The worst of a quantity in a section; nullptr where no number is ok. The result points into the run.
const measures::Assessed* worst_of(const AssessedRun& run, const std::string& section, const std::string& quantity);

/// Columns that are drawn over each other where nothing else is asked for: those of the first run that are of wheel
/// forces.
std::vector<std::string> usual_channels(const io::SimulationResult& result);

/// What an assessment of one run was asked for, from its assessment.json. Errors: Error(input_data).
AssessmentRequest request_in(const std::filesystem::path& json);

/// assessment.csv, estimates.csv where there are enough sections, spectra.csv and spectra.svg where there are spectra,
/// where there are channels runs.svg and runs.csv with these over the distance, and last assessment.json.
void write_assessment_folder(const std::filesystem::path& folder, std::span<const AssessedRun> runs,
                             std::span<const std::string> channels);

}  // namespace treadmark::app

namespace treadmark {

/// Columns whose unit has no name have that of the quantity.
template <>
std::span<const Column<measures::Assessed>> columns();
/// Of a limit.
template <>
std::span<const Column<RunningLimit>> columns();

}  // namespace treadmark
