// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/io/cases/law_keys.hpp"
#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/io/simulations/evolution_model.hpp"

namespace treadmark::io {

/// [evolve].
struct EvolveInput {
  EvolutionFile file;
  std::optional<double> distance, passages;  ///< amounts of wheel and rail: [m], [-]
  EvolvingBody wheel, rail;
};

/// [evolve] of files of `treadmark evolve`, its [evolve.wheel] and [evolve.rail].
const KeyTable<EvolveInput>& evolve_keys();
const KeyTable<EvolvingBody>& evolving_body_keys();

}  // namespace treadmark::io
