// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "treadmark/core/report.hpp"
#include "treadmark/core/surface.hpp"
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

/// Weights of heights along the normal of a plane, over points of it.
struct HeightWeights {
  Pose X_SP;                    ///< of the plane in the axes of the surface
  std::vector<Vec2> points_P;   ///< [m]
  std::vector<double> weights;  ///< [unit/m], as many
};

/// Total derivatives of a number by the heights of both surfaces, wherever it depends on them: over the elements, where
/// the search found the contact plane, and where the gauge, the top or the tape circle place a body. At places where
/// something comes or goes (elements in contact, adhesion or the interpenetration, the place of the largest pressure,
/// a rail's top or side that is not one place) they are one-sided, those of what is there.
struct HeightGradient {
  std::vector<HeightWeights> rail;  ///< by heights of the rail; of a left-hand pair as of the right-hand one it mirrors
  std::vector<HeightWeights> wheel;  ///< likewise
  /// Of each patch, what of it lies over its grid, gathered at the elements: by heights of the rail along n [unit/m].
  std::vector<std::vector<double>> rail_field;
  /// By heights of the wheel along n, which points into the rail [unit/m].
  std::vector<std::vector<double>> wheel_field;
  Report report;  ///< iterations of two products each; derivatives of another status than ok are none
};

/// Derivatives by all parameters of a surface.
struct ShapeGradient {
  std::vector<double> by;                ///< [unit per unit of Surface::parameters()]
  HeightsBy heights = HeightsBy::exact;  ///< how heights were found to follow from them
};
/// Of weights of its heights. Errors: as Surface::pull_back().
ShapeGradient pulled_back(const Surface& surface, std::span<const HeightWeights> weights);

}  // namespace treadmark::wheelrail
