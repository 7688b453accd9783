// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Stresses below the surface at the chosen case: maps over planes along and across through the largest von Mises
/// stress, and the largest stress over the depth. Nothing where no block of points has two of both directions.
/// Thread-safe.
std::optional<report::Section> subsurface_section(const io::RunResult& run);

}  // namespace treadmark::app::pages
