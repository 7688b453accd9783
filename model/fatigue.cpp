// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/fatigue.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

[[noreturn]] void refuse_fatigue(std::string message, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), {}, std::move(advice));
}

void require_known(double value, const char* key, const FatigueMeasureRow& row) {
  if (!(value > 0.0) || !std::isfinite(value))
    refuse_fatigue(fmt::format("{} needs a positive {}", row.word, key),
                   "fatigue has no numbers of its own: give those of the material");
}

void require_increasing(const std::vector<double>& values, const char* key, double above) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || !(i > 0 ? values[i] > values[i - 1] : values[i] >= above))
      refuse_fatigue(fmt::format("{} must increase and not be negative", key));
}

void check_depths(const std::vector<double>& depths, const FatigueMeasureRow& row) {
  if (depths.empty()) refuse_fatigue(fmt::format("{} needs depths_mm", row.word), "give depths below the surface");
  if (!(depths.front() > 0.0)) refuse_fatigue("depths_mm must be positive");
  require_increasing(depths, "depths_mm", 0.0);
}

}  // namespace

bool FatigueSettings::has(FatigueMeasure measure) const { return std::ranges::count(measures, measure) > 0; }

void check(const FatigueSettings& settings) {
  for (const FatigueMeasure measure : settings.measures) {
    const FatigueMeasureRow& row = kFatigueMeasures[static_cast<std::size_t>(measure)];
    switch (measure) {
      case FatigueMeasure::fi_surf:
      case FatigueMeasure::shakedown:
        require_known(settings.shear_yield, "shear_yield_MPa", row);
        break;
      case FatigueMeasure::whole_life:
        if (settings.t_gamma.size() < 2 || settings.t_gamma.size() != settings.passage_damage.size())
          refuse_fatigue(fmt::format("t_gamma_N has {} values and damage_per_passage has {}", settings.t_gamma.size(),
                                     settings.passage_damage.size()),
                         "they are the points of a line: as many, and at least two");
        require_increasing(settings.t_gamma, "t_gamma_N", 0.0);
        break;
      case FatigueMeasure::subsurface:
        check_depths(settings.depths, row);
        require_known(settings.shear_yield, "shear_yield_MPa", row);
        break;
      case FatigueMeasure::dang_van:
        check_depths(settings.depths, row);
        require_known(settings.dang_van_slope, "dang_van_slope", row);
        require_known(settings.dang_van_limit, "dang_van_limit_MPa", row);
        break;
      case FatigueMeasure::martensite:
        require_known(settings.austenite, "austenite_C", row);
        break;
    }
  }
}

}  // namespace treadmark
