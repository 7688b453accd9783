// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/stability/falling_run.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/files/content_cache.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/solvers/vehicle/stability/stability.hpp"

namespace treadmark::app {

/// What `treadmark stability` is asked for.
struct StabilityRequest {
  std::filesystem::path file;
  std::vector<std::string> overrides;     ///< of the simulation file
  double from = 10.0, to = 100.0;         ///< speeds [m/s]
  int count = 46;                         ///< of them, evenly spaced
  double tolerance = 0.01;                ///< of the critical speed [m/s]
  double shown = 20.0;                    ///< highest frequency in the picture [Hz]
  std::optional<io::ContentCache> cache;  ///< where tables are kept for other processes
  /// Let the speed fall in time too, from the highest to the lowest one.
  std::optional<FallingRequest> falling = {};
};

/// Eigenvalues of a vehicle by its speed.
struct StabilityRun {
  StabilityRequest request;
  std::string title;
  std::vector<std::string> notes;  ///< of the file
  vehicle::Multibody system;       ///< whose coordinates the shapes of the modes have
  vehicle::StabilityResult result;
  std::optional<FallingRun> falling;  ///< where it was asked for
};

/// The vehicle of a simulation file on straight, even track, whatever line the file has. Errors: Error(configuration)
/// for speeds that are no range, wheels with full contact (differences over a discretised contact are no derivatives)
/// and rails that bend; those of the file. May be cancelled; a fall that is stopped says so.
StabilityRun run_stability(const StabilityRequest& request, const Progress& progress = {});

/// What follows for the vehicle, in a sentence.
std::string stability_verdict(const StabilityRun& run);

std::string stability_table(const StabilityRun& run);
std::string stability_json(const StabilityRun& run);
std::string stability_csv(const StabilityRun& run);
std::string stability_svg(const StabilityRun& run);

/// stability.json, eigenvalues.csv, stability.svg, and falling.csv where the speed fell.
void write_stability_folder(const std::filesystem::path& folder, const StabilityRun& run);

}  // namespace treadmark::app
