// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::kalker {

/// nn: normal displacement by pressure; xx, yy: tangential displacement by traction in the same direction;
/// xy (= yx): in the other direction.
enum class Component { nn, xx, yy, xy };

/// Influence coefficient C [m] of a rectangle dx by dy [m] under uniform traction: displacement difference
/// u = (1/G) C p of the pair of half-spaces at (X, Y) [m] relative to the centre of the loaded rectangle
/// (Boussinesq-Cerruti potentials integrated over the rectangle, Kalker 1990). G and poisson are the combined
/// constants of treadmark::combine. Accurate relative to the coefficient itself to about 5e-16 times the distance in
/// elements, but no better than 1e-15.
double influence(Component component, double X, double Y, double dx, double dy, double poisson);

/// The four coefficients at once, bit by bit the same values.
struct UncoupledCoefficients {
  double nn = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
};
UncoupledCoefficients influence(double X, double Y, double dx, double dy, double poisson);

}  // namespace treadmark::kalker
