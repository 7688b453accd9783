// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <algorithm>
#include <cmath>

#include "treadmark/core/pose.hpp"
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
  const bool takes_slip = c.reference_surface == Reference::plane_surface_slip &&
                          takes_slip_of_elements(c.tangential_model) && c.conventions != Conventions::contact;
  rules.refuse_if(simplified && c.reference_surface != Reference::plane && !takes_slip, CaseSetting::reference_surface,
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

namespace {

bool continues(HistoryUse h) { return h == HistoryUse::keep_going || h == HistoryUse::same_instant; }

/// Steps equal, origins a whole number of steps apart.
bool same_raster(double a0, double a_step, double b0, double b_step) {
  constexpr double kTolerance = 1e-3;  // of a step
  const double steps = (b0 - a0) / a_step;
  return std::abs(b_step - a_step) < kTolerance * a_step && std::abs(steps - std::round(steps)) < kTolerance;
}

bool same_grid(const BasicCase& a, const BasicCase& b) {
  // The grid of Hertzian geometry is not known before it is solved.
  const bool known = a.dx > 0.0 && a.dy > 0.0 && b.dx > 0.0 && b.dy > 0.0;
  return !known || (same_raster(a.x0, a.dx, b.x0, b.dx) && same_raster(a.y0, a.dy, b.y0, b.dy));
}

/// Grids of a wheel on a rail line up by themselves.
bool same_grid(const WheelRailCase& a, const WheelRailCase& b) {
  constexpr double kTolerance = 1e-4;
  const auto same = [](double p, double q) { return std::abs(p - q) <= kTolerance * p; };
  return same(a.discretisation.dx, b.discretisation.dx) && same(a.discretisation.ds, b.discretisation.ds);
}

template <class Content>
bool keeps_grid(const Case& previous, const Case& next) {
  const auto *a = std::get_if<Content>(&previous.content), *b = std::get_if<Content>(&next.content);
  return a == nullptr || b == nullptr || !continues(b->history) || !goes_on(b->regime) || same_grid(*a, *b);
}

}  // namespace

std::vector<Contradiction> contradictions(const Case& previous, const Case& next) {
  RuleList rules;
  rules.refuse_if(!keeps_grid<WheelRailCase>(previous, next), CaseSetting::grid,
                  "a case that continues the previous one needs elements of the same size",
                  "start anew (P = 2 in .inp, case.history = \"start\" in .toml)");
  const auto *a = std::get_if<WheelRailCase>(&previous.content), *b = std::get_if<WheelRailCase>(&next.content);
  if (a != nullptr && b != nullptr && continues(b->history) && goes_on(b->regime))
    rules.refuse_if(a->reference_surface != b->reference_surface || a->side != b->side ||
                        a->roller.has_value() != b->roller.has_value(),
                    CaseSetting::grid,
                    "a case that continues the previous one must be on the same side, on track or roller as before, "
                    "with the same kind of reference surface",
                    "start anew (P = 2 in .inp, case.history = \"start\" in .toml)");
  return std::move(rules.found);
}

std::string doubt_about_history(const Case& previous, const Case& next) {
  if (!keeps_grid<BasicCase>(previous, next))
    return "the elements are not those of the case before, moved by whole elements: tractions that it left are "
           "averaged over each new element";
  const auto step = rolled_step(previous, next);
  return step ? step->complaint() : "";
}

std::string doubt_about_motion(const Case& c) {
  const auto* rail = std::get_if<WheelRailCase>(&c.content);
  if (rail == nullptr || !rolling(rail->regime) || rail->longitudinal_force) return {};
  const SixMotion& rate = rail->state.velocity;
  if (rail->state.wheel_velocity != SixMotion{}) return {};
  if (rail->rolls_by_radius && rate == SixMotion{} && !rail->roller)
    return "wheelset.rolling = \"nominal\", and no speed is given: nothing moves, and tangential forces are zero "
           "(give wheelset.velocity_km_h)";
  if (rail->rolls_by_radius) return {};
  if (rate.x != 0.0 && rate.pitch == 0.0 && !rail->roller)
    return "a speed is given, and no pitch rate: the wheel slides without turning "
           "(wheelset.rolling = \"free\" or \"nominal\" makes it roll)";
  if (rate != SixMotion{}) return {};
  return "neither a speed nor rolling is given: nothing creeps, and tangential forces are zero "
         "(wheelset.velocity_km_h and wheelset.rolling = \"nominal\" make the wheel roll)";
}

std::optional<RolledStep> rolled_step(const Case& previous, const Case& next) {
  const auto *a = std::get_if<WheelRailCase>(&previous.content), *b = std::get_if<WheelRailCase>(&next.content);
  if (a == nullptr || b == nullptr || b->history != HistoryUse::keep_going || b->regime != Regime::transient)
    return std::nullopt;
  const SixMotion &from = a->state.position, &to = b->state.position;
  RolledStep step;
  step.rolled = b->discretisation.dq_relative * b->discretisation.dx;
  step.longest = 2.0 * b->discretisation.dx;
  const double along = b->roller ? 0.0 : std::abs(to.x - from.x);
  step.moved = std::max(along, b->wheelset.nominal_radius * std::abs(wrap_angle(to.pitch - from.pitch)));
  return step;
}

std::string RolledStep::complaint() const {
  constexpr double kSame = 0.1;  // creep, and radii other than the nominal one
  if (too_long())
    return fmt::format(
        "wheel or rail move {:.4g} mm through the contact since the previous case, more than two elements ({:.4g} mm): "
        "the "
        "history does not reach that far",
        moved * 1e3, longest * 1e3);
  if (moved > 0.0 && std::abs(moved - rolled) > kSame * rolled)
    return fmt::format(
        "wheel or rail move {:.4g} mm through the contact since the previous case, but a rolling step is {:.4g} mm",
        moved * 1e3, rolled * 1e3);
  return {};
}

}  // namespace treadmark::io
