// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// Appends what is doubtful about a complete solution to its remarks; where the answer cannot be right, a hole within
/// contact or a pressure beyond all mechanics, its status becomes failed with the reason as message. A right-hand
/// problem and its solution. balanced: the vertical force that was brought to the prescribed one, without damping [N].
/// Thread-safe.
void judge(const Geometry& geometry, const Problem& problem, double balanced, PairSolution& solution);

}  // namespace treadmark::wheelrail
