// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/log.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"

// Track, wheelset and whole input files of module 1.

namespace treadmark::contact {
namespace {

using Values = std::span<const double>;

[[noreturn]] void refuse_track(const char* digit, int value, std::size_t count) {
  throw Refusal{CNTC_err_input, fmt::format("{} = {} does not exist, or not with {} values", digit, value, count)};
}

void set_placement(Problem& p, Values v) {
  io::ContactSequence& g = p.given;
  Track& t = g.wheel_rail.track;
  const double l = p.units.length;
  t.gauge_based = v[0] > 0.0;
  t.gauge_at_innermost = true;
  if (t.gauge_based) {
    t.gauge_height = v[0] * l;
    t.gauge_width = v[2] * l;
  } else {
    t.rail_y0 = v[1] * l;
    t.rail_z0 = v[2] * l;
  }
  t.cant = v[3];
  g.roller_radius = v[4] * l;
}

void set_deviation(Problem& p, Values v) {
  Track& t = p.given.wheel_rail.track;
  const double l = p.units.length, velocity = p.units.velocity();
  t.dy = v[0] * l, t.dz = v[1] * l, t.roll = v[2];
  t.vy = v[3] * velocity, t.vz = v[4] * velocity, t.vroll = v[5];
}

void set_track(Problem& p, int z, Values v) {
  require_finite(v, "rparam");
  const std::size_t n = v.size();
  double& curvature = p.given.wheel_rail.track.curvature;
  if (z == 0 && n <= 1) return;
  if (z == 1 && (n == 5 || n == 6)) {
    set_placement(p, v);
    curvature = n == 6 ? v[5] * p.units.curvature() : 0.0;
  } else if (z == 2 && n == 6) {
    set_deviation(p, v);
  } else if (z == 3 && (n == 11 || n == 12)) {
    set_placement(p, v);
    curvature = n == 12 ? v[5] * p.units.curvature() : 0.0;
    set_deviation(p, v.last(6));
  } else if ((z == 32 || z == 33) && (n == 4 || n == 5)) {
    RailSprings springs{v[0] * p.units.stiffness(), v[2] * p.units.stiffness(), v[1], v[3]};
    springs.first_step_y = n == 5 ? v[4] * p.units.length : 1e-3;
    p.given.rail_springs = springs;
  } else {
    refuse_track("Z (ZTRACK)", z, n);
  }
}

void set_dimensions(Problem& p, int e, Values v) {
  require_finite(v, "rparam");
  if ((e == 0 || e == 1 || e == 2 || e == 4) && v.size() <= 1) return;
  if ((e != 3 && e != 5) || (v.size() != 3 && v.size() != 4)) refuse_track("E (EWHEEL)", e, v.size());
  constexpr double kLeastRadius = 1e-6, kGreatestRadius = 1e17;  // [m]
  const double l = p.units.length, radius = v[2] * l;
  if (!(radius >= kLeastRadius && radius <= kGreatestRadius))
    throw Refusal{CNTC_err_input, fmt::format("the nominal radius {:.6g} m is out of range", radius)};
  WheelsetDimensions& w = p.given.wheel_rail.wheelset;
  w.flange_back_distance = v[0] * l;
  w.flange_back_position = v[1] * l;
  w.nominal_radius = radius;
  constexpr double kUnused = 0.999;  // [m]
  w.tape_line = v.size() == 4 && std::abs(v[3] * l) < kUnused ? std::optional(v[3] * l) : std::nullopt;
}

SixMotion six(Values v, double length) { return {v[0] * length, v[1] * length, v[2] * length, v[3], v[4], v[5]}; }

std::array<double, 6> numbers_of(const SixMotion& m, double length) {
  return {m.x / length, m.y / length, m.z / length, m.roll, m.yaw, m.pitch};
}

void set_position(Problem& p, int e, Values v) {
  require_finite(v, "rparam");
  if (e < 1 || e > 5 || v.size() != 6) refuse_track("E (EWHEEL)", e, v.size());
  p.given.wheel_rail.state.position = six(v, p.units.length);
}

void set_velocity(Problem& p, int e, Values v) {
  require_finite(v, "rparam");
  if (e < 1 || e > 5 || v.size() != 6) refuse_track("E (EWHEEL)", e, v.size());
  if (e == 1) log(Detail::calls, "E (EWHEEL) = 1 has no velocities, it is taken as 2");
  constexpr int kOnRoller = 4;
  io::ContactSequence& g = p.given;
  SixMotion m = six(v, p.units.velocity());
  if (p.flags[CNTC_ic_config] >= kOnRoller) {
    g.roller_pitch_rate = v[0];
    m.x = 0.0;
  } else {
    g.forward_velocity = m.x;
  }
  g.pitch_rate = m.pitch;
  g.wheel_rail.state.velocity = m;
}

void set_flexibility(Problem& p, int e, Values v) {
  require_finite(v, "rparam");
  WheelsetState& s = p.given.wheel_rail.state;
  if (e >= 0 && e <= 3 && v.size() <= 1) {
    s.wheel_offset = s.wheel_velocity = {};
    return;
  }
  if ((e != 4 && e != 5) || v.size() != 12) refuse_track("E (EWHEEL)", e, v.size());
  s.wheel_offset = six(v.first(6), p.units.length);
  s.wheel_velocity = six(v.last(6), p.units.velocity());
}

// Out of a case file into what is kept.

/// The digit of a theory.
template <class Id>
int digit_of(Id id) {
  return std::max(0, theory(id).digit.value);
}

void keep_material(Problem& p, const io::WheelRailCase& c) {
  const Material& m = c.material;
  MaterialInput& in = p.material;
  p.given.material = m;
  in = {};
  in.k0 = c.fastsim.k0, in.alpha = c.fastsim.alpha, in.beta = c.fastsim.beta;
  in.flexibility = c.fastsim.flexibility;
  p.material_digit = digit_of(c.tangential_model);
  if (m.layer_flexibility > 0.0) {  // only the ratio of thickness and modulus acts
    p.material_digit = 4;
    in.g3 = 1e9;
    in.thickness = m.layer_flexibility * in.g3;
    in.yield = m.layer_yield;
    in.hardening = m.layer_hardening;
  }
  if (m.creep_ratio_1 != 0.0 || m.creep_ratio_2 != 0.0) p.material_digit = 1;
  in.fg[0] = m.creep_ratio_1, in.fg[1] = m.creep_ratio_2;
  in.relaxation[0] = m.relaxation_time_1, in.relaxation[1] = m.relaxation_time_2;
  p.damped = c.damping.has_value();
  if (c.damping) in.damping = *c.damping;
  p.heat_digit = c.thermal ? 3 : 0;
  p.given.thermal = c.thermal;
}

void keep_friction(Problem& p, const io::WheelRailCase& c) {
  io::ContactSequence::Friction f;
  f.law = io::kLawDigits[static_cast<int>(c.friction.kind)];
  f.variation = static_cast<int>(c.friction_variation.kind);
  f.positions = c.friction_variation.positions;
  f.laws = f.variation == 0 ? std::vector{c.friction} : c.friction_variation.laws;
  p.friction_digit = f.law;
  p.given.friction = std::move(f);
}

/// All that a case says of the problem becomes what is kept.
void keep(Problem& p, const io::WheelRailCase& c) {
  Flags& f = p.flags;
  f.at(CNTC_ic_config) = (c.side == Side::right ? 1 : 0) + (c.roller ? 4 : 0);
  f.at(CNTC_ic_pvtime) = io::kHistoryDigits[static_cast<int>(c.history)];
  f.at(CNTC_ic_norm) = c.vertical_force_prescribed ? 1 : 0;
  f.at(CNTC_ic_force) = c.longitudinal_force ? 1 : c.rail_springs ? 3 : 0;
  f.at(CNTC_ic_tang) = digit_of(c.regime);
  f.at(CNTC_ic_bound) = digit_of(c.normal_model);
  f.at(CNTC_ic_discns) = io::discretisation_digit(c);
  f.at(CNTC_ic_inflcf) = std::max(2, digit_of(c.influence.kind));
  f.at(CNTC_ic_ifmeth) = c.influence.linear ? 0 : 1;
  f.at(CNTC_ic_ifvari) = c.influence.variant;
  f.at(CNTC_ic_npomax) = c.discretisation.max_elements;
  io::ContactSequence& g = p.given;
  g.wheel_rail = c;
  g.solver = c.solver;
  if (c.roller) {
    g.roller_radius = c.roller->nominal_radius;
    g.roller_pitch_rate = c.roller->pitch_rate;
  } else {
    g.forward_velocity = c.state.velocity.x;
  }
  g.pitch_rate = c.state.velocity.pitch;
  if (c.longitudinal_force) g.longitudinal_force = c.longitudinal_force;
  if (c.rail_springs) g.rail_springs = c.rail_springs;
  keep_material(p, c);
  keep_friction(p, c);
  p.blocks = c.subsurface.blocks;
}

void read_input(Problem& p, int type, const std::string& name) {
  if (type != CNTC_inp_modul1) throw Refusal{CNTC_err_input, fmt::format("input files of type {} are not read", type)};
  try {
    const io::CaseFile file = io::read_contact_input(io::resolve_name(folders().work, name));
    const auto* c = file.cases.empty() ? nullptr : std::get_if<io::WheelRailCase>(&file.cases.front().content);
    if (c == nullptr)
      throw Refusal{CNTC_err_input, "the first case of the file is none of a wheel on a rail (module 1)"};
    for (const std::string& note : file.notes) log(Detail::calls, note);
    give_profile(p, Body::rail, c->rail);
    give_profile(p, Body::wheel, c->wheel);
    keep(p, *c);
  } catch (const Error& error) {
    throw Refusal{CNTC_err_input, error.what()};
  }
}

}  // namespace
}  // namespace treadmark::contact

using namespace treadmark::contact;

void cntc_settrackdimensions(int* ire, int* ztrack, int* nparam, double* rparam) {
  on_problem("cntc_settrackdimensions", ire, nullptr, For::rail,
             [&](Active& a) { set_track(a.problem, need(ztrack, "ztrack"), array(rparam, nparam, "rparam")); });
}

void cntc_setwheelsetdimensions(int* ire, int* ewheel, int* nparam, double* rparam) {
  on_problem("cntc_setwheelsetdimensions", ire, nullptr, For::rail,
             [&](Active& a) { set_dimensions(a.problem, need(ewheel, "ewheel"), array(rparam, nparam, "rparam")); });
}

void cntc_setwheelsetposition(int* ire, int* ewheel, int* nparam, double* rparam) {
  on_problem("cntc_setwheelsetposition", ire, nullptr, For::rail,
             [&](Active& a) { set_position(a.problem, need(ewheel, "ewheel"), array(rparam, nparam, "rparam")); });
}

void cntc_setwheelsetvelocity(int* ire, int* ewheel, int* nparam, double* rparam) {
  on_problem("cntc_setwheelsetvelocity", ire, nullptr, For::rail,
             [&](Active& a) { set_velocity(a.problem, need(ewheel, "ewheel"), array(rparam, nparam, "rparam")); });
}

void cntc_setwheelsetflexibility(int* ire, int* ewheel, int* nparam, double* rparam) {
  on_problem("cntc_setwheelsetflexibility", ire, nullptr, For::rail,
             [&](Active& a) { set_flexibility(a.problem, need(ewheel, "ewheel"), array(rparam, nparam, "rparam")); });
}

void cntc_readinpfile(int* ire, int* inp_type, const char* fname, int* len_fname, int* ierror) {
  guarded("cntc_readinpfile", ierror, [&] {
    Active a = activate(ire, nullptr, For::rail);
    read_input(a.problem, need(inp_type, "inp_type"), text(fname, len_fname, "fname"));
    put(ierror, 0);
  });
}

void cntc_getwheelsetposition(int* ire, int* lenarr, double* values) {
  on_problem("cntc_getwheelsetposition", ire, nullptr, For::rail, [&](Active& a) {
    treadmark::SixMotion m = a.problem.given.wheel_rail.state.position;
    if (a.problem.solution) m.z = a.problem.solution->z;
    fill(room(values, lenarr, "values"), numbers_of(m, a.problem.units.length));
  });
}

void cntc_getwheelsetvelocity(int* ire, int* lenarr, double* values) {
  on_problem("cntc_getwheelsetvelocity", ire, nullptr, For::rail, [&](Active& a) {
    constexpr int kOnRoller = 4;
    treadmark::SixMotion m = a.problem.given.wheel_rail.state.velocity;
    if (a.problem.flags[CNTC_ic_config] >= kOnRoller) m.x = 0.0;
    if (a.problem.solution) m.pitch = a.problem.solution->pitch_rate;
    fill(room(values, lenarr, "values"), numbers_of(m, a.problem.units.velocity()));
  });
}
