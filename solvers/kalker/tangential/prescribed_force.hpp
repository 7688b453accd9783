// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <functional>

namespace treadmark::kalker {

/// Forces at given creepages, relative to the target's scale, with their derivatives. Only the first `count` are used.
struct ForceSample {
  std::array<double, 2> force{};
  std::array<std::array<double, 2>, 2> derivative{};  ///< [force][creepage]
  bool sliding = false;                               ///< no element is in adhesion: the derivatives say little
};

struct ForceSearchSettings {
  int count = 1;  ///< unknown creepages: 1 or 2
  std::array<double, 2> target{};
  std::array<double, 2> start{};
  double tolerance = 1e-5;  ///< on each force
  int max_iterations = 30;
  bool exact_derivatives = true;  ///< else they only start a quasi-Newton iteration (Broyden 1965)
};

struct ForceSearchResult {
  bool converged = false;
  int iterations = 0;
  std::array<double, 2> creepage{};  ///< the last one evaluated
  double residual = 0.0;             ///< largest deviation there
};

/// Creepages at which the forces have the target values. Forces are taken to oppose creepages: an interval around a
/// single unknown is kept and shrinks; two unknowns are found by Newton's method, which backtracks where it does not
/// reduce the deviation and damps steps from sliding states, where derivatives vanish.
ForceSearchResult find_creepage(const ForceSearchSettings& settings,
                                const std::function<ForceSample(std::array<double, 2>)>& evaluate);

}  // namespace treadmark::kalker
