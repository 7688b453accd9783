// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

long elements(const BasicCase& b) { return static_cast<long>(b.mx) * b.my; }

void read_kinematics(ContactReader& r) {
  ContactText& text = r.text;
  BasicCase& b = r.kept.basic;
  const int force = (*r.problem)["FORCE"];
  // A shift is a distance and a rotation, in rolling they are divided by the distance rolled.
  const bool shift = (*r.problem)["TANG"] == 1;
  text.begin_record("the line FN");
  if ((*r.problem)["NORM"] == 1)
    b.normal_force = text.real("FN");
  else
    b.approach = text.real("PEN") * kMillimetre;
  b.fx_relative.reset();
  b.fy_relative.reset();
  if (force >= 1)
    b.fx_relative = text.real("FX");
  else
    b.xi = text.real("CKSI", kMostCreepage) * (shift ? kMillimetre : 1.0);
  if (force >= 2)
    b.fy_relative = text.real("FY");
  else
    b.eta = text.real("CETA", kMostCreepage) * (shift ? kMillimetre : 1.0);
  b.phi = text.real("CPHI", kMostCreepage * (shift ? 1.0 : kMillimetre)) * (shift ? 1.0 : kMilli);
  if (force >= 1) b.xi = 0.0;
  if (force >= 2) b.eta = 0.0;
  b.spin_x = b.spin_y = 0.0;
  if (const auto x = text.optional_real()) {
    b.spin_x = *x * kMillimetre;
    if (const auto y = text.optional_real()) b.spin_y = *y * kMillimetre;
  }
}

void read_extra_slip(ContactReader& r) {
  ContactSequence& kept = r.kept;
  const int digit = (*r.model)["EXRHS"];
  if (digit == 1) return;
  kept.extra_slip_x.clear();
  kept.extra_slip_y.clear();
  kept.spin_slip = digit == 2 ? SpinSlip::longitudinal : digit == 3 ? SpinSlip::lateral : SpinSlip::both;
  if (digit != 9) return;
  r.text.begin_record("the extra rigid slip");
  for (long i = 0; i < elements(kept.basic); ++i) {
    kept.extra_slip_x.push_back(r.text.real("WX", kMostCreepage));
    kept.extra_slip_y.push_back(r.text.real("WY", kMostCreepage));
  }
}

void put_extra_slip(const ContactReader& r, BasicCase& b) {
  b.extra_slip_x = r.kept.extra_slip_x;
  b.extra_slip_y = r.kept.extra_slip_y;
  b.spin_slip = r.kept.spin_slip;
  if (!b.extra_slip_x.empty() && static_cast<long>(b.extra_slip_x.size()) != elements(b))
    r.fail_at(*r.model, "EXRHS",
              "keeps the extra rigid slip of every element although the number of elements has changed", "use E = 9");
  if (b.regime != Regime::shift) return;
  for (std::vector<double>* component : {&b.extra_slip_x, &b.extra_slip_y})
    for (double& value : *component) value *= kMillimetre;
}

void put_geometry(const ContactReader& r, BasicCase& b) {
  const ControlWord& model = *r.model;
  b.planform = {};
  if (r.kept.potential_contact < 0) {
    b.geometry = r.kept.hertz;
    return;
  }
  if (!r.kept.gap)
    r.fail_at(model, "RZNORM", "keeps the undeformed distance, but no earlier case has given it", "use Z = 2");
  if (r.kept.gap->kind == GapInput::Kind::per_element && r.kept.gap_elements != elements(b))
    throw Error(ErrorKind::configuration,
                "the undeformed distance of every element is kept although the number of elements has changed",
                model.where("RZNORM"), "use Z (RZNORM) = 2");
  b.geometry = *r.kept.gap;
  b.planform = r.kept.planform;
}

void put_friction(const ContactReader& r, BasicCase& b) {
  const ContactSequence::Friction& f = r.kept.friction;
  b.friction = f.laws.front();
  b.friction_of_row.clear();
  if ((*r.model)["VARFRC"] != 3) return;
  if (f.variation != 3 || f.laws.size() != static_cast<std::size_t>(b.my))
    r.fail_at(*r.model, "FRCLAW",
              fmt::format("keeps the friction law, but none for each of {} rows has been given", b.my));
  b.friction_of_row = f.laws;
}

void put_models(ContactReader& r, BasicCase& b) {
  const ControlWord& problem = *r.problem;
  b.normal_force_prescribed = problem["NORM"] == 1;
  b.regime = of_contact_digit(kRegimes, problem["TANG"]);
  b.normal_model = of_contact_digit(kNormalTheories, problem["BOUND"]);
  b.history = r.history();
  b.material = r.effective_material();
  r.put_simplified_theory(b.tangential_model, b.fastsim);
  b.influence = r.kept.influence;
  b.thermal = r.effective_heat();
  b.solver = r.kept.solver;
  b.conventions = Conventions::contact;
  if (problem["TANG"] >= 2 && !r.kept.has_rolling)
    r.fail_at(problem, "TANG", "needs the rolling line CHI DQ VELOC, but no case has given it",
              "use C (INFLCF) = 2 here");
}

}  // namespace

BasicCase read_basic(ContactReader& r) {
  const ControlWord& model = *r.model;
  const bool by_row = model["VARFRC"] == 3;

  r.read_solver();
  read_kinematics(r);
  if (model["FRCLAW"] != 1 && !by_row) r.read_friction(1);
  if (model["INFLCF"] >= 2) {
    if ((*r.problem)["TANG"] >= 2) r.read_rolling();
    r.read_influence();
    r.read_material();
  }
  r.read_damping();
  r.read_heat();
  if (model["DISCNS"] == 2) read_potential_contact(r);
  if (r.kept.potential_contact == 0)
    r.fail_at(model, "DISCNS", "keeps the potential contact, but no earlier case has given it",
              "use D = 2 in the first case");
  if (r.kept.potential_contact > 0 && model["RZNORM"] == 2) read_gap(r);
  if (model["FRCLAW"] != 1 && by_row) r.read_friction(r.kept.basic.my);
  read_extra_slip(r);
  r.read_subsurface();

  BasicCase b = r.kept.basic;
  b.grid_border = GridBorder::closed;
  put_geometry(r, b);
  put_models(r, b);
  put_friction(r, b);
  put_extra_slip(r, b);
  b.subsurface = r.effective_subsurface();
  return b;
}

}  // namespace treadmark::io
