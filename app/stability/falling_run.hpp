// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/simulation/contact_tables.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/solvers/vehicle/stability/falling_speed.hpp"

namespace treadmark::app {

/// Runs whose speed falls from where the vehicle sways until it does no more.
struct FallingRequest {
  double from = 0.0, to = 0.0;                    ///< speeds [m/s]
  double deceleration = 0.4;                      ///< of the first run; the second falls at a quarter of it [m/s2]
  double hold = 500.0;                            ///< distance before the speed falls [m]
  double window = 100.0;                          ///< over which sway is averaged [m]
  double amplitude = 1e-4;                        ///< of wheelsets that sway no more [m]
  double wave_height = 3e-3, wave_length = 20.0;  ///< of the track to the side, which disturbs the vehicle [m]
  std::filesystem::path folder;                   ///< histories are kept here, in a folder each; empty: nowhere
  bool anew = false;                              ///< discard what is there; else it is gone on with
};

/// One run.
struct Fall {
  vehicle::FallSettings settings;
  std::string status = "complete", message;  ///< as of SimulationResult
  vehicle::FallResult result;                ///< of a complete run
  std::vector<vehicle::SwayAt> forces;       ///< sums of guiding forces over half of what EN 14363 allows them [-]
};

/// All of them and what they say.
struct FallingRun {
  FallingRequest request;
  std::vector<Fall> falls;                        ///< the second one where the limit cycle died in the first
  std::optional<vehicle::SlowFall> critical;      ///< speed at which it dies
  std::optional<vehicle::LastAbove> forces_fall;  ///< where guiding forces fall below half of their limit; last run

  /// "complete", or what the last run was.
  const std::string& status() const { return falls.back().status; }
};

/// file: on straight, even track. settings: echo of overrides. Results are the same for any number of interruptions.
/// Errors: those of run_simulation; Error(configuration) for speeds and lengths that make no sense.
FallingRun run_falling(const io::SimulationFile& file, const std::vector<std::string>& settings,
                       const FallingRequest& request, SurfaceStore& store, ContactTables& tables,
                       const Progress& progress);

/// What follows, in a sentence.
std::string falling_verdict(const FallingRun& run);
/// A word for it: "died", "none", "lasting", or the status of a run that is not complete.
std::string falling_word(const FallingRun& run);
/// Sway over speed of all runs.
std::string falling_csv(const FallingRun& run);

}  // namespace treadmark::app
