// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/analysis/measures/estimates.hpp"
#include "treadmark/analysis/measures/running.hpp"
#include "treadmark/analysis/measures/spectrum.hpp"
#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::app {

/// Spectrum of a channel over the whole run.
struct ChannelSpectrum {
  std::string channel, unit;
  measures::PowerSpectrum density;
  std::vector<measures::FrequencyBand> bands;
};

/// Whether levels in decibels are usual of a unit: accelerations, re 1e-6 m/s2.
bool has_level(const std::string& unit);
double acceleration_level(double rms);

/// Static values of runs on a line, by which cant deficiencies are found.
inline constexpr const char *kCantBaseName = "line.cant_base_m", *kGravityName = "line.gravity_m_s2";

/// What a run says against limits.
struct AssessedRun {
  std::string name;
  std::shared_ptr<const io::SimulationResult> result;
  AssessmentRequest request;  ///< with its sections
  std::vector<measures::Assessed> quantities;
  std::vector<double> cant_deficiency;  ///< mean of each section, by the line's base [m]; NaN: no line in the history
  std::vector<ChannelSpectrum> spectra;
  std::vector<std::string> doubts;

  const RunningLimits& limits() const { return request.limits ? *request.limits : usual_limits(); }
};

/// The signals of a history by the names of its columns, with what these laws make of them. Errors: Error(input_data)
/// without columns t_s and x_m; Error(configuration) for a law that no wheel has the columns for.
measures::RunSignals signals_of(const io::SimulationResult& result, const std::vector<std::string>& laws = {});

/// Refuses a file that asks for more than its history will hold: spectra and laws without their columns, lines too far
/// apart for filters. max_step [s], max_travel [m]: of the integration, what comes first. Errors: Error(configuration).
void check_assessable(const io::SimulationFile& file, const std::vector<io::HistoryColumn>& columns, double max_step,
                      double max_travel);

/// Errors: Error(configuration) for sections that do not lie within the run, where they are given, and channels that
/// the history does not have; Error(input_data) for histories that cannot be assessed. An interrupted run is assessed
/// as far as it goes. Thread-safe.
AssessedRun assess_result(std::string name, std::shared_ptr<const io::SimulationResult> result,
                          const AssessmentRequest& request);

/// Results of simulations: their folders or simulation.h5; channels that all of them have to have. Errors: as
/// assess_result; those of the files; Error(left_out) without HDF5.
std::vector<AssessedRun> assess_files(const std::vector<std::string>& results, const AssessmentRequest& request,
                                      const std::vector<std::string>& channels);

/// The assessment that a simulation file asks for; nothing where it asks for none or the run has no two instants.
/// Errors: as assess_result.
std::optional<AssessedRun> assess_own(std::shared_ptr<const io::SimulationResult> result,
                                      const std::optional<AssessmentRequest>& request);

/// What the sections of all runs say together.
std::vector<measures::Estimate> estimates_of(std::span<const AssessedRun> runs);

/// Sections have names of their own and an extent, limits are of quantities that there are, laws ask for no elements
/// of contact. Errors: Error(configuration).
void check(const AssessmentRequest& request);

}  // namespace treadmark::app
