// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace treadmark {

/// What can be doubtful about a contact result although it was found. A new kind is an enumerator, a row and the place
/// that finds it: what follows from a solved patch or pair in solvers/{kalker,wheelrail}/plausibility.hpp, the rest
/// where it is seen (`git grep RemarkKind::`).
enum class RemarkKind : std::uint8_t {
  grid_cuts_contact,
  grid_touches_contact,
  grid_bounds_contact,
  surface_ends_in_contact,
  between_sections,
  hole_in_contact,
  contact_hidden,
  beyond_half_space,
  beyond_yield,
  strongly_curved,
  curved,
  reference_far,
  few_elements,
  coarse_elements,
  large_creepage,
  unusual_friction,
  friction_adds_energy,
  force_not_reached,
  force_differs,
  no_contact_under_load,
  elements_enlarged,
  step_rule,
  profile_doubtful,
  gauge_unseen,
  off_nominal_height,
  on_flange_tip,
  on_flange_back,
  unusual_value,
  noisy_profile,
  locus_incomplete,
  contact_overlooked,
  beyond_theory,
  edge_pressure,
  unverified_law,
};

/// A kind of remark. The limits are stated where they are tested.
struct RemarkRow {
  RemarkKind kind;
  std::string_view name;     ///< in result files
  bool grave;                ///< the numbers may be wrong, not only less exact: the run's exit status says so
  std::string_view meaning;  ///< for documentation
};

/// Rows lie in the order of the enumerators.
inline constexpr RemarkRow kRemarkRows[] = {
    {RemarkKind::grid_cuts_contact, "grid_cuts_contact", true,
     "more pressure at the border of the potential contact area than at the edge of a patch: it goes on beyond"},
    {RemarkKind::grid_touches_contact, "grid_touches_contact", false,
     "contact reaches the border of the potential contact area with no more pressure than at the edge of a patch"},
    {RemarkKind::grid_bounds_contact, "grid_bounds_contact", false,
     "the bodies are under pressure at the border of the potential contact area, and may not touch beyond it "
     "(patch.grid_border = \"closed\", which input of CONTACT means)"},
    {RemarkKind::surface_ends_in_contact, "surface_ends_in_contact", true,
     "contact reaches the end of a surface's data: pressures there depend on where the data end"},
    {RemarkKind::between_sections, "between_sections", true,
     "contact lies between two sections of a rail of which one begins or ends elsewhere: the surface between them "
     "joins what is not the same part"},
    {RemarkKind::hole_in_contact, "hole_in_contact", true,
     "a surface is missing inside or beside the patch: the case fails"},
    {RemarkKind::contact_hidden, "contact_hidden", true,
     "along the normal of a contact another part of the wheel's or rail's section comes first, as at a guard rail: the "
     "case fails"},
    {RemarkKind::beyond_half_space, "beyond_half_space", true,
     "largest pressure above 0.05 E', E' = G / (1 - nu) (steel: 5.7 GPa); of a patch without wheel and rail above "
     "0.1 E', and not judged where E' < 0.1 GPa: the patch is no longer small against the radii of the bodies; a wheel "
     "on a rail fails above 0.25 E'"},
    {RemarkKind::beyond_yield, "beyond_yield", false,
     "largest pressure above 0.03 E' (steel: 3.4 GPa): steel yields, the elastic answer is an upper bound"},
    {RemarkKind::strongly_curved, "strongly_curved", true,
     "the rail's surface is inclined by more than 30 degrees against the plane of a planar contact within the patch: "
     "conformal contact is meant"},
    {RemarkKind::curved, "curved", false, "the same by more than 15 degrees"},
    {RemarkKind::reference_far, "reference_far", false,
     "the contact reference lies outside the patch by more than the patch's length: creepages and the contact angle "
     "are taken there"},
    {RemarkKind::few_elements, "few_elements", false,
     "fewer than 20 elements in contact: the largest pressure is off by several per cent, and with fewer than 5 it is "
     "an order of magnitude only"},
    {RemarkKind::coarse_elements, "coarse_elements", false,
     "smaller elements would change the largest pressure or the forces by more than 5 %, as far as coarser ones tell, "
     "or "
     "a contact lies between them and carries nothing"},
    {RemarkKind::large_creepage, "large_creepage", false,
     "creepage, or spin times the patch's radius, above 0.1 in rolling: motions are taken as small against rolling"},
    {RemarkKind::unusual_friction, "unusual_friction", false,
     "a coefficient of friction above 1: dry steel on steel reaches 0.6 to 0.8"},
    {RemarkKind::friction_adds_energy, "friction_adds_energy", true,
     "tractions push where the surfaces slip: friction adds more than a hundredth of what it dissipates"},
    {RemarkKind::force_not_reached, "force_not_reached", true,
     "a prescribed force differs from the one found by more than 0.2 %"},
    {RemarkKind::force_differs, "force_differs", false,
     "the same, as it is meant: damping comes on top of the prescribed force, or pressures by a formula are summed "
     "over elements"},
    {RemarkKind::no_contact_under_load, "no_contact_under_load", true,
     "a normal or vertical force is prescribed and the bodies do not touch"},
    {RemarkKind::elements_enlarged, "elements_enlarged", false,
     "elements were enlarged to keep their number below max_elements"},
    {RemarkKind::step_rule, "step_rule", false, "a step of transient rolling is longer than dt = 2 dx / V"},
    {RemarkKind::profile_doubtful, "profile_doubtful", true,
     "what a profile means is in doubt: its orientation, its place, its unit; see treadmark check"},
    {RemarkKind::gauge_unseen, "gauge_unseen", true,
     "the rail's section ends above the height at which the gauge is measured: its lateral place is that of its end"},
    {RemarkKind::off_nominal_height, "off_nominal_height", true,
     "the wheel stands more than 5 mm off its nominal height on a rail placed by the gauge"},
    {RemarkKind::on_flange_tip, "on_flange_tip", true,
     "the wheel stands on the tip of its flange, 15 mm beyond the nominal radius, or its radius there is more than 45 "
     "mm off the nominal one"},
    {RemarkKind::on_flange_back, "on_flange_back", true,
     "the back of the flange alone touches: without a check rail a wheel cannot be there"},
    {RemarkKind::unusual_value, "unusual_value", true,
     "a number of the problem that no railway has, as in another unit: a load, gauge, radius, speed, angle or place"},
    {RemarkKind::noisy_profile, "noisy_profile", true,
     "noise of a measured profile or scan, or points far apart, leave a standard deviation of more than 2.5 % of the "
     "largest pressure"},
    {RemarkKind::locus_incomplete, "locus_incomplete", false,
     "on a rail that changes along the track a grid shows contact of more than 3 um that the locus search of CONTACT's "
     "input (D = 2, 3, 4, 7) missed, or none where it found some: the refined grid search decides"},
    {RemarkKind::contact_overlooked, "contact_overlooked", true,
     "a grid shows contact that this search missed, more than 2 % of the wheel's radius deep and 5 % of it ahead or "
     "behind: no wheel rolls over that, an artefact between sections is likely; the locus decides"},
    {RemarkKind::beyond_theory, "beyond_theory", true,
     "an approximate theory where it misses the exact one by more than a tenth of the friction bound: FASTSIM and "
     "FaStrip under spin on patches that are too wide or too long for them, one flexibility that is not that of the "
     "creepages, tractions of the linear theory that exceed friction; KPEC on long patches, whose pressure is off by "
     "more than 5 %"},
    {RemarkKind::edge_pressure, "edge_pressure", false,
     "the largest pressure grows without limit with smaller elements, as at an edge, a kink or the end of a surface; "
     "forces and mean pressures do not"},
    {RemarkKind::unverified_law, "unverified_law", false,
     "a named law of wear or fatigue whose numbers have not been compared with their source: treadmark list laws"},
};

/// One remark on one result.
struct Remark {
  RemarkKind kind = RemarkKind::few_elements;
  int patch = 0;     ///< number of the patch, from 1; 0: the whole case
  std::string text;  ///< what was found, with numbers, and what to do

  const RemarkRow& row() const { return kRemarkRows[static_cast<std::size_t>(kind)]; }
  bool grave() const { return row().grave; }
};

/// The kind of this name; none for an unknown one.
std::optional<RemarkKind> remark_named(std::string_view name);
/// Whether one of them is grave.
bool any_grave(std::span<const Remark> remarks);
/// A message and behind it what grave ones say, with semicolons between them.
std::string with_grave(std::string message, std::span<const Remark> remarks);
/// "warning: patch 2: ..." or, where it is not grave, "minor warning: ...".
std::string to_line(const Remark& remark);

}  // namespace treadmark
