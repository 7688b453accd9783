// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

constexpr int kSurfaceSlip = 3, kConformal = 4;  // D digits

void read_discretisation(ContactReader& r) {
  ContactText& text = r.text;
  text.begin_record("the discretisation line DX");
  DiscretisationInput d;
  d.dx = text.real("DX") * kMillimetre;
  if (!(d.dx > 0.0)) text.fail("DX must be positive");
  d.ds = text.real("DS") * kMillimetre;
  if (!(d.ds > 0.0)) text.fail("DS must be positive");
  d.dq_relative = text.real("DQREL", kMostStep);
  if (!(d.dq_relative > 0.0)) text.fail("DQREL must be positive");
  d.angle_separation = text.angle("A_SEP");
  d.separation = text.real("D_SEP") * kMillimetre;
  d.combination = text.real("D_COMB") * kMillimetre;
  if (d.combination < 0.0) text.fail("D_COMB must not be negative");
  if (d.separation < d.combination) text.fail("D_SEP must not be less than D_COMB");
  if (const auto turning = text.optional_real()) {
    d.turning = *turning * kMillimetre;
    if (const auto miss = text.optional_real()) d.near_miss = *miss * kMillimetre;
  }
  r.kept.wheel_rail.discretisation = d;
}

void put_friction(ContactReader& r, WheelRailCase& c) {
  const ContactSequence::Friction& f = r.kept.friction;
  const int variation = (*r.model)["VARFRC"];
  c.friction = f.laws.front();
  c.friction_variation = {};
  if (variation == 0) return;
  if (f.variation != variation)
    r.fail_at(*r.model, "FRCLAW",
              fmt::format("keeps the friction law, but none for V (VARFRC) = {} has been given", variation));
  c.friction_variation = f.by_place();
}

}  // namespace

FrictionVariation ContactSequence::Friction::by_place() const {
  if (variation == 0) return {};
  return {static_cast<FrictionVariation::Kind>(variation), positions, laws};
}

int discretisation_digit(const WheelRailCase& c) {
  return c.reference_surface == ReferenceSurface::plane_surface_slip ? kSurfaceSlip
         : c.reference_surface == ReferenceSurface::curved           ? kConformal
                                                                     : c.discretisation.method;
}

void put_discretisation(WheelRailCase& c, int digit, int max_elements) {
  constexpr int kAutomatic = 2;
  using Reference = ReferenceSurface;
  c.reference_surface = digit == kSurfaceSlip ? Reference::plane_surface_slip
                        : digit == kConformal ? Reference::curved
                                              : Reference::plane;
  c.discretisation.method = c.reference_surface == Reference::plane ? digit : kAutomatic;
  c.discretisation.max_elements = max_elements;
  c.conventions = c.discretisation.conventions = Conventions::contact;
}

WheelRailCase read_wheel_rail(ContactReader& r) {
  ContactText& text = r.text;
  const ControlWord& problem = *r.problem;
  const ControlWord& model = *r.model;

  r.read_solver();
  if (model["FRCLAW"] != 1) {
    long sets = 1;
    if (model["VARFRC"] != 0) {
      text.begin_record("the line NVF");
      sets = text.integer("NVF");
      if (sets < 1) text.fail("NVF must be positive");
    }
    r.read_friction(sets);
  }
  if (model["INFLCF"] == 9) throw r.refusal();
  if (model["INFLCF"] >= 2) {
    r.read_influence();
    r.read_material();
  }
  r.read_damping();
  r.read_heat();
  if (model["DISCNS"] >= 2) {
    read_discretisation(r);
    r.kept.discretisation_method = model["DISCNS"];
  }
  read_track(r);
  read_wheelset(r);
  r.read_subsurface();

  // Parts that are missing because no case has given them.
  if (!r.kept.has_rail)
    throw Error(ErrorKind::configuration,
                fmt::format("Z (ZTRACK) = {} keeps the rail, but no earlier case has given it", model["ZTRACK"]),
                model.where("ZTRACK"), "use Z = 3 in the first case");
  if (!r.kept.has_wheel)
    throw Error(ErrorKind::configuration,
                fmt::format("E (EWHEEL) = {} keeps the wheel, but no earlier case has given it", model["EWHEEL"]),
                model.where("EWHEEL"), "use E = 3 in the first case");

  WheelRailCase c = r.kept.wheel_rail;
  c.side = problem["CONFIG"] % 4 == 0 ? Side::left : Side::right;
  c.vertical_force_prescribed = problem["NORM"] == 1;
  c.regime = of_contact_digit(kRegimes, problem["TANG"]);
  c.history = r.history();
  put_motion(r, c);
  c.material = r.effective_material();
  put_friction(r, c);
  c.normal_model = of_contact_digit(kNormalTheories, problem["BOUND"]);
  r.put_simplified_theory(c.tangential_model, c.fastsim);
  c.influence = r.kept.influence;
  c.thermal = r.effective_heat();
  c.damping = r.kept.damping;
  c.subsurface = r.effective_subsurface();
  c.solver = r.kept.solver;
  constexpr int kOblique = 8;
  const int method = r.kept.discretisation_method;
  if (model["DISCNS"] < 2 && method >= kOblique)
    r.refuse(model.where("DISCNS"),
             fmt::format("D (DISCNS) = {} keeps D = {}, which is not supported", model["DISCNS"], method), "use D = 6");
  put_discretisation(c, method, r.kept.max_elements);
  c.discretisation.linear_weight = r.weight == 1;
  r.kept.previous_normal = problem["NORM"];
  return c;
}

}  // namespace treadmark::io
