// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/fatigue.hpp"

#include <algorithm>
#include <vector>

#include "treadmark/core/line.hpp"

namespace treadmark::damage {

double shakedown_limit(double friction) {
  // below the surface: Melan's theorem with the stresses of McEwen 1949 and of Smith and Liu 1953 (tests/damage)
  static const std::vector<double> frictions{0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35};
  static const std::vector<double> limits{4.0, 3.772, 3.565, 3.376, 3.203, 3.045, 2.9, 2.767};
  constexpr double kSurface = 0.367;  // from here on the surface itself
  return friction < kSurface ? BrokenLine(frictions, limits).at(friction) : 1.0 / friction;
}

double passage_damage(const FatigueSettings& settings, double t_gamma) {
  return BrokenLine(settings.t_gamma, settings.passage_damage).at(std::max(settings.t_gamma.front(), t_gamma));
}

ContactFatigue contact_fatigue(const FatigueSettings& settings, const PassedPatch& patch) {
  using M = FatigueMeasure;
  ContactFatigue out;
  double largest = 0.0;
  for (const PassedElement& e : patch.elements) {
    largest = std::max(largest, e.pressure);
    if (settings.has(M::martensite)) out[M::martensite] = std::max(out[M::martensite], e.temperature);
  }
  if (!(patch.normal_force > 0.0)) return out;
  out.friction = patch.traction_force / patch.normal_force;
  if (settings.shear_yield > 0.0) out.pressure_ratio = largest / settings.shear_yield;
  if (settings.has(M::fi_surf))
    out[M::fi_surf] = out.friction - 2.0 * patch.area() * settings.shear_yield / (3.0 * patch.normal_force);
  if (settings.has(M::shakedown)) out[M::shakedown] = out.pressure_ratio / shakedown_limit(out.friction);
  if (settings.has(M::whole_life)) out[M::whole_life] = passage_damage(settings, patch.t_gamma());
  return out;
}

}  // namespace treadmark::damage
