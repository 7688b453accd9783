// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/analysis/geometry/analysis.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/io/histories/evolution_model.hpp"

namespace treadmark::app {

/// A rail as the wheelset meets it on both sides.
struct RailMet {
  std::shared_ptr<const Surface> rail;
  double x = 0.0;     ///< along the rail [m]
  double cant = 0.0;  ///< [rad]
  geometry::PairPlacement placement;
  double weight = 0.0;  ///< share of all
};

/// Whether there is a flange and a tread to be measured. Thread-safe.
bool is_measurable(const Surface& wheel, double nominal_radius);

/// What workshops ask of a wheel that is the same all round (analysis/measures/wheel.hpp), and the equivalent conicity
/// at 3 mm of two such wheels on these rails, mean by weight. NaN: not known; the list is always the same. Thread-safe.
std::vector<io::EvolutionQuantity> wheel_numbers(const Surface& wheel, double nominal_radius,
                                                 const std::vector<RailMet>& rails);

}  // namespace treadmark::app
