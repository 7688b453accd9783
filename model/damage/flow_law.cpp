// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/flow_law.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

[[noreturn]] void refuse_flow(std::string message, std::string advice) {
  throw Error(ErrorKind::configuration, std::move(message), {}, std::move(advice));
}

void require_number(double value, const char* key) {
  if (!(value > 0.0) || !std::isfinite(value))
    refuse_flow(fmt::format("the law of flow needs a positive {}", key),
                "a law of flow has no numbers of its own: give those of the material");
}

}  // namespace

double FlowLaw::yield_after(double strain) const {
  if (!(hardening_factor > 0.0)) return shear_yield;
  return shear_yield * std::max(1.0, hardening_factor * std::sqrt(-std::expm1(-hardening_rate * strain)));
}

void check(const FlowLaw& law) {
  if (law.theory == FlowTheory::none) return;
  require_number(law.shear_yield, "shear_yield_MPa");
  require_number(law.strain_per_cycle, "strain_per_cycle");
  if (law.depths.size() < 2) refuse_flow("depths_mm needs at least two depths", "layers lie between them");
  for (std::size_t i = 0; i < law.depths.size(); ++i)
    if (!std::isfinite(law.depths[i]) || !(law.depths[i] > (i > 0 ? law.depths[i - 1] : 0.0)))
      refuse_flow("depths_mm must be positive and increase", "");
  if ((law.hardening_factor > 0.0) != (law.hardening_rate > 0.0))
    refuse_flow("hardening_factor and hardening_rate go together",
                "give both, or none for a material that does not harden");
  if (!(law.hardening_factor >= 0.0) || !(law.hardening_rate >= 0.0) || !std::isfinite(law.hardening_factor) ||
      !std::isfinite(law.hardening_rate))
    refuse_flow("hardening_factor and hardening_rate must not be negative", "");
}

}  // namespace treadmark
