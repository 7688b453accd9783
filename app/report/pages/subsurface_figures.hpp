// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// Stresses below the surface at the chosen case: maps over planes along and across through the largest von Mises
/// stress, and the largest stress over the depth. Nothing where no block of points has two of both directions.
/// Thread-safe.
std::optional<Section> subsurface_section(const io::RunResult& run);

}  // namespace treadmark::app::report
