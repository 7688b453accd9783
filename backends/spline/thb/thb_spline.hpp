// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"
#include "treadmark/backends/spline/thb/thb_space.hpp"

namespace treadmark::spline {

/// A surface of truncated hierarchical B-splines: all three coordinates, surface frame [m].
struct ThbSpline {
  ThbSpace space;
  std::vector<Vec3> coefficients;  ///< by the numbers of the functions

  /// By the parameters, clamped to the ends.
  Vec3 point(double u, double v) const;
};

/// A part of the parameters with the Bernstein coefficients of degree 3 over it.
struct CubicPiece {
  ThbRange range;
  ThbPiece b;
};

/// Of a cell, exactly: what has degree 1 or 2 is raised.
CubicPiece cubic_piece(const ThbSpline& spline, const ThbCell& cell);

/// So many pieces as a list of patches, neighbours near each other.
NurbsNet listed_net(std::size_t count, const std::function<CubicPiece(std::size_t)>& piece);

/// Its cells as bicubic patches.
NurbsNet extracted(const ThbSpline& spline);

}  // namespace treadmark::spline
