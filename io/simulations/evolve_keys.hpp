// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/io/simulations/evolution_model.hpp"
#include "treadmark/model/damage/named_laws.hpp"

namespace treadmark::io {

/// [evolve].
struct EvolveInput {
  EvolutionFile file;
  std::optional<double> distance, passages;  ///< amounts of wheel and rail: [m], [-]
  EvolvingBody wheel, rail;
};

/// [evolve] of files of `treadmark evolve`, its [evolve.wheel] and [evolve.rail], and their [law], [fatigue] and
/// [flow].
const KeyTable<EvolveInput>& evolve_keys();
const KeyTable<EvolvingBody>& evolving_body_keys();
const KeyTable<WearLaw>& wear_law_keys();
const KeyTable<FatigueSettings>& fatigue_keys();
const KeyTable<FlowLaw>& flow_law_keys();

/// The numbers of a law as its table of an evolution file has them: "k = [0.001]; hardness_GPa = 3".
std::string numbers_of(const NamedLaw& law);

}  // namespace treadmark::io
