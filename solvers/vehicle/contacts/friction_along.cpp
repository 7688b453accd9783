// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/friction_along.hpp"

#include <algorithm>
#include <limits>

namespace treadmark::vehicle {

void FrictionAlong::put(FrictionLaw& law, double travelled) const {
  if (varies()) law = friction_at(place, laws, rail_x + travelled, law);
}

double FrictionAlong::longest_travel(double travelled) const {
  constexpr double kShortest = 1e-3;  // [m], well within a contact
  const double x = rail_x + travelled;
  const auto next = std::upper_bound(place.begin(), place.end(), x);
  if (place.end() - next < 2) return std::numeric_limits<double>::infinity();
  // To the middle of the stretch behind the next place: no end of a step lies just before a place, again and again.
  return std::max(kShortest, *next - x + 0.5 * (next[1] - *next));
}

}  // namespace treadmark::vehicle
