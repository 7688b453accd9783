// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/model/damage/fatigue.hpp"
#include "treadmark/model/damage/flow_law.hpp"
#include "treadmark/model/damage/named_laws.hpp"
#include "treadmark/model/damage/wear_law.hpp"

namespace treadmark::io {

/// [law], [fatigue] and [flow] of a body that evolves.
const KeyTable<WearLaw>& wear_law_keys();
const KeyTable<FatigueSettings>& fatigue_keys();
const KeyTable<FlowLaw>& flow_law_keys();

/// The numbers of a law as its table of an evolution file has them: "k = [0.001]; hardness_GPa = 3".
std::string numbers_of(const NamedLaw& law);

}  // namespace treadmark::io
