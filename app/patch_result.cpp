// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/patch_result.hpp"

#include <memory>

#include "treadmark/io/cases/read_influence.hpp"

namespace treadmark::app {

InfluenceSettings to_influence(const io::InfluenceInput& input) {
  InfluenceSettings out = input;
  if (input.kind == InfluenceSettings::Kind::table)
    out.table = std::make_shared<const NumericalInfluence>(io::read_influence(input.file));
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
