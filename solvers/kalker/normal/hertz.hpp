// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/grid.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

/// Contact of two smooth bodies with h = A x^2 + B y^2 on an ellipse, or h = A x^2 on a strip of finite length (line
/// contact): Hertz 1882, Johnson 1985 ch. 4. A line contact has curvature_y = 0 and semi_axis_y = half the strip's
/// length. The load is a force [N] or an approach [m]; the other one is computed. The approach of a line contact is not
/// defined by the theory: it stays 0, and prescribing it is an error.
struct HertzLoad {
  bool force_prescribed = true;
  double value = 0.0;  ///< force [N] or approach [m], > 0
};

/// What is known of the geometry.
/// All functions throw Error(configuration) for values that are not positive.
HertzShape hertz_from_curvatures(double curvature_x, double curvature_y, const HertzLoad& load,
                                 const CombinedMaterial& material);
/// curvature_x [1/m] and aspect ratio a/b [-].
HertzShape hertz_from_curvature_and_ratio(double curvature_x, double ratio, const HertzLoad& load,
                                          const CombinedMaterial& material);
HertzShape hertz_from_semi_axes(double a, double b, const HertzLoad& load, const CombinedMaterial& material);
HertzShape hertz_line_from_curvature(double curvature_x, double half_length, const HertzLoad& load,
                                     const CombinedMaterial& material);
HertzShape hertz_line_from_semi_axis(double a, double half_length, const HertzLoad& load,
                                     const CombinedMaterial& material);

bool is_line_contact(const HertzShape& shape);
/// Greatest pressure [Pa].
double hertz_max_pressure(const HertzShape& shape);
/// Hertzian pressure [Pa] at (x, y) [m]; 0 outside.
double hertz_pressure(const HertzShape& shape, double x, double y);
/// A paraboloid over the same area with the same force: the traction bound for which simplified theory was made
/// (Kalker 1982).
double parabolic_pressure(const HertzShape& shape, double x, double y);

/// Grid of nx by ny elements over +-scale times the semi-axes. A line contact of several rows is covered so that whole
/// rows fit its length, the remaining ones lie outside on both sides.
Grid2 hertz_grid(const HertzShape& shape, int nx, int ny, double scale);

/// h = A x^2 + B y^2 [m] at the element centres of a grid.
std::vector<double> hertz_gap(const HertzShape& shape, const Grid2& grid);

/// Semi-double-elliptic contact (SDEC): two half ellipses with the same semi-axis a along x and different ones, b_minus
/// towards -y and b_plus towards +y, joined at y0 = (b_minus - b_plus)/2 [m], so that the patch fills -b .. b with
/// b = (b_minus + b_plus)/2. Pressure of each half as in a Hertzian contact; both share the greatest one,
/// 1.5 F/(pi a b).
/// Returned: semi-axes a, b, b_minus, b_plus; curvatures and approach are those of the ellipse with semi-axes a and b,
/// which stands for the unknown geometry. Errors: Error(configuration) for values that are not positive.
HertzShape hertz_semi_double_elliptic(double a, double b_minus, double b_plus, const HertzLoad& load,
                                      const CombinedMaterial& material);

bool is_semi_double_elliptic(const HertzShape& shape);

/// Pressure [Pa] at (x, y) [m]; 0 outside. With b_minus = b_plus it is Hertz' pressure.
double semi_double_elliptic_pressure(const HertzShape& shape, double x, double y);

}  // namespace treadmark::kalker
