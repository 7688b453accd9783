// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/log.hpp"
#include "treadmark/model/contact/material.hpp"

namespace treadmark::contact {
namespace {

using Values = std::span<const double>;

void require_count(Values values, std::size_t count, const char* what, int digit) {
  if (values.size() != count)
    throw Refusal{CNTC_err_input,
                  fmt::format("{} = {} needs {} values, {} were given", what, digit, count, values.size())};
}

/// Solving normal and tangential problem in turns is needed for dissimilar bodies only.
void follow_material(Problem& p) {
  constexpr double kSimilar = 1e-4;
  constexpr int kTurns = 10;
  const bool similar = std::abs(combine(p.given.material).difference) < kSimilar;
  int& rounds = p.given.solver.max_coupling;
  rounds = similar ? 1 : rounds == 1 ? kTurns : rounds;
}

void set_elastic(Problem& p, double nu1, double nu2, double g1, double g2) {
  Material& m = p.given.material;
  m.poisson_1 = nu1;
  m.poisson_2 = nu2;
  m.shear_modulus_1 = g1 * p.units.stress();
  m.shear_modulus_2 = g2 * p.units.stress();
  follow_material(p);
}

constexpr double kLeast = 1e-6;

void set_slope(Problem& p, Values v) {
  p.material.k0 = std::max(v[0], kLeast);
  p.material.alpha = std::max(v[1], kLeast);
  p.material.beta = std::max(v[2], kLeast);
}

void set_layer(Problem& p, Values v) {
  constexpr double kSoftest = 1.0, kThinnest = 1e-12, kNeverYields = 1e16;  // [Pa], [m], [Pa]
  MaterialInput& m = p.material;
  m.g3 = std::max(v[0] * p.units.stress(), kSoftest);
  m.thickness = std::max(v[1] * p.units.length, kThinnest);
  m.yield = v[2] * p.units.stress();
  if (m.yield >= kNeverYields) m.yield = 0.0;
  m.hardening = v[3] * p.units.hardening();
}

/// The numbers that a theory has beside the elastic constants.
void set_theory(Problem& p, int digit, Values v) {
  switch (digit) {
    case 1:
      for (std::size_t body = 0; body < 2; ++body) {
        p.material.fg[body] = v[body];
        p.material.relaxation[body] = v[2 + body];
      }
      break;
    case 2:
      p.material.flexibility = v[0] * p.units.compliance();
      set_slope(p, v.subspan(1));
      break;
    case 3:
    case 5:
      set_slope(p, v);
      break;
    case 4:
      set_layer(p, v);
      break;
    default:
      break;
  }
  p.material_digit = digit;
}

void set_damping(Problem& p, int digit, Values v) {
  if (digit > 12) throw Refusal{CNTC_err_input, fmt::format("there is no M2 = {}", digit - 10)};
  if (digit == 12) {
    require_count(v, 4, "M2", 2);
    p.material.damping = {v[0], v[1], v[2], v[3]};
  }
  p.damped = digit != 10;
}

void set_material(Problem& p, int digit, Values v) {
  constexpr std::size_t kFurther[] = {0, 4, 4, 3, 4, 3, 0, 0};
  require_finite(v, "rparam");
  if (digit >= 10) return set_damping(p, digit, v);
  if (digit < 0 || digit > 7) throw Refusal{CNTC_err_input, fmt::format("there is no M (MATER) = {}", digit)};
  require_count(v, 4 + kFurther[digit], "M (MATER)", digit);
  set_elastic(p, v[0], v[1], v[2], v[3]);
  set_theory(p, digit, v.subspan(4));
}

void set_old_layer(Problem& p, int digit, Values v) {
  constexpr std::size_t kCounts[] = {0, 0, 4, 3, 4};
  require_finite(v, "params");
  if (digit != 0 && (digit < 2 || digit > 4)) throw Refusal{CNTC_err_input, fmt::format("there is no layer {}", digit)};
  if (digit != 0 || v.size() > 1) require_count(v, kCounts[digit], "M (MATER)", digit);
  set_theory(p, digit, v);
}

void set_heat(Problem& p, int digit, Values v) {
  if (digit == 1) return;
  if (digit != 0 && digit != 3) throw Refusal{CNTC_err_input, fmt::format("there is no H (HEAT) = {}", digit)};
  p.heat_digit = digit;
  if (digit == 0) return;
  require_count(v, 9, "H (HEAT)", digit);
  require_finite(v, "rparam");
  Thermal heat;
  heat.conventions = Conventions::contact;
  for (ThermalProperties* body : {&heat.body_1, &heat.body_2}) {
    *body = {v[0], v[1], v[2] * p.units.conductivity(), v[3] * p.units.density()};
    v = v.subspan(4);
  }
  heat.plastic_fraction = v[0];
  p.given.thermal = heat;
}

/// One set of numbers of a friction law.
FrictionLaw friction_law(int law, Values v, const Units& units) {
  constexpr double kSlowest = 1e-7;  // [m/s]
  FrictionLaw f;
  using Kind = FrictionLaw::Kind;
  if (law == 0) {
    f.kinetic = std::max(std::min(v[0], v[1]), kLeast);
  } else if (law <= 4) {
    f.kind = law == 2 ? Kind::linear : law == 3 ? Kind::rational : Kind::exponential;
    f.kinetic = std::max(v[0], kLeast);
    f.amplitude_1 = std::max(v[1], 0.0);
    f.half_velocity_1 = std::max(v[2] * units.velocity(), kSlowest);
    f.amplitude_2 = std::max(v[3], 0.0);
    f.half_velocity_2 = std::max(v[4] * units.velocity(), kSlowest);
  } else if (law == 5) {
    constexpr double kUnusedVelocity = 10.0;
    f.kind = Kind::exponential;
    f.kinetic = std::clamp(v[1], 0.0, 1.0) * v[0];
    f.amplitude_1 = v[0] - f.kinetic;
    f.half_velocity_1 = std::max(std::numbers::ln2 / v[2] * units.velocity(), kSlowest);
    f.half_velocity_2 = kUnusedVelocity;
  } else {
    f.kind = Kind::temperature;
    f.kinetic = v[0];
    f.reference_temperature = v[1];
    f.temperature_change = std::max(v[2], kLeast - v[0]);
    f.temperature_range = v[3];
  }
  return f;
}

void set_friction(Problem& p, int method, Values v) {
  constexpr int kKeep = 1, kMostSets = 10000;
  const int law = method % 10, variation = method / 10;
  if (law == kKeep) return;
  if (method < 0 || law > 6 || variation > 2)
    throw Refusal{CNTC_err_frclaw, fmt::format("there is no friction method {}", method)};
  if (variation != 0 && p.module == 3)
    throw Refusal{CNTC_err_frclaw, fmt::format("V = {} is for a wheel on a rail (module 1)", variation)};
  require_finite(v, "params");
  constexpr std::size_t kCounts[] = {2, 0, 7, 7, 7, 3, 6};
  const std::size_t count = kCounts[law];
  std::size_t sets = 1;
  if (variation != 0) {
    const double given = v.empty() ? 0.0 : std::round(v[0]);
    if (!(given >= 1.0 && given <= kMostSets)) throw Refusal{CNTC_err_frclaw, "the number of friction sets is wrong"};
    sets = to_whole<std::size_t>(given);
    require_count(v, 1 + sets * (count + 1), "the friction method", method);
    v = v.subspan(1);
  } else {
    require_count(v, count, "the friction method", method);
  }
  io::ContactSequence::Friction f;
  f.law = law == 5 ? 4 : law;
  f.variation = variation;
  f.laws.clear();
  for (std::size_t i = 0; i < sets; ++i) {
    if (variation != 0) {
      f.positions.push_back(v[0] * (variation == 2 ? p.units.length : 1.0));
      v = v.subspan(1);
    }
    f.laws.push_back(friction_law(law, v, p.units));
    if (law >= 2 && law != 5)  // common to all sets
      for (FrictionLaw& one : f.laws) {
        one.memory_distance = v[count - 2] * p.units.length;
        one.memory_velocity = v[count - 1] * p.units.velocity();
      }
    v = v.subspan(count);
  }
  p.friction_digit = f.law;
  p.given.friction = std::move(f);
}

}  // namespace
}  // namespace treadmark::contact

using namespace treadmark::contact;

void cntc_setmaterialparameters(int* ire, int* icp, int* mdigit, int* nparam, double* rparam) {
  on_problem("cntc_setmaterialparameters", ire, icp, For::whole,
             [&](Active& a) { set_material(a.problem, need(mdigit, "mdigit"), array(rparam, nparam, "rparam")); });
}

void cntc_setmaterialproperties(int* ire, int* icp, double* g1, double* nu1, double* g2, double* nu2) {
  on_problem("cntc_setmaterialproperties", ire, icp, For::whole, [&](Active& a) {
    set_elastic(a.problem, number(nu1, "nu1"), number(nu2, "nu2"), number(g1, "g1"), number(g2, "g2"));
  });
}

void cntc_setinterfaciallayer(int* ire, int* icp, int* imeth, int* nparam, double* params) {
  on_problem("cntc_setinterfaciallayer", ire, icp, For::whole,
             [&](Active& a) { set_old_layer(a.problem, need(imeth, "imeth"), array(params, nparam, "params")); });
}

void cntc_settemperaturedata(int* ire, int* icp, int* imeth, int* nparam, double* rparam) {
  on_problem("cntc_settemperaturedata", ire, icp, For::any,
             [&](Active& a) { set_heat(a.problem, need(imeth, "imeth"), array(rparam, nparam, "rparam")); });
}

void cntc_setfrictionmethod(int* ire, int* icp, int* imeth, int* nparam, double* params) {
  on_problem("cntc_setfrictionmethod", ire, icp, For::whole,
             [&](Active& a) { set_friction(a.problem, need(imeth, "imeth"), array(params, nparam, "params")); });
}
