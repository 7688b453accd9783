// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <string>

#include "treadmark/analysis/measured/nominal.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::measured {

/// In words what shows that the side of great y of a rail's head is worn and that of small y is not, by what a worn top
/// does not change, 14 mm and more below it: both sides from the middle of the web, where 20 mm of that are in the
/// section; else their inclination, which is 1:20 where nothing is worn; else the nominal sections, where the rail lies
/// in their axes. Nothing where nothing shows it. Thread-safe.
std::optional<std::string> worn_at_great_y(const Profile& rail, std::span<const NominalOutline> nominals);

}  // namespace treadmark::measured
