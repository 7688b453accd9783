// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/contact/friction.hpp"

namespace treadmark::vehicle {

/// Friction that varies along the rail below a wheel: between the places every number of the law is interpolated,
/// beyond them it stays. The whole contact has that of the place of its axle. Safe to use from any number of threads.
struct FrictionAlong {
  std::vector<double> place = {};      ///< along the rail, increasing [m]; empty: the same everywhere
  std::vector<FrictionLaw> laws = {};  ///< at them
  double rail_x = 0.0;                 ///< place of the axle along the rail where it has travelled nothing [m]

  bool varies() const { return !place.empty(); }
  /// Makes law that below an axle that has travelled so far [m]; leaves it as it is where friction does not vary.
  void put(FrictionLaw& law, double travelled) const;
  /// How far that axle may go on in a step, so that some step ends between any two neighbouring places that a contact
  /// can tell apart [m].
  double longest_travel(double travelled) const;
};

}  // namespace treadmark::vehicle
