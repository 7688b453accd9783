// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "treadmark/core/constants.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/io/cases/combination_rules.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::contact {

Problem::Problem(int ire, int icp, int which) : element(ire), number(icp), module(which) {
  Material& m = given.material;
  m.shear_modulus_1 = m.shear_modulus_2 = 1e6;
  given.solver.max_coupling = 1;
  given.thermal = Thermal{};
  given.thermal->conventions = Conventions::contact;
  given.rail_springs = RailSprings{};
  given.longitudinal_force = given.pitch_rate = given.roller_pitch_rate = 0.0;
  given.forward_velocity = 30.0;
  given.wheel_rail.state.velocity.x = 30.0;
  io::DiscretisationInput& d = given.wheel_rail.discretisation;
  d.turning = 2.0 * d.separation - d.combination;

  io::BasicCase& b = given.basic;
  b.velocity = 1.0;
  b.dq = b.dx = b.dy = 2e-3;
  b.mx = b.my = 1;
  b.grid_border = io::GridBorder::closed;
  given.potential_contact = 1;
  given.gap = io::GapInput{io::GapInput::Kind::quadratic, std::vector<double>(6, 0.0)};
  io::HertzInput& h = given.hertz;
  h.a1 = h.b1 = 1.0;
  h.aa = h.bb = 5e-3;
  b.fx_relative = b.fy_relative = 0.0;
}

namespace {

/// A digit that Treadmark does not support, in words.
void check_digit(int module, std::string_view keyword, int value) {
  for (const io::DigitValue& d : io::contact_digits()) {
    if (d.module != module || d.keyword != keyword || d.value != value) continue;
    if (d.support != io::DigitSupport::no) return;
    throw Refusal{CNTC_err_input, fmt::format("{} ({}) = {}, {}, is not supported{}{}", d.letter, keyword, value,
                                              d.meaning, d.condition.empty() ? "" : "; use ", d.condition)};
  }
  throw Refusal{CNTC_err_input, fmt::format("{} = {} does not exist in module {}", keyword, value, module)};
}

void check_digits(const Problem& p) {
  struct Row {
    std::string_view keyword;
    int code;
    bool rail_only;
  };
  constexpr Row kRows[] = {{"CONFIG", CNTC_ic_config, true}, {"DISCNS", CNTC_ic_discns, true},
                           {"BOUND", CNTC_ic_bound, false},  {"TANG", CNTC_ic_tang, false},
                           {"FORCE", CNTC_ic_force, false},  {"INFLCF", CNTC_ic_inflcf, false}};
  for (const Row& row : kRows)
    if (!row.rail_only || p.module == 1) check_digit(p.module, row.keyword, p.flags[row.code]);
  check_digit(p.module, "MATER", p.material_digit);
  constexpr int kSheet = 1, kAngleCorrected = 4;
  if (p.flags[CNTC_ic_bound] == kSheet)
    throw Refusal{CNTC_err_input, "B (BOUND) = 1, a sheet, is not supported: its flexibility cannot be given"};
  if (p.module == 3 && p.flags[CNTC_ic_inflcf] == kAngleCorrected)
    throw Refusal{CNTC_err_input, "C3 (INFLCF) = 4 is not supported in module 3: its inclinations cannot be given"};
}

/// What both modules take of the settings in the same way.
template <class Content>
void put_common(const Problem& p, Content& c) {
  constexpr int kViscoelastic = 1, kLayer = 4;
  constexpr double kNoYield = 1e-4;  // [Pa]
  const MaterialInput& in = p.material;
  c.regime = of_contact_digit(kRegimes, p.flags[CNTC_ic_tang]);
  c.history = p.previous ? io::kHistories[p.flags[CNTC_ic_pvtime]] : HistoryUse::start;
  c.normal_model = of_contact_digit(kNormalTheories, p.flags[CNTC_ic_bound]);
  c.tangential_model = of_contact_digit(kTangentialTheories, p.material_digit);
  c.fastsim = {in.k0, in.alpha, in.beta, in.flexibility, FastsimSettings::FirstStep::whole};
  c.influence.kind = of_contact_digit(kInfluenceKinds, p.flags[CNTC_ic_inflcf]);
  c.influence.linear = p.flags[CNTC_ic_ifmeth] == 0;
  c.influence.variant = p.flags[CNTC_ic_ifvari];
  c.solver = p.given.solver;
  c.conventions = Conventions::contact;
  c.friction = p.given.friction.laws.front();
  c.sensitivities = p.flags[CNTC_ic_sens] >= 2;
  c.subsurface = {};
  c.thermal.reset();
  if (p.heat_digit != 0) c.thermal = p.given.thermal;
  Material& m = c.material = p.given.material;
  m.layer_flexibility = m.layer_yield = m.layer_hardening = 0.0;
  m.creep_ratio_1 = m.creep_ratio_2 = m.relaxation_time_1 = m.relaxation_time_2 = 0.0;
  if (p.material_digit == kViscoelastic) {
    m.creep_ratio_1 = in.fg[0], m.creep_ratio_2 = in.fg[1];
    m.relaxation_time_1 = in.relaxation[0], m.relaxation_time_2 = in.relaxation[1];
  } else if (p.material_digit == kLayer) {
    m.layer_flexibility = in.thickness / in.g3;
    if (in.yield > kNoYield) m.layer_yield = in.yield, m.layer_hardening = in.hardening;
  }
}

io::WheelRailCase compose_rail(const Problem& p) {
  constexpr int kOnRoller = 4, kLongitudinalForce = 1, kMasslessRail = 3;
  const io::ContactSequence& g = p.given;
  const int config = p.flags[CNTC_ic_config], force = p.flags[CNTC_ic_force];
  io::WheelRailCase c = g.wheel_rail;
  c.side = config % kOnRoller == 0 ? Side::left : Side::right;
  c.vertical_force_prescribed = p.flags[CNTC_ic_norm] == 1;
  c.roller.reset();
  c.state.velocity.x = g.forward_velocity.value_or(0.0);
  if (config >= kOnRoller) {
    if (g.roller_radius.value_or(0.0) == 0.0)
      throw Refusal{CNTC_err_input, "a roller needs its nominal radius (cntc_settrackdimensions)"};
    c.roller = {*g.roller_radius, g.roller_pitch_rate.value_or(0.0)};
    c.state.velocity.x = 0.0;
    c.track.cant = 0.0;
  }
  c.state.velocity.pitch = g.pitch_rate.value_or(0.0);
  c.longitudinal_force.reset();
  if (force == kLongitudinalForce) c.longitudinal_force = g.longitudinal_force;
  c.rail_springs.reset();
  if (force == kMasslessRail) c.rail_springs = g.rail_springs;
  put_common(p, c);
  c.friction_variation = g.friction.by_place();
  c.damping.reset();
  if (p.damped) c.damping = p.material.damping;
  io::put_discretisation(c, p.flags[CNTC_ic_discns], p.flags[CNTC_ic_npomax]);
  const char* search = std::getenv("TREADMARK_CONTACT_SEARCH");
  c.discretisation.conventions = Conventions{search == nullptr || std::string_view(search) != "refined"};
  return c;
}

io::BasicCase compose_basic(const Problem& p) {
  constexpr int kKeepSlip = 1, kSlipPerElement = 9;
  const io::ContactSequence& g = p.given;
  const int force = p.flags[CNTC_ic_force], slip = p.flags[CNTC_ic_exrhs];
  io::BasicCase c = g.basic;
  put_common(p, c);
  c.normal_force_prescribed = p.flags[CNTC_ic_norm] == 1;
  if (force >= 1) c.xi = 0.0;
  if (force >= 2) c.eta = 0.0;
  if (force < 1) c.fx_relative.reset();
  if (force < 2) c.fy_relative.reset();
  if (g.potential_contact < 0)
    c.geometry = g.hertz;
  else
    c.geometry = *g.gap;
  const std::size_t elements = static_cast<std::size_t>(c.mx) * static_cast<std::size_t>(c.my);
  if (elements > static_cast<std::size_t>(io::kMostElements))
    throw Refusal{CNTC_err_discr, fmt::format("{} x {} elements are too many", c.mx, c.my)};
  if (g.potential_contact > 0 && g.gap->kind == io::GapInput::Kind::per_element &&
      g.gap->coefficients.size() != elements)
    throw Refusal{CNTC_err_discr, "the undeformed distance was given for another number of elements"};
  c.spin_slip = slip == 2 ? io::SpinSlip::longitudinal : slip == 3 ? io::SpinSlip::lateral : io::SpinSlip::both;
  if (slip == kSlipPerElement || slip == kKeepSlip) {
    if (!g.extra_slip_x.empty() && g.extra_slip_x.size() != elements)
      throw Refusal{CNTC_err_discr, "the extra rigid slip was given for another number of elements"};
    c.extra_slip_x = g.extra_slip_x;
    c.extra_slip_y = g.extra_slip_y;
    if (c.regime == Regime::shift)
      for (auto* component : {&c.extra_slip_x, &c.extra_slip_y})
        for (double& value : *component) value *= kMillimetre;
  }
  return c;
}

int code_of(io::CaseSetting setting) {
  using S = io::CaseSetting;
  return setting == S::friction                         ? CNTC_err_frclaw
         : setting == S::grid || setting == S::geometry ? CNTC_err_discr
                                                        : CNTC_err_input;
}

void refuse(const std::vector<io::Contradiction>& found) {
  if (found.empty()) return;
  const io::Contradiction& first = found.front();
  throw Refusal{code_of(first.setting), first.advice.empty() ? first.message : first.message + "; " + first.advice};
}

}  // namespace

io::Case compose(const Problem& p) {
  check_digits(p);
  io::Case c;
  c.number = p.flags[CNTC_if_ncase] + 1;
  c.element_table = p.flags[CNTC_ic_matfil];
  if (p.module == 1)
    c.content = compose_rail(p);
  else
    c.content = compose_basic(p);
  refuse(io::contradictions(c));
  if (p.previous) refuse(io::contradictions(*p.previous, c));
  return c;
}

}  // namespace treadmark::contact
