// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <vector>

#include "treadmark/core/report.hpp"
#include "treadmark/solvers/kalker/contact_gradient.hpp"

namespace treadmark::wheelrail {

/// A number of a pair's solution that has derivatives by the gaps of its patches.
struct PairQuantity {
  /// What it belongs to.
  enum class Of {
    height,          ///< z of the wheelset [m]
    vertical_force,  ///< on the rail, track axes, without damping [N]
    patch,           ///< a number of one patch; force_x and the like at the creepages that it has
  };
  Of of = Of::height;                                        ///< of a patch: of which, and what
  std::size_t patch = 0;                                     ///< place in PairSolution::patches
  kalker::Quantity number = kalker::Quantity::max_pressure;  ///< of the patch, in its grid's axes
};

/// Derivatives of a number by gaps, with the balance of a vertical force that is given. Contact planes, elements and
/// creepages stay, and so does the vertical force of a patch relative to its normal force; elements stay in contact or
/// out of it and adhere or slip (kalker::Gradient). What a change of shape does by turning and moving a contact plane
/// is not in it: Pair::neighbours() has all of that.
struct PairGradient {
  /// Of each patch: by the gap of each of its elements [unit/m]. A rail that is moved by d along n, into itself, adds d
  /// to the gap, a wheel that is moved so takes it away: by heights along n they are these, and these with the other
  /// sign.
  std::vector<std::vector<double>> by_gap;
  double by_load = 0.0;  ///< by the vertical force [unit/N] where it is given, else by the height z [unit/m]
  Report report;         ///< iterations of two products each; derivatives of another status than ok are none
};

}  // namespace treadmark::wheelrail
