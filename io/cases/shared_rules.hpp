// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/io/cases/combination_rules.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::io {

/// Rules that hold for a wheel on a rail and for one patch alike; Content is WheelRailCase or BasicCase.

inline constexpr double kMostPoints = 2e7;  // below the surface

class RuleList {
 public:
  std::vector<Contradiction> found;

  void add(CaseSetting setting, std::string message, std::string advice = {}) {
    found.push_back({setting, std::move(message), std::move(advice)});
  }
  void refuse_if(bool bad, CaseSetting setting, std::string message, std::string advice = {}) {
    if (bad) add(setting, std::move(message), std::move(advice));
  }
};

inline bool viscoelastic(const Material& m) { return m.creep_ratio_1 > 0.0 || m.creep_ratio_2 > 0.0; }
inline bool rolling(Regime r) { return r == Regime::transient || r == Regime::steady; }
/// The solution depends on the previous instant.
inline bool goes_on(Regime r) { return r == Regime::transient || r == Regime::shift; }

/// friction_varies, slip_of_elements: what the content adds to one coefficient of friction and to creepages.
template <class Content>
void simplified_theory(RuleList& rules, const Content& c, bool friction_varies, bool slip_of_elements) {
  if (c.tangential_model == TangentialModel::full) return;
  const Theory<TangentialModel>& simplified = theory(c.tangential_model);
  rules.refuse_if(simplified.limits.steady_only && goes_on(c.regime), CaseSetting::material,
                  fmt::format("the simplified theory ({}) is for steady rolling, not for a shift or transient rolling",
                              simplified.word),
                  "use T = 3 or M = 0 in .inp, case.regime = \"steady\" or tangential_model = \"full\" in .toml");
  rules.refuse_if(simplified.limits.rolling_only && c.regime == Regime::shift, CaseSetting::material,
                  fmt::format("the simplified theory ({}) is for rolling, not for a shift", simplified.word),
                  "use M = 0 in .inp, tangential_model = \"full\" in .toml");
  rules.refuse_if(c.material.layer_yield > 0.0, CaseSetting::layer,
                  "the simplified theory knows no plasticity of the interface layer");
  rules.refuse_if(friction_varies || c.friction.kind == FrictionLaw::Kind::temperature, CaseSetting::friction,
                  "the simplified theory knows one coefficient of friction, not one by row or by temperature");
  rules.refuse_if(slip_of_elements, CaseSetting::extra_slip,
                  "the simplified theory takes no slip that is given for every element");
  rules.refuse_if(c.sensitivities, CaseSetting::material, "the simplified theory gives no sensitivities");
}

/// All but the direction of rolling.
template <class Content>
void viscoelastic_rules(RuleList& rules, const Content& c) {
  constexpr double kDissimilar = 1e-4;
  const Material& m = c.material;
  rules.refuse_if(
      m.relaxation_time_1 < 0.0 || m.relaxation_time_2 < 0.0 || m.creep_ratio_1 < 0.0 || m.creep_ratio_2 < 0.0,
      CaseSetting::material, "creep ratios and relaxation times must not be negative");
  if (!viscoelastic(m)) return;
  rules.refuse_if(goes_on(c.regime), CaseSetting::regime,
                  "viscoelastic bodies need steady rolling or no tangential problem");
  const double difference = combine(m).difference;
  rules.refuse_if(std::abs(difference) >= kDissimilar, CaseSetting::elastic_constants,
                  fmt::format("viscoelastic bodies must not be dissimilar (K = {:.3g})", difference));
  rules.refuse_if(c.influence.kind != InfluenceSettings::Kind::constant, CaseSetting::influence,
                  "viscoelastic bodies need the half-space with constant elements");
  rules.refuse_if(c.normal_model != NormalModel::full || c.tangential_model != TangentialModel::full,
                  CaseSetting::material, "viscoelastic bodies need the full normal and tangential problem");
}

inline void step_of_one_element(RuleList& rules, double step, double element) {
  constexpr double kSameStep = 0.01;  // relative difference that counts as none
  rules.refuse_if(
      std::abs(step - element) > kSameStep * element, CaseSetting::layer,
      fmt::format(
          "a layer that yields needs a rolling step of one element: the step is {:.6g} mm, elements are {:.6g} mm",
          step * 1e3, element * 1e3));
}

/// further: friction laws besides that of the content.
template <class Content>
void temperatures(RuleList& rules, const Content& c, std::span<const FrictionLaw> further) {
  const auto thermal = [](const FrictionLaw& f) { return f.kind == FrictionLaw::Kind::temperature; };
  rules.refuse_if(!c.thermal && (thermal(c.friction) || std::any_of(further.begin(), further.end(), thermal)),
                  CaseSetting::friction,
                  "friction that depends on the temperature needs the thermal data of the bodies",
                  "H = 3 in .inp, [heat] in .toml");
  rules.refuse_if(c.thermal && c.regime != Regime::steady, CaseSetting::heat,
                  "surface temperatures need steady rolling");
}

}  // namespace treadmark::io
