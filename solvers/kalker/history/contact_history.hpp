// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/grid.hpp"

namespace treadmark::kalker {

struct ContactProblem;
struct ContactSolution;

/// What one instant leaves to the next, on its grid: tractions, friction with memory, the state of the interface layer.
/// Plain data: a copy is a saved state. Fields have grid.size() values, or none.
struct ContactHistory {
  Grid2 grid;                                            ///< nx = 0: the bodies come together from rest
  std::vector<double> pressure, traction_x, traction_y;  ///< [Pa]
  std::vector<double> friction;                          ///< coefficients, static where there was no contact
  std::vector<double> plastic_x, plastic_y;              ///< plastic shear distance of the layer [m]
  std::vector<double> yield_stress;                      ///< [Pa]
  std::vector<double> layer_x, layer_y;                  ///< simplified theory: displacement of its layer [m]

  /// Whether there was no instant before.
  bool empty() const { return grid.nx == 0; }
  friend bool operator==(const ContactHistory&, const ContactHistory&) = default;
};

/// What a solved instant leaves.
ContactHistory history_of(const ContactProblem& problem, const ContactSolution& solution);

/// The same on any other grid: the mean over the area of each new element, so that forces stay what they were; zero
/// (friction: static) outside the old grid. Errors: Error(configuration) for elements more than 10 000 times as large.
ContactHistory averaged_on(const ContactHistory& history, const Grid2& grid, double static_friction,
                           double first_yield_stress);

/// The same on another grid of the same steps, displaced by whole elements. Errors: Error(configuration) for grids that
/// do not line up.
ContactHistory on_grid(const ContactHistory& history, const Grid2& grid, double static_friction,
                       double first_yield_stress);

/// A field of a history where material was that is now dx, dy [m] further back: linear between element centres,
/// `outside` beyond.
std::vector<double> carried(const Grid2& grid, const std::vector<double>& field, double dx, double dy, double outside);

}  // namespace treadmark::kalker
