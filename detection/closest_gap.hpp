// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

/// The least gap lies between the points of a grid; the gap near it is a parabola.

/// Vertex of the parabola through three values at equal steps, the middle one the least; the middle one where they bend
/// the wrong way or one is missing.
double vertex(double before, double here, double after);

/// The same of the paraboloid through a point of least gap and its eight neighbours.
double vertex(const GapField& field, int ix, int iy);

/// Least gap [m] about a point of a field, exactly, on ever finer grids. bodies: those of the field.
double closest_about(const BodyPair& bodies, const GapField& field, int ix, int iy);

}  // namespace treadmark::detection
