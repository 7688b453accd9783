// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <set>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/table_of.hpp"
#include "treadmark/io/simulations/vehicle_keys.hpp"

namespace treadmark::io {
namespace {

/// As many numbers of a list as there are places or wheels.
void check_count(const TableOf<AxleMode>& table, std::vector<double> AxleMode::*list, const AxleMode& mode,
                 std::size_t count, std::string_view what) {
  if ((mode.*list).size() != count)
    table.refuse(list,
                 fmt::format("{} has {} values for {} {}", table.path_of(list), (mode.*list).size(), count, what));
}

double angular(const AxleMode& mode) { return 2.0 * kPi * mode.frequency; }
double stiffness_of(const AxleMode& mode) { return mode.mass * angular(mode) * angular(mode); }
double damping_of(const AxleMode& mode) { return 2.0 * mode.damping_ratio * mode.mass * angular(mode); }

FlexibleAxle read_axle(const CaseValue& value) {
  const std::string name = part_name(TableOf(value, "axles", axle_keys()));
  const TableOf table(value, "axles." + name, axle_keys());
  FlexibleAxle axle = table.read();
  axle.where = table.where();
  for (const CaseValue* one : table.tables(&FlexibleAxle::bending)) {
    table.need(&FlexibleAxle::places);
    const TableOf part(*one, table.path_of(&FlexibleAxle::bending), bending_keys());
    const AxleMode mode = part.read();
    for (auto list : {&AxleMode::shape, &AxleMode::slope}) check_count(part, list, mode, axle.places.size(), "places");
    axle.bending.push_back({mode.mass, stiffness_of(mode), damping_of(mode), mode.shape, mode.slope, part.where()});
  }
  for (const CaseValue* one : table.tables(&FlexibleAxle::torsion)) {
    const TableOf part(*one, table.path_of(&FlexibleAxle::torsion), torsion_keys());
    const AxleMode mode = part.read();
    check_count(part, &AxleMode::rotation, mode, 2, "wheels");
    axle.torsion.push_back(
        {mode.mass, stiffness_of(mode), damping_of(mode), {mode.rotation[0], mode.rotation[1]}, part.where()});
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
