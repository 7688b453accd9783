// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <set>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {
namespace {

struct Oscillator {
  double mass, stiffness, damping;
};

Oscillator read_oscillator(const TableReader& table, std::string_view mass_key) {
  const double mass = table.number(mass_key), omega = 2.0 * kPi * table.number("frequency_Hz");
  return {mass, mass * omega * omega, 2.0 * table.number_or("damping_ratio", 0.0) * mass * omega};
}

std::vector<double> needed_numbers(const TableReader& table, std::string_view key, std::size_t count,
                                   std::string_view what) {
  const SourcePosition& where = table.need(key).where;
  std::vector<double> values = table.numbers(key);
  if (values.size() != count)
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} values for {} {}", table.path_of(key), values.size(), count, what), where);
  return values;
}

FlexibleAxle read_axle(const CaseValue& value) {
  const std::string name = part_name(TableReader(value.table(), value.where, "axles", axle_keys()));
  const TableReader table(value.table(), value.where, "axles." + name, axle_keys());
  FlexibleAxle axle;
  axle.name = name;
  axle.where = table.where();
  axle.wheel_distance = table.number("wheel_distance_mm");
  axle.wheel_polar_inertia = table.number("wheel_polar_inertia_kg_m2");
  axle.places = table.numbers("places_mm");
  for (const CaseValue* one : table.tables("bending")) {
    table.need("places_mm", "shapes need the places at which they are given");
    const TableReader mode(one->table(), one->where, table.path_of("bending"), bending_keys());
    const auto [mass, stiffness, damping] = read_oscillator(mode, "modal_mass_kg");
    axle.bending.push_back({mass, stiffness, damping, needed_numbers(mode, "shape", axle.places.size(), "places"),
                            needed_numbers(mode, "slope_per_m", axle.places.size(), "places"), mode.where()});
  }
  for (const CaseValue* one : table.tables("torsion")) {
    const TableReader mode(one->table(), one->where, table.path_of("torsion"), torsion_keys());
    const auto [inertia, stiffness, damping] = read_oscillator(mode, "modal_inertia_kg_m2");
    const std::vector<double> rotation = needed_numbers(mode, "wheel_rotation", 2, "wheels");
    axle.torsion.push_back({inertia, stiffness, damping, {rotation[0], rotation[1]}, mode.where()});
  }
  check_axle(axle);
  return axle;
}

}  // namespace

std::vector<FlexibleAxle> read_axles(const TableReader& document) {
  std::vector<FlexibleAxle> axles;
  std::set<std::string> seen;
  for (const CaseValue* one : document.tables("axles")) {
    axles.push_back(read_axle(*one));
    if (!seen.insert(axles.back().name).second)
      throw Error(ErrorKind::configuration, fmt::format("there are two axles named '{}'", axles.back().name),
                  one->where);
  }
  return axles;
}

}  // namespace treadmark::io
