// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/graph_curve.hpp"

namespace treadmark::analytic {

// Pieces of wheel profiles from numbers in mm, as standards print them.

inline constexpr double kPieceMm = 1e-3;

/// Circle z = z_c + side sqrt(R^2 - (y - y_c)^2) over [from, to] (all mm), started from y_start.
inline ArcGraph circle_mm(double from, double to, double y_c, double z_c, double radius, int side, double y_start) {
  const double d = (y_start - y_c) / radius;
  ArcGraph arc;
  arc.x_min = from * kPieceMm;
  arc.x_max = to * kPieceMm;
  arc.x0 = y_start * kPieceMm;
  arc.k = -side / (radius * kPieceMm);
  arc.s0 = -side * d;
  arc.c0 = std::sqrt((1.0 - d) * (1.0 + d));
  arc.h0 = (z_c + side * radius * arc.c0) * kPieceMm;
  return arc;
}

/// Line z = a + b y over [from, to] (mm).
inline ArcGraph line_mm(double from, double to, double a, double b) {
  ArcGraph line;
  line.x_min = from * kPieceMm;
  line.x_max = to * kPieceMm;
  line.x0 = from * kPieceMm;
  line.h0 = (a + b * from) * kPieceMm;
  line.s0 = b / std::hypot(1.0, b);
  line.c0 = 1.0 / std::hypot(1.0, b);
  return line;
}

/// Polynomial with coefficients of powers of y in mm.
inline PolynomialGraph powers_mm(double from, double to, const std::vector<double>& coefficients) {
  PolynomialGraph p = PolynomialGraph::from_powers(from, to, coefficients);
  p.x_min *= kPieceMm;
  p.x_max *= kPieceMm;
  p.middle *= kPieceMm;
  p.half *= kPieceMm;
  for (double& c : p.c) c *= kPieceMm;
  return p;
}

}  // namespace treadmark::analytic
