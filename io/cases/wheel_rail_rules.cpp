// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/shared_rules.hpp"

namespace treadmark::io {

namespace {

void forces(RuleList& rules, const WheelRailCase& c) {
  rules.refuse_if(c.longitudinal_force && c.regime == Regime::frictionless, CaseSetting::force,
                  "a prescribed longitudinal force needs friction, but no tangential problem is solved",
                  "T = 1 ... 3 in .inp, another case.regime in .toml");
  rules.refuse_if(c.rail_springs && !(c.rail_springs->stiffness_y > 0.0), CaseSetting::force,
                  "a rail on springs needs a positive lateral stiffness",
                  "KYRAIL in .inp, track.springs.stiffness_y_N_per_mm in .toml");
  rules.refuse_if(c.rail_springs && c.rail_springs->stiffness_z < 0.0, CaseSetting::force,
                  "the vertical stiffness of a rail must not be negative");
  rules.refuse_if(c.rail_springs && !c.vertical_force_prescribed && !(c.rail_springs->stiffness_z > 0.0),
                  CaseSetting::force,
                  "a rail on springs under a wheel of given height needs a positive vertical stiffness",
                  "KZRAIL or N = 1 in .inp, track.springs.stiffness_z_N_per_mm or wheelset.vertical_force_N in .toml");
}

void roller(RuleList& rules, const WheelRailCase& c) {
  if (!c.roller) return;
  rules.refuse_if(c.roller->nominal_radius == 0.0, CaseSetting::geometry, "the nominal radius of the roller is missing",
                  "NOMRAD in .inp, roller.nominal_radius_mm in .toml");
  rules.refuse_if(c.track.cant != 0.0, CaseSetting::geometry, "a roller has no cant",
                  "leave out track.cant, or tilt it by track.irregularity_roll");
  rules.refuse_if(c.friction_variation.kind == FrictionVariation::Kind::along_track, CaseSetting::friction,
                  "friction cannot vary along the track of a wheel on a roller");
}

void curved_reference(RuleList& rules, const WheelRailCase& c) {
  const bool corrected = c.influence.kind == InfluenceSettings::Kind::angle_corrected;
  rules.refuse_if(theory(c.influence.kind).limits.patch_only, CaseSetting::influence,
                  "numerical influence coefficients are not supported for a wheel on a rail");
  rules.refuse_if(corrected && !c.influence.position.empty(), CaseSetting::influence,
                  "the inclinations of a wheel on a rail come from the curved reference, they cannot be given");
  rules.refuse_if(corrected && c.reference_surface != ReferenceSurface::curved, CaseSetting::influence,
                  "angle-corrected influence coefficients need the curved reference of conformal contact",
                  "D = 4 in .inp, contact.reference_surface = \"curved\" in .toml");
  const bool approximate = c.normal_model != NormalModel::full;
  rules.refuse_if(c.reference_surface == ReferenceSurface::curved && approximate, CaseSetting::normal_model,
                  "conformal contact needs the full normal problem, KPEC and ANALYN are for a plane");
  rules.refuse_if(corrected && approximate, CaseSetting::influence,
                  "angle-corrected influence coefficients need the full normal problem");
}

void material(RuleList& rules, const WheelRailCase& c) {
  using Reference = ReferenceSurface;
  const bool by_row =
      c.reference_surface == Reference::curved && c.friction_variation.kind == FrictionVariation::Kind::inclination;
  simplified_theory(rules, c, by_row, false);
  const bool simplified = c.tangential_model != TangentialModel::full;
  rules.refuse_if(simplified && c.reference_surface != Reference::plane, CaseSetting::reference_surface,
                  "the simplified theory takes one creepage for a patch, not the slip of surfaces at every element",
                  "D = 2 in .inp, contact.reference_surface = \"plane\" in .toml");
  viscoelastic_rules(rules, c);
  rules.refuse_if(viscoelastic(c.material) && c.regime != Regime::frictionless && c.state.velocity.x < 0.0,
                  CaseSetting::material, "viscoelastic bodies must roll forward");
  if (c.material.layer_yield > 0.0 && rolling(c.regime))
    step_of_one_element(rules, c.discretisation.dq_relative * c.discretisation.dx, c.discretisation.dx);
}

void subsurface(RuleList& rules, const WheelRailCase& c) {
  double points = 0.0;
  for (const SubsurfaceInput::Block& b : c.subsurface.blocks) {
    if (b.z.empty() || (!b.at_elements && (b.x.empty() || b.y.empty())))
      return rules.add(CaseSetting::subsurface, "a block of subsurface points is empty",
                       "give depths, and x and y of free points");
    // The elements of a patch are not known yet.
    const auto columns =
        static_cast<double>(b.at_elements ? b.columns.size() * b.rows.size() : b.x.size() * b.y.size());
    points += (columns > 0.0 ? columns : static_cast<double>(c.discretisation.max_elements)) *
              static_cast<double>(b.z.size());
  }
  rules.refuse_if(points > kMostPoints, CaseSetting::subsurface,
                  fmt::format("{:.0f} subsurface points are more than {:.0f}", points, kMostPoints));
}

}  // namespace

std::vector<Contradiction> contradictions(const WheelRailCase& c) {
  RuleList rules;
  forces(rules, c);
  roller(rules, c);
  curved_reference(rules, c);
  material(rules, c);
  temperatures(rules, c, c.friction_variation.laws);
  subsurface(rules, c);
  return std::move(rules.found);
}

}  // namespace treadmark::io
