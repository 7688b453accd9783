// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/app/evolve/wheel_numbers.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/simulations/evolution_model.hpp"

namespace treadmark::app {

/// A body that evolves as the input gives it.
struct GivenBody {
  std::shared_ptr<const NaturalSurface> surface;
  double radius = 0.0;              ///< nominal, of a wheel [m]
  double x_min = 0.0, x_max = 0.0;  ///< where contacts are along the track [m]
};

/// A contact of a generation, and what part of each body it stands for.
struct PassedCase {
  io::Case given;
  std::string label;                     ///< of the position
  int run = 0, number = 0;               ///< of the position, and of the case within it
  double weight = 0.0;                   ///< of all cases beside it
  int beside = 1;                        ///< cases that share the weight
  std::vector<damage::Stretch> stretch;  ///< by body
};

/// All contacts of a generation.
struct PassedContacts {
  io::RunResult run;               ///< cases with their fields
  std::vector<PassedCase> passed;  ///< one for each of them
  std::vector<RailMet> rails;      ///< below them
  /// Histories whose instants the cases are, one for each position; empty: there are none.
  std::vector<io::SimulationResult> simulations;
  std::vector<io::EvolutionQuantity> numbers;  ///< of these histories
};

/// Where the contacts of an evolution come from.
class ContactSource {
 public:
  virtual ~ContactSource() = default;
  /// Errors: Error(configuration) where positions have different surfaces of the body.
  virtual GivenBody given(const io::EvolvingBody& body) = 0;
  /// The contacts of all positions over surfaces, one for each body that evolves. Errors: Error(numerical) for contacts
  /// that cannot be solved; Cancelled.
  virtual PassedContacts solve(const std::vector<NaturalSurface>& surfaces, const Progress& progress) = 0;
};

/// Cases that prescribe where the wheel is on the rail. Errors: those of readers and surfaces.
std::unique_ptr<ContactSource> case_contacts(const io::EvolutionFile& file);
/// Instants of simulations of a vehicle. settings: echo of overrides.
std::unique_ptr<ContactSource> simulated_contacts(const io::EvolutionFile& file,
                                                  const std::vector<std::string>& settings);

/// What a run of an evolution is called: the values of what varies, or its number.
std::string position_label(const io::EvolutionFile& file, const io::StudyRun& run);

/// Stretches of cases of one position that share their weight, one case after the other, on all bodies.
void place_along_bodies(const io::EvolutionFile& file, std::vector<PassedCase>& cases, std::size_t first,
                        std::size_t count);

/// Adds the rail below a case, unless it is known.
void meet_rail(std::vector<RailMet>& rails, const io::WheelRailCase& input, std::shared_ptr<const Surface> rail,
               double weight);

}  // namespace treadmark::app
