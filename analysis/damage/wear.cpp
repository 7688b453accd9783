// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/wear.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::damage {
namespace {

double in_regime(const std::vector<double>& values, const std::vector<double>& limits, double where) {
  const auto above = ranges::lower_bound(limits, where);
  return values[static_cast<std::size_t>(above - limits.begin())];
}

}  // namespace

double depth_rate(const WearLaw& law, const PassedPatch& patch, const PassedElement& element) {
  switch (law.theory) {
    case WearTheory::archard: {
      const double speed = element.slip * patch.velocity;
      const bool seized = law.k_seizure > 0.0 && element.pressure > law.seizure_ratio * law.hardness;
      const double k = seized ? law.k_seizure : in_regime(law.k, law.slip_limits, speed);
      return k * element.pressure * speed / law.hardness;
    }
    case WearTheory::t_gamma:
      if (element.dissipation <= 0.0) return 0.0;
      return BrokenLine(law.t_gamma_area, law.wear_rate)
                 .at(std::max(law.t_gamma_area.front(), element.dissipation / patch.velocity)) *
             patch.velocity / law.density;
    case WearTheory::energy:
      return in_regime(law.volume_per_work, law.power_limits, patch.power / patch.area()) * element.dissipation;
    case WearTheory::t_gamma_patch:
      if (element.dissipation <= 0.0 || patch.power <= 0.0) return 0.0;
      return BrokenLine(law.patch_t_gamma, law.volume_rate).at(std::max(law.patch_t_gamma.front(), patch.t_gamma())) *
             patch.velocity * element.dissipation / patch.power;
  }
  return 0.0;
}

double volume_by_distance(const WearLaw& law, double t_gamma, double area, double speed) {
  PassedPatch patch;
  patch.velocity = speed, patch.power = t_gamma * speed;
  patch.length = area, patch.width = 1.0;
  patch.elements.resize(1);
  patch.elements.front().dissipation = patch.power / area;
  return depth_rate(law, patch, patch.elements.front()) * area / speed;
}

}  // namespace treadmark::damage
