// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// Complete elliptic integrals for the axis ratio g <= 1: K, E of modulus k = sqrt(1 - g^2), and (E - g^2 K) / k^2.
struct EllipseIntegrals {
  double first, second, combined;
};
EllipseIntegrals ellipse_integrals(double axis_ratio);

/// Curvature ratio min(A, B) / max(A, B) that belongs to the axis ratio g = min(a, b) / max(a, b).
double hertz_curvature_ratio(double axis_ratio);

/// Ellipse on which two smooth bodies with the gap h = A x^2 + B y^2 touch (Hertz 1882; Johnson 1985 ch. 4).
struct HertzEllipse {
  double semi_axis_x = 0.0, semi_axis_y = 0.0;  ///< [m]
  double force = 0.0;                           ///< [N]
  double approach = 0.0;                        ///< [m]
  double largest_pressure() const;              ///< [Pa]
};

/// curvature_x, curvature_y: A, B > 0 [1/m]; force > 0 [N]; modulus: G / (1 - nu) of the pair [Pa], which is
/// E / (2 (1 - nu^2)) of equal bodies.
HertzEllipse hertz_by_force(double curvature_x, double curvature_y, double force, double modulus);
/// The same from the approach > 0 [m].
HertzEllipse hertz_by_approach(double curvature_x, double curvature_y, double approach, double modulus);

}  // namespace treadmark
