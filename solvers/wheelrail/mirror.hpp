// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// A left-hand problem seen in a mirror (y -> -y) is a right-hand one. Both directions are the same operation;
/// profiles and prescribed vertical forces are not touched.
Problem mirrored(Problem problem);

/// The solution seen in the mirror: lateral positions, roll-type angles, lateral forces, moments about x and z change
/// sign, element rows change order.
PairSolution mirrored(PairSolution solution);

/// A field of a grid with its rows in the other order.
void reverse_rows(std::vector<double>& field, const Grid2& grid);

}  // namespace treadmark::wheelrail
