// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/history_record.hpp"

namespace treadmark::app {
namespace {

using vehicle::ContactReaction;

const char* unit_of(const vehicle::Coordinate& c) { return static_cast<int>(c.freedom) < 3 ? "m" : "rad"; }

}  // namespace

HistoryRecord::HistoryRecord(const BuiltVehicle& built, const vehicle::Simulation& simulation)
    : simulation_(simulation) {
  const auto& wheels = simulation.vehicle().wheels;
  const std::size_t watched = built.watched_wheel();

  add("t_s", "s", "time", [&] { return simulation_.state().time; });
  add("x_m", "m", "distance travelled", [&] { return simulation_.state().time * simulation_.vehicle().speed; });
  add_wheel(watched, "", built.full[watched] != nullptr);
  for (std::size_t i = 0; i < wheels.size(); ++i)
    if (i != watched) add_wheel(i, wheels[i].name + '.', built.full[i] != nullptr);
  add_energies();
  add_bodies();
}

void HistoryRecord::add(std::string name, std::string unit, std::string description, std::function<double()> value) {
  columns_.push_back({{std::move(name), std::move(unit), std::move(description)}, std::move(value)});
}

void HistoryRecord::add_wheel(std::size_t wheel, const std::string& prefix, bool full) {
  const std::string of = prefix.empty() ? " (" + simulation_.vehicle().wheels[wheel].name + ")" : "";
  const auto reaction = [this, wheel]() -> const ContactReaction& { return simulation_.reactions()[wheel]; };
  add(prefix + "Q_N", "N", "vertical force on the rail" + of, [=] { return reaction().on_rail.force.z(); });
  add(prefix + "Ty_N", "N", "lateral creep force on the rail" + of, [=] { return reaction().lateral_creep_force; });
  add(prefix + "Tx_N", "N", "longitudinal creep force on the rail" + of,
      [=] { return reaction().longitudinal_creep_force; });
  add(prefix + "Y_N", "N", "lateral force on the rail" + of, [=] { return reaction().on_rail.force.y(); });
  if (!full) return;
  add(prefix + "Fn_N", "N", "normal force" + of, [=] { return reaction().normal_force; });
  add(prefix + "pmax_Pa", "Pa", "largest contact pressure" + of, [=] { return reaction().max_pressure; });
  add(prefix + "area_m2", "m2", "contact area" + of, [=] { return reaction().area; });
  add(prefix + "gap_m", "m", "least distance of the undeformed bodies, negative: penetration" + of,
      [=] { return reaction().least_gap; });
  add(prefix + "x_cp_m", "m", "contact reference ahead of the axle" + of, [=] { return reaction().contact_x; });
  add(prefix + "y_cp_m", "m", "contact reference in track axes" + of, [=] { return reaction().contact_y; });
  add(prefix + "patches", "1", "contact patches" + of, [=] { return static_cast<double>(reaction().patches); });
  add(prefix + "friction_W", "W", "power dissipated by friction" + of, [=] { return reaction().frictional_power; });
  const auto motion = [this, wheel] { return simulation_.vehicle().motion(wheel, simulation_.state()); };
  add(prefix + "pitch_rad", "rad", "pitch of the wheelset" + of, [=] { return motion().wheelset.pitch; });
  add(prefix + "rail_y_m", "m", "lateral displacement of the rail" + of, [=] { return motion().rail.y; });
  add(prefix + "rail_z_m", "m", "vertical displacement of the rail" + of, [=] { return motion().rail.z; });
  add(prefix + "rail_roll_rad", "rad", "roll of the rail" + of, [=] { return motion().rail.roll; });
}

void HistoryRecord::add_energies() {
  add("energy.mechanical_J", "J", "kinetic energy and potentials about the reference configuration",
      [&] { return simulation_.energy().mechanical; });
  add("energy.dampers_J", "J", "dissipated in dampers", [&] { return simulation_.energy().dampers; });
  add("energy.drive_J", "J", "work that keeps up the speed", [&] { return simulation_.energy().drive; });
  add("energy.friction_J", "J", "dissipated in the contacts", [&] { return simulation_.energy().friction; });
  add("energy.elastic_J", "J", "stored in the contacts", [&] { return simulation_.energy().elastic; });
  add("energy.integration_error_J", "J", "what the time integration gained",
      [&] { return simulation_.energy().integration_error(simulation_.energy_at_start()); });
  add("energy.contact_error_J", "J", "work on the contacts that they neither store nor dissipate",
      [&] { return simulation_.energy().contact_error(simulation_.energy_at_start()); });
}

void HistoryRecord::add_bodies() {
  const auto& coordinates = simulation_.vehicle().system.coordinates;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const vehicle::Coordinate& c = coordinates[i];
    if (c.body < 0) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const std::string unit = unit_of(c);
    add(c.name + '_' + unit, unit, "displacement from the reference configuration",
        [this, at] { return simulation_.state().q[at]; });
    add(c.name + "_rate_" + unit + "_s", unit + "/s", "its rate", [this, at] { return simulation_.state().v[at]; });
  }
}

std::vector<io::HistoryColumn> HistoryRecord::columns() const {
  std::vector<io::HistoryColumn> heads;
  for (const Column& column : columns_) heads.push_back(column.head);
  return heads;
}

void HistoryRecord::append(std::vector<double>& values) const {
  for (const Column& column : columns_) values.push_back(column.value());
}

}  // namespace treadmark::app
