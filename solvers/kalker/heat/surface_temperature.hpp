// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

/// Temperatures of the two surfaces [deg C], one value an element; the greatest of the elements in contact (0 without).
struct SurfaceTemperatures {
  std::vector<double> body_1, body_2;
  double max_1 = 0.0, max_2 = 0.0;
};

/// Heat flux [W/m^2] that friction, and plastic shear of an interface layer by its share, produce in each element of a
/// solution of steady rolling; size problem.grid.size().
std::vector<double> frictional_heat(const ContactProblem& problem, const ContactSolution& solution,
                                    double plastic_fraction);

/// Surface temperatures in steady rolling along +-x (Ertz and Knothe 2002): material enters each row with the bulk
/// temperatures, heat flows normal to the surface only (large Peclet number). In the contact the surfaces share one
/// temperature: friction heats both alike, heat flows from the warmer to the colder body; behind it each relaxes on its
/// own. A row with gaps counts as in contact from its first to its last element; heat arises where it does.
/// problem.thermal gives the properties, and whose conventions hold. Thread-safe. Errors: Error(configuration) without
/// thermal properties, for values that are not positive, regimes other than steady, a velocity that is not positive,
/// fields of other sizes.
SurfaceTemperatures surface_temperatures(const ContactProblem& problem, const ContactSolution& solution);

/// Puts the temperatures into the solution.
void add_surface_temperatures(const ContactProblem& problem, ContactSolution& solution);

}  // namespace treadmark::kalker
