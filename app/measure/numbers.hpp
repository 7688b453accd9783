// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/analysis/measures/rail.hpp"
#include "treadmark/analysis/measures/roughness.hpp"
#include "treadmark/analysis/measures/round.hpp"
#include "treadmark/analysis/measures/wheel.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::app {

/// What is said of a whole wheel: of one section, or the medians of several; with what only a revolution tells.
struct WheelNumbers : measures::WheelMeasures {
  measures::Measure runout, axial_runout, eccentricity;  ///< [m]
  measures::Measure flat_depth, flat_length;             ///< of the deepest flat; 0: there is none [m]
  measures::Measure back_to_back, active_faces;          ///< with the other wheel of the axle [m]
};

/// The same of a rail.
struct RailNumbers : measures::RailMeasures {
  measures::Measure roughness_exceedance;  ///< largest of a band over its limit [dB]
};

/// A number of results: its row, and where it stands.
template <class Numbers>
struct NumberRow : Column<Numbers> {
  measures::Measure Numbers::*at;

  double uncertainty_in_file(const Numbers& numbers) const { return this->unit.per_si * (numbers.*at).uncertainty; }
};

/// In the order in which they are shown.
std::span<const NumberRow<WheelNumbers>> number_rows(const WheelNumbers&);
std::span<const NumberRow<RailNumbers>> number_rows(const RailNumbers&);

}  // namespace treadmark::app
