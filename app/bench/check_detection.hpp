// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/detection/contact_search.hpp"

namespace treadmark::app {

/// The wheel moves so far down between a first and a second search [m].
inline constexpr double kWarmStep = 1e-6;

/// Holds a search by the method of its settings, first and after a small move, against searches on the full grid: the
/// same patches, references and least gaps. Returns what does not agree, or nothing; patches: their number, if not
/// null.
std::string check_search(const detection::BodyPair& bodies, const detection::SearchSettings& settings,
                         int* patches = nullptr);

/// Holds the undeformed distance on a grid against one put together from single heights.
std::string check_distance(const detection::BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C);

}  // namespace treadmark::app
