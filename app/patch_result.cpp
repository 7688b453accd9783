// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/patch_result.hpp"

#include <memory>

#include "treadmark/io/cases/read_influence.hpp"

namespace treadmark::app {

kalker::SolverSettings to_solver_settings(const io::SolverInput& input) {
  kalker::SolverSettings s;
  s.eps = input.eps;
  s.max_iterations = input.max_gs;
  s.max_outer = input.max_in;
  s.max_force = input.max_nr;
  s.max_coupling = input.max_out;
  if (input.method == io::SolverInput::Method::sweeps) s.method = kalker::SolverSettings::Method::sweeps;
  using From = io::SolverInput::FirstSlip;
  using To = kalker::SolverSettings::FirstSlip;
  s.first_slip = input.first_slip == From::below ? To::below : input.first_slip == From::above ? To::above : To::last;
  return s;
}

kalker::NormalModel to_normal_model(io::NormalModelInput model) {
  using From = io::NormalModelInput;
  using To = kalker::NormalModel;
  switch (model) {
    case From::full:
      return To::full;
    case From::elliptic:
      return To::elliptic;
    case From::parabolic:
      return To::parabolic;
    case From::semi_double_elliptic:
      return To::semi_double_elliptic;
    case From::kpec:
      return To::kpec;
    case From::analyn:
      return To::analyn;
  }
  return To::full;
}

kalker::TangentialModel to_tangential_model(io::TangentialModelInput model) {
  using From = io::TangentialModelInput;
  using To = kalker::TangentialModel;
  switch (model) {
    case From::full:
      return To::full;
    case From::fastsim:
      return To::fastsim;
    case From::fastsim_one_flexibility:
      return To::fastsim_one_flexibility;
    case From::fastrip:
      return To::fastrip;
  }
  return To::full;
}

kalker::Regime to_regime(io::RegimeInput input) {
  switch (input) {
    case io::RegimeInput::none:
      return kalker::Regime::frictionless;
    case io::RegimeInput::shift:
      return kalker::Regime::shift;
    case io::RegimeInput::transient:
      return kalker::Regime::transient;
    case io::RegimeInput::steady:
      return kalker::Regime::steady;
  }
  return kalker::Regime::frictionless;
}

kalker::HistoryUse to_history(io::HistoryInput input) {
  switch (input) {
    case io::HistoryInput::start:
      return kalker::HistoryUse::start;
    case io::HistoryInput::keep_going:
      return kalker::HistoryUse::keep_going;
    case io::HistoryInput::normal_only:
      return kalker::HistoryUse::normal_only;
    case io::HistoryInput::same_instant:
      return kalker::HistoryUse::same_instant;
  }
  return kalker::HistoryUse::start;
}

kalker::InfluenceSettings to_influence(const io::InfluenceInput& input) {
  kalker::InfluenceSettings out;
  using From = io::InfluenceInput::Kind;
  using To = kalker::InfluenceSettings::Kind;
  out.kind = input.kind == From::bilinear          ? To::bilinear
             : input.kind == From::angle_corrected ? To::angle_corrected
             : input.kind == From::table           ? To::table
                                                   : To::constant;
  out.position = input.position;
  out.inclination = input.inclination;
  out.variant = input.variant;
  out.linear = input.linear;
  if (input.kind == From::table) out.table = std::make_shared<const NumericalInfluence>(io::read_influence(input.file));
  return out;
}

io::PatchResult patch_result(const kalker::ContactSolution& c, const Grid2& grid, const std::vector<double>& gap,
                             const Material& material, const FrictionLaw& friction) {
  io::PatchResult r;
  r.fn = c.force_n;
  r.fx = c.force_x;
  r.fs = c.force_y;
  r.mn = c.moment_n;
  const double bound = friction.static_friction() * c.force_n;
  if (bound > 0.0) {
    r.fx_relative = c.force_x / bound;
    r.fs_relative = c.force_y / bound;
  }
  r.shear_modulus = combine(material).shear_modulus;
  r.elastic_energy = c.elastic_energy;
  r.frictional_power = c.frictional_power;
  r.approach = c.approach;
  r.pmax = c.max_pressure;
  r.npot = static_cast<int>(grid.size());
  r.ncon = c.elements_contact;
  r.nadh = c.elements_adhesion;
  r.nslip = c.elements_slip;

  io::PatchFields& f = r.fields;
  f.grid = grid;
  f.gap = gap;
  f.pressure = c.pressure;
  f.traction_x = c.traction_x;
  f.traction_s = c.traction_y;
  f.displacement_n = c.displacement_n;
  f.displacement_x = c.displacement_x;
  f.displacement_s = c.displacement_y;
  f.slip_x = c.slip_x;
  f.slip_s = c.slip_y;
  f.friction = c.friction;
  f.plastic_x = c.plastic_x;
  f.plastic_s = c.plastic_y;
  f.yield_stress = c.yield_stress;
  f.temperature_1 = c.temperature_1;
  f.temperature_2 = c.temperature_2;
  if (!c.temperature_1.empty()) {
    r.max_temperature_1 = c.max_temperature_1;
    r.max_temperature_2 = c.max_temperature_2;
  }
  if (c.sensitivities) r.sensitivities = {c.sensitivities->by_creepage, c.sensitivities->by_approach};
  f.state.reserve(c.state.size());
  for (const kalker::ElementState state : c.state) f.state.push_back(static_cast<std::uint8_t>(state));
  return r;
}

}  // namespace treadmark::app
