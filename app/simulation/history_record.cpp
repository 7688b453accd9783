// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/simulation/history_record.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/histories/channels.hpp"

namespace treadmark::app {

namespace {

using vehicle::ContactReaction;

using Motion = vehicle::PairMotion;
constexpr MotionColumn kMotion[] = {
    {"pitch_rad", "rad", "pitch of the wheelset", [](Motion& m) -> double& { return m.wheelset.pitch; }},
    {"rail_y_m", "m", "lateral displacement of the rail", [](Motion& m) -> double& { return m.rail.y; }},
    {"rail_z_m", "m", "vertical displacement of the rail", [](Motion& m) -> double& { return m.rail.z; }},
    {"rail_roll_rad", "rad", "roll of the rail", [](Motion& m) -> double& { return m.rail.roll; }},
    {"rail_vy_m_s", "m/s", "lateral velocity of the rail", [](Motion& m) -> double& { return m.rail.vy; }},
    {"rail_vz_m_s", "m/s", "vertical velocity of the rail", [](Motion& m) -> double& { return m.rail.vz; }},
    {"rail_vroll_rad_s", "rad/s", "roll rate of the rail", [](Motion& m) -> double& { return m.rail.vroll; }},
    {"wheelset_x_m", "m", "place of the wheelset along the track", [](Motion& m) -> double& { return m.wheelset.x; }},
    {"wheelset_y_m", "m", "lateral place of the wheelset", [](Motion& m) -> double& { return m.wheelset.y; }},
    {"wheelset_z_m", "m", "height of the wheelset, positive down", [](Motion& m) -> double& { return m.wheelset.z; }},
    {"wheelset_roll_rad", "rad", "roll of the wheelset", [](Motion& m) -> double& { return m.wheelset.roll; }},
    {"wheelset_yaw_rad", "rad", "yaw of the wheelset", [](Motion& m) -> double& { return m.wheelset.yaw; }},
    {"wheelset_vx_m_s", "m/s", "forward velocity of the wheelset",
     [](Motion& m) -> double& { return m.wheelset_velocity.x; }},
    {"wheelset_vy_m_s", "m/s", "lateral velocity of the wheelset",
     [](Motion& m) -> double& { return m.wheelset_velocity.y; }},
    {"wheelset_vz_m_s", "m/s", "vertical velocity of the wheelset",
     [](Motion& m) -> double& { return m.wheelset_velocity.z; }},
    {"wheelset_vroll_rad_s", "rad/s", "roll rate of the wheelset",
     [](Motion& m) -> double& { return m.wheelset_velocity.roll; }},
    {"wheelset_vyaw_rad_s", "rad/s", "yaw rate of the wheelset",
     [](Motion& m) -> double& { return m.wheelset_velocity.yaw; }},
    {"wheelset_vpitch_rad_s", "rad/s", "pitch rate of the wheelset",
     [](Motion& m) -> double& { return m.wheelset_velocity.pitch; }},
};

const char* unit_of(const vehicle::Coordinate& c) { return static_cast<int>(c.freedom) < 3 ? "m" : "rad"; }

/// Nothing is added to a rail that does not bend, not even a sign of zero.
void add_bending(const ContactReaction& reaction, Motion& m) {
  using Rail = vehicle::RailMotion;
  for (double Rail::*part : {&Rail::y, &Rail::z, &Rail::roll, &Rail::vy, &Rail::vz, &Rail::vroll})
    if (reaction.bending.*part != 0.0) m.rail.*part += reaction.bending.*part;
}

}  // namespace

std::span<const MotionColumn> motion_columns() { return kMotion; }

namespace {

/// The first wheel with full contact, else the first one: what summaries and pictures are about.
std::size_t watched_wheel(const io::SimulationFile& file) {
  const auto first = ranges::find(file.wheels, io::ContactModelInput::full, &io::WheelContactInput::model);
  return first == file.wheels.end() ? 0u : static_cast<std::size_t>(first - file.wheels.begin());
}

bool is_full(const io::SimulationFile& file, std::size_t wheel) {
  return file.wheels.at(wheel).model != io::ContactModelInput::table;
}

std::vector<std::size_t> chosen_wheels(const io::SimulationFile& file) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < file.wheels.size(); ++i)
    if (file.wheels[i].model == io::ContactModelInput::automatic) out.push_back(i);
  return out;
}

}  // namespace

std::string column_prefix(const io::SimulationFile& file, std::size_t wheel) {
  return wheel == watched_wheel(file) ? "" : wheel_name(file.wheels.at(wheel)) + '.';
}

HistoryRecord::HistoryRecord(const io::SimulationFile& file, const vehicle::Simulation& simulation)
    : HistoryRecord(file, simulation.vehicle(), &simulation) {}

HistoryRecord::HistoryRecord(const io::SimulationFile& file, const vehicle::VehicleOnTrack& vehicle,
                             const vehicle::Simulation* simulation)
    : vehicle_(vehicle),
      simulation_(simulation),
      wheel_y_(0.5 * file.contact.wheelset.flange_back_distance - file.contact.wheelset.flange_back_position) {
  const auto& wheels = vehicle.wheels;
  const std::size_t watched = watched_wheel(file);

  add("t_s", "s", "time", [&] { return simulation_->state().time; });
  add("x_m", "m", "distance travelled", [&] { return vehicle_.travel(simulation_->state().time).distance; });
  add_wheel(watched, "", is_full(file, watched));
  for (std::size_t i = 0; i < wheels.size(); ++i)
    if (i != watched) add_wheel(i, wheels[i].name + '.', is_full(file, i));
  for (std::size_t i = 0; !file.check_rails.empty() && i < wheels.size(); ++i)
    add((i == watched ? "" : wheels[i].name + '.') + "check_N", "N",
        "of a check rail on the flange of " + wheels[i].name,
        [this, i] { return simulation_->reactions()[i].check_force; });
  for (const std::size_t i : chosen_wheels(file)) add_choice(i, i == watched ? "" : wheels[i].name + '.');
  add_energies();
  add_bodies();
  add_elements();
  if (vehicle.line) add_line(file.irregularities.has_value());
  add_running(watched);
  add_accelerations(file.history);
  keep_only(file.history);  // the last
  const vehicle::SimulationSettings steps = integration_settings(file);
  check_assessable(file, columns(), steps.max_step, steps.max_travel);
}

std::vector<io::HistoryColumn> HistoryRecord::columns_of(const io::SimulationFile& file,
                                                         const vehicle::VehicleOnTrack& vehicle) {
  return HistoryRecord(file, vehicle, nullptr).columns();
}

void HistoryRecord::add_line(bool irregular) {
  const auto now = [this] { return simulation_->state().time; };
  const auto line = vehicle_.line;
  add("line.speed_m_s", "m/s", "speed of the vehicle", [=] { return line->travel(now()).speed; });
  if (line->setup().free_run || vehicle_.system.free_along)
    add("line.mean_speed_m_s", "m/s", "mean speed of all masses",
        [this] { return vehicle_.mean_speed(simulation_->state()); });
  if (line->setup().free_run)
    add("line.gradient", "1", "rise over length at the vehicle's x = 0",
        [=] { return gradient_at(*line->setup().free_run, line->point(now()).distance); });
  if (line->setup().path) {
    add("line.place_m", "m", "place of the vehicle's x = 0 on the line", [=] { return line->point(now()).distance; });
    add("line.curvature_1_m", "1/m", "of the line there, positive to the right",
        [=] { return line->point(now()).curvature.value; });
    add("line.cant_m", "m", "of the line there, positive where the left rail lies higher",
        [=] { return line->point(now()).cant.value; });
  }
  if (irregular)
    for (const vehicle::WheelOnRail& wheel : vehicle_.wheels) {
      const auto rail = [=, set = static_cast<std::size_t>(wheel.wheelset), side = wheel.side] {
        return line->wheel(set, side, now()).rail;
      };
      add("line." + wheel.name + ".rail_y_m", "m", "how far to the right of its place the line has its rail there",
          [=] { return rail().y; });
      add("line." + wheel.name + ".rail_z_m", "m", "how far below its place", [=] { return rail().z; });
    }
  add("energy.line_J", "J", "work of the line and of torques on the vehicle",
      [&] { return simulation_->energy().line; });
}

void HistoryRecord::add(std::string name, std::string unit, std::string description, std::function<double()> value) {
  columns_.push_back({{std::move(name), std::move(unit), std::move(description)}, std::move(value)});
}

void HistoryRecord::add_wheel(std::size_t wheel, const std::string& prefix, bool full) {
  const std::string of = prefix.empty() ? " (" + vehicle_.wheels[wheel].name + ")" : "";
  const auto reaction = [this, wheel]() -> const ContactReaction& { return simulation_->reactions()[wheel]; };
  add(prefix + "Q_N", "N", "vertical force on the rail" + of, [=] { return reaction().on_rail.force.z(); });
  add(prefix + "Ty_N", "N", "lateral creep force on the rail" + of, [=] { return reaction().lateral_creep_force; });
  add(prefix + "Tx_N", "N", "longitudinal creep force on the rail" + of,
      [=] { return reaction().longitudinal_creep_force; });
  add(prefix + "Y_N", "N", "lateral force on the rail" + of, [=] { return reaction().on_rail.force.y(); });
  add(prefix + "angle_rad", "rad", "contact angle, of all normal forces together, 0 without contact" + of, [=] {
    Vec3 normal = Vec3::Zero();
    for (const vehicle::PatchTangent& t : reaction().tangents) normal += t.normal_force * t.X_TC.rotation.col(2);
    return std::atan2(0.0 - normal.y(), normal.z());  // no -0
  });
  const auto motion = [this, wheel] { return vehicle_.motion(wheel, simulation_->state()); };
  add(prefix + "lift_m", "m", "how far the tape circle stands above its height at rest over the rail" + of, [=, this] {
    Motion m = motion();
    add_bending(reaction(), m);
    const double y = vehicle_.wheels[wheel].side == wheelrail::Side::left ? -wheel_y_ : wheel_y_;
    return m.rail.z - m.wheelset.z - y * m.wheelset.roll;
  });
  if (!full) return;
  add(prefix + "Fn_N", "N", "normal force" + of, [=] { return reaction().normal_force; });
  add(prefix + "pmax_Pa", "Pa", "largest contact pressure" + of, [=] { return reaction().max_pressure; });
  add(prefix + "area_m2", "m2", "contact area" + of, [=] { return reaction().area; });
  add(prefix + "gap_m", "m", "least distance of the undeformed bodies, negative: penetration" + of,
      [=] { return reaction().least_gap; });
  add(prefix + "x_cp_m", "m", "contact reference ahead of the axle" + of, [=] { return reaction().contact_x; });
  add(prefix + "y_cp_m", "m", "contact reference in track axes" + of, [=] { return reaction().contact_y; });
  add(prefix + "patches", "1", "contact patches" + of, [=] { return static_cast<double>(reaction().patches); });
  add(prefix + "doubts", "1", "warnings about the contact (docs/results.md)" + of,
      [=] { return static_cast<double>(reaction().doubts); });
  add(prefix + "friction_W", "W", "power dissipated by friction" + of,
      [=] { return reaction().frictional_power - reaction().rail_power; });
  for (const MotionColumn& column : kMotion)
    add(prefix + column.name, column.unit, column.description + of, [motion, reaction, place = column.place] {
      Motion m = motion();
      add_bending(reaction(), m);
      return place(m);
    });
}

void HistoryRecord::add_choice(std::size_t wheel, const std::string& prefix) {
  const auto reaction = [this, wheel]() -> const ContactReaction& { return simulation_->reactions()[wheel]; };
  const std::string of = " of " + vehicle_.wheels[wheel].name;
  add(prefix + "full_share", "1", "of the contact in full in the forces" + of + ", the rest from a table",
      [=] { return reaction().full_share; });
  add(prefix + "table_error", "1", "what forces of the table" + of + " are wrong by, over the normal force",
      [=] { return reaction().table_error; });
  add(prefix + "table_wear_error", "1", "what the wear number of the table" + of + " is wrong by, over it",
      [=] { return reaction().table_wear_error; });
}

void HistoryRecord::add_energies() {
  add("energy.mechanical_J", "J", "kinetic energy and potentials about the reference configuration",
      [&] { return simulation_->energy().mechanical; });
  add("energy.dampers_J", "J", "dissipated in dampers and by dry friction of the vehicle",
      [&] { return simulation_->energy().dampers; });
  add("energy.drive_J", "J", "work that keeps up the speed", [&] { return simulation_->energy().drive; });
  add("energy.friction_J", "J", "dissipated in the contacts", [&] { return simulation_->energy().friction; });
  add("energy.elastic_J", "J", "stored in the contacts", [&] { return simulation_->energy().elastic; });
  add("energy.integration_error_J", "J", "what the time integration gained",
      [&] { return simulation_->energy().integration_error(simulation_->energy_at_start()); });
  add("energy.contact_error_J", "J", "work on the contacts that they neither store nor dissipate",
      [&] { return simulation_->energy().contact_error(simulation_->energy_at_start()); });
}

void HistoryRecord::add_bodies() {
  const auto& coordinates = vehicle_.system.coordinates;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const vehicle::Coordinate& c = coordinates[i];
    if (c.body < 0) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const std::string unit = unit_of(c);
    add(c.name + '_' + unit, unit, "displacement from the reference configuration",
        [this, at] { return simulation_->state().q[at]; });
    add(c.name + "_rate_" + unit + "_s", unit + "/s", "its rate", [this, at] { return simulation_->state().v[at]; });
  }
}

/// Forces of dry friction and dampers, against the displacement of the second body.
void HistoryRecord::add_elements() {
  constexpr const char* kWords[] = {"x", "y", "z", "roll", "pitch", "yaw"};
  const vehicle::ForceElements& elements = vehicle_.system.elements;
  const auto force = [this](int column) { return [this, column] { return simulation_->element_force()[column]; }; };
  for (const vehicle::Coupler& c : elements.couplers) {
    add(fmt::format("coupler.{}.force_N", c.name), "N", "force of the coupler, positive in pull", [this, &c] {
      const vehicle::Vector& all = simulation_->element_force();
      return all[c.column] + (c.friction < 0 ? 0.0 : all[c.friction]);
    });
    add(fmt::format("coupler.{}.stretch_m", c.name), "m", "by which it is longer than in the middle of its free play",
        [this, &c] { return simulation_->element_stretch(c.column); });
  }
  const auto in_coupler = [&](const vehicle::DryFriction& f) {
    return ranges::find(elements.couplers, f.first, &vehicle::Coupler::friction) != elements.couplers.end();
  };
  for (const vehicle::DryFriction& f : elements.frictions)
    for (int d = 0; d < f.directions && !in_coupler(f); ++d) {
      const int column = f.first + d;
      const std::string name =
          fmt::format("friction.{}.{}", f.name,
                      kWords[static_cast<int>(elements.columns[static_cast<std::size_t>(column)].freedom)]);
      add(name + "_N", "N", "dry friction, against the displacement; of a rotation at its arm", force(column));
      add(name + "_slid_m", "m", "how far it has slid since the reference configuration",
          [this, column] { return simulation_->element_memory()[column]; });
    }
  for (std::size_t i = 0; i < elements.air_springs.size(); ++i)
    add(fmt::format("air.{}.pressure_Pa", elements.air_springs[i].name), "Pa", "absolute, in the bellows",
        [this, at = elements.memory_of_air(i) + 1] { return simulation_->element_memory()[at]; });
  for (const vehicle::DamperCurve& damper : elements.dampers)
    add(fmt::format("damper.{}_N", damper.name), "N", "force of the damper, against the rate",
        [this, &damper, &column = elements.columns[static_cast<std::size_t>(damper.column)]] {
          double linear = 0.0;
          for (const auto& [c, factor] : column.direction) linear += damper.linear * factor * simulation_->state().v[c];
          return linear + simulation_->element_force()[damper.column];
        });
}

/// What running tests and wear ask of the wheels.
void HistoryRecord::add_running(std::size_t watched) {
  const vehicle::VehicleOnTrack& vehicle = vehicle_;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const std::string prefix = i == watched ? "" : vehicle.wheels[i].name + '.';
    const std::string of = i == watched ? " (" + vehicle.wheels[i].name + ")" : "";
    const auto reaction = [this, i]() -> const ContactReaction& { return simulation_->reactions()[i]; };
    add(prefix + "Y_over_Q", "1", "lateral over vertical force on the rail, 0 without contact" + of, [=] {
      const Vec3& force = reaction().on_rail.force;
      return force.z() > 0.0 ? force.y() / force.z() : 0.0;
    });
    add(prefix + "Tgamma_N", "N", "wear number: power of friction over speed" + of, [=, this] {
      const ContactReaction& r = reaction();
      const double speed = vehicle_.motion(i, simulation_->state()).wheelset_velocity.x;
      return (r.frictional_power - r.rail_power) / speed;
    });
  }
  for (std::size_t set = 0; set < vehicle.system.wheelsets.size(); ++set)
    add(fmt::format("ws{}.sumY_N", set + 1), "N", "lateral force on both rails", [this, set] {
      double sum = 0.0;
      for (std::size_t i = 0; i < simulation_->reactions().size(); ++i)
        if (static_cast<std::size_t>(vehicle_.wheels[i].wheelset) == set)
          sum += simulation_->reactions()[i].on_rail.force.y();
      return sum;
    });
}

/// Of points that move little: a + (angular acceleration) x arm. What passengers feel beside it is asked of named
/// points only.
void HistoryRecord::add_accelerations(const io::HistoryRequest& request) {
  const vehicle::Multibody& system = vehicle_.system;
  const auto add_point = [&](const std::string& name, const std::string& what, const vehicle::Multibody::Body& body,
                             const Vec3& arm, bool felt) {
    const auto place = [at = body.coordinate](Freedom f) { return at[static_cast<std::size_t>(f)]; };
    const auto rate = [this, place](Freedom f) { return place(f) < 0 ? 0.0 : simulation_->acceleration()[place(f)]; };
    // As an instrument on the body shows it, which takes gravity along its axes for acceleration.
    const auto of_line = [this, at = Vec3(body.position + arm)] {
      const auto& line = vehicle_.line;
      return line ? line->felt_acceleration(at, simulation_->state().time) : Vec3(Vec3::Zero());
    };
    const auto lean = [this, roll = place(Freedom::roll)] { return roll < 0 ? 0.0 : simulation_->state().q[roll]; };
    add(name + ".ay_m_s2", "m/s2", "lateral acceleration of " + what, [=, gravity = request.gravity] {
      return rate(Freedom::y) + rate(Freedom::yaw) * arm.x() - rate(Freedom::roll) * arm.z() + of_line().y() -
             gravity * lean();
    });
    const bool pitches = body.wheelset < 0;  // axle boxes do not turn with the axle
    add(name + ".az_m_s2", "m/s2", "vertical acceleration of " + what, [=] {
      return rate(Freedom::z) + rate(Freedom::roll) * arm.y() - (pitches ? rate(Freedom::pitch) : 0.0) * arm.x() +
             of_line().z();
    });
    if (!felt) return;
    const auto tip = [this, pitch = place(Freedom::pitch), pitches] {
      return pitches && pitch >= 0 ? simulation_->state().q[pitch] : 0.0;
    };
    add(name + ".ax_m_s2", "m/s2", "longitudinal acceleration of " + what, [=, gravity = request.gravity] {
      return rate(Freedom::x) + (pitches ? rate(Freedom::pitch) : 0.0) * arm.z() - rate(Freedom::yaw) * arm.y() +
             of_line().x() + gravity * tip();
    });
    add(name + ".roll_rate_rad_s", "rad/s", "rate at which " + what + " rolls", [=, this, x = body.position.x()] {
      const auto& line = vehicle_.line;
      const int roll = place(Freedom::roll);
      return (roll < 0 ? 0.0 : simulation_->state().v[roll]) +
             (line ? line->frame_spin(x, simulation_->state().time).x() : 0.0);
    });
  };
  for (const vehicle::WheelOnRail& wheel : vehicle_.wheels) {
    const auto& set = system.wheelsets[static_cast<std::size_t>(wheel.wheelset)];
    const double y = wheel.side == wheelrail::Side::left ? -request.axle_box_y : request.axle_box_y;
    add_point("axle_box." + wheel.name, "the axle box of " + wheel.name,
              system.bodies[static_cast<std::size_t>(set.body)], {0.0, y, 0.0}, false);
  }
  for (const io::PointInput& point : request.points)
    add_point(fmt::format("{}.{}", kPointKinds[static_cast<std::size_t>(point.kind)], point.name),
              fmt::format("a point of {}", point.body),
              *ranges::find(system.bodies, point.body, &vehicle::Multibody::Body::name), point.arm, true);
}

void HistoryRecord::keep_only(const io::HistoryRequest& request) {
  if (request.channels.empty()) return;
  std::vector<Column> kept{columns_[0], columns_[1]};  // time and distance
  for (const std::size_t i : io::fitting_columns(columns(), request.channels, request.channels_where))
    if (i > 1) kept.push_back(columns_[i]);
  columns_ = std::move(kept);
}

std::vector<io::HistoryColumn> HistoryRecord::columns() const {
  std::vector<io::HistoryColumn> heads;
  for (const Column& column : columns_) heads.push_back(column.head);
  return heads;
}

void HistoryRecord::append(std::vector<double>& values) const {
  for (const Column& column : columns_) values.push_back(column.value());
}

namespace {

/// Of a wheel whose contact is chosen, behind its name.
constexpr const char* kOfChoice[][3] = {
    {"full_share", "1", "share of the way in full contact"},
    {"table_error_max", "1", "largest error of forces that came from the table, over the normal force"},
    {"table_error_rms", "1", "the same over the way"},
    {"table_wear_error_max", "1", "largest error of wear numbers that came from the table"}};

}  // namespace

HistorySummary::HistorySummary(const io::SimulationFile& file, const vehicle::Simulation& simulation)
    : simulation_(simulation), watched_(watched_wheel(file)), has_pressure_(is_full(file, watched_)) {
  for (const std::size_t wheel : chosen_wheels(file)) chosen_.push_back({wheel});
}

void HistorySummary::note_choices() {
  const double x = simulation_.vehicle().travel(simulation_.state().time).distance, way = x - at_;
  for (Chosen& c : chosen_) {
    const vehicle::ContactReaction& r = simulation_.reactions()[c.wheel];
    const bool full = r.full_share > 0.5;
    if (begun_ ? full != c.is_full : full) changes_.push_back({simulation_.state().time, c.wheel, full});
    c.is_full = full;
    if (begun_) {
      c.way += way;
      c.full += r.full_share * way;
    }
    if (!(r.full_share < 1.0)) continue;
    if (begun_) c.square += r.table_error * r.table_error * (1.0 - r.full_share) * way;
    c.worst = std::max(c.worst, r.table_error);
    c.worst_wear = std::max(c.worst_wear, r.table_wear_error);
  }
  at_ = x;
}

void HistorySummary::note_speed() {
  const vehicle::VehicleOnTrack& v = simulation_.vehicle();
  if (!v.system.free_along) return;
  const Travel travel = v.travel(simulation_.state().time);
  const OtherSpeed now{travel.distance, v.mean_speed(simulation_.state()), travel.speed};
  if (is_another_speed(now.mean, now.wanted) && now.share() > other_speed_.share()) other_speed_ = now;
}

void HistorySummary::note() {
  const vehicle::ContactReaction& r = simulation_.reactions()[watched_];
  const double time = simulation_.state().time, q = r.on_rail.force.z();
  // The first of equal ones counts.
  const auto larger = [&](Extreme& e, double value) {
    if (!begun_ || value > e.value) e = {value, time};
  };
  const auto smaller = [&](Extreme& e, double value) {
    if (!begun_ || value < e.value) e = {value, time};
  };
  larger(highest_, q);
  smaller(lowest_, q);
  larger(ty_max_, r.lateral_creep_force);
  smaller(ty_min_, r.lateral_creep_force);
  larger(pmax_, r.max_pressure);
  if (r.doubts > 0) ++doubtful_;
  note_speed();
  note_choices();
  if (!begun_) at_rest_ = q;
  begun_ = true;
}

struct HistorySummary::Row {
  const char *name, *unit, *description;
  double (*value)(const HistorySummary&);
};

std::vector<HistorySummary::Row> HistorySummary::rows(bool has_pressure) {
  using S = const HistorySummary&;
  std::vector<Row> rows{
      {"q_max_N", "N", "largest vertical force", [](S s) { return s.highest_.value; }},
      {"q_max_t_s", "s", "when", [](S s) { return s.highest_.time; }},
      {"q_max_x_m", "m", "where", [](S s) { return s.simulation_.vehicle().travel(s.highest_.time).distance; }},
      {"q_min_N", "N", "least vertical force", [](S s) { return s.lowest_.value; }},
      {"q_static_N", "N", "vertical force at the start", [](S s) { return s.at_rest_; }},
      {"q_max_over_static", "1", "largest vertical force over that at the start",
       [](S s) { return s.highest_.value / s.at_rest_; }},
      {"ty_max_N", "N", "largest lateral creep force", [](S s) { return s.ty_max_.value; }},
      {"ty_min_N", "N", "least lateral creep force", [](S s) { return s.ty_min_.value; }}};
  if (has_pressure) {
    rows.push_back({"pmax_Pa", "Pa", "largest contact pressure", [](S s) { return s.pmax_.value; }});
    rows.push_back({"doubtful_steps", "1", "steps with a warning about the contact",
                    [](S s) { return static_cast<double>(s.doubtful_); }});
  }
  const std::initializer_list<Row> rest = {
      {"contact_lost", "1", "how often a wheel lost contact",
       [](S s) {
         return static_cast<double>(ranges::count(s.simulation_.events(), false, &vehicle::ContactEvent::regained));
       }},
      {"energy_turnover_J", "J", "work of contacts and dampers, all counted positive",
       [](S s) { return s.simulation_.energy().turnover; }},
      {"energy_integration_error", "1", "over the turnover",
       [](S s) { return s.simulation_.energy().integration_error(s.simulation_.energy_at_start()) / s.turnover(); }},
      {"energy_contact_error", "1", "over the turnover",
       [](S s) { return s.simulation_.energy().contact_error(s.simulation_.energy_at_start()) / s.turnover(); }},
      {"steps", "1", "accepted time steps", [](S s) { return static_cast<double>(s.simulation_.counts().steps); }},
      {"steps_rejected", "1", "time steps that were repeated",
       [](S s) { return static_cast<double>(s.simulation_.counts().rejected); }},
      {"contact_rounds", "1", "evaluations of all contacts",
       [](S s) { return static_cast<double>(s.simulation_.counts().evaluations); }}};
  rows.insert(rows.end(), rest);
  return rows;
}

double HistorySummary::turnover() const { return std::max(simulation_.energy().turnover, 1e-300); }

std::vector<io::NamedValue> HistorySummary::values() const {
  std::vector<io::NamedValue> summary;
  if (!begun_) return summary;
  for (const Row& row : rows(has_pressure_)) summary.push_back({row.name, row.value(*this), row.unit, row.description});
  for (const Chosen& c : chosen_) {
    const double table = c.way - c.full;
    const double numbers[] = {c.way > 0.0 ? c.full / c.way : 1.0 * c.is_full, c.worst,
                              table > 0.0 ? std::sqrt(c.square / table) : 0.0, c.worst_wear};
    for (std::size_t i = 0; i < std::size(numbers); ++i)
      summary.push_back({simulation_.vehicle().wheels[c.wheel].name + '.' + kOfChoice[i][0], numbers[i],
                         kOfChoice[i][1], kOfChoice[i][2]});
  }
  return summary;
}

std::vector<std::string> HistorySummary::names(const io::SimulationFile& file) {
  std::vector<std::string> names;
  for (const Row& row : rows(is_full(file, watched_wheel(file)))) names.emplace_back(row.name);
  for (const std::size_t wheel : chosen_wheels(file))
    for (const auto& row : kOfChoice) names.push_back(wheel_name(file.wheels[wheel]) + '.' + row[0]);
  return names;
}

void HistorySummary::save(ByteWriter& out) const {
  out.put(begun_);
  out.put(at_rest_);
  out.put(doubtful_);
  for (const Extreme* e : {&highest_, &lowest_, &ty_max_, &ty_min_, &pmax_}) out.put(e->value), out.put(e->time);
  out.put(at_);
  for (const double value : {other_speed_.place, other_speed_.mean, other_speed_.wanted}) out.put(value);
  for (const Chosen& c : chosen_) {
    out.put(c.is_full);
    for (const double value : {c.way, c.full, c.square, c.worst, c.worst_wear}) out.put(value);
  }
  out.put(changes_.size());
  for (const ContactChange& c : changes_) out.put(c.time), out.put(c.wheel), out.put(c.full);
}

void HistorySummary::restore(ByteReader& in) {
  in.get(begun_);
  in.get(at_rest_);
  in.get(doubtful_);
  for (Extreme* e : {&highest_, &lowest_, &ty_max_, &ty_min_, &pmax_}) in.get(e->value), in.get(e->time);
  in.get(at_);
  for (double* value : {&other_speed_.place, &other_speed_.mean, &other_speed_.wanted}) in.get(*value);
  for (Chosen& c : chosen_) {
    in.get(c.is_full);
    for (double* value : {&c.way, &c.full, &c.square, &c.worst, &c.worst_wear}) in.get(*value);
  }
  changes_.clear();
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    ContactChange& c = changes_.emplace_back();
    in.get(c.time), in.get(c.wheel), in.get(c.full);
    if (c.wheel >= simulation_.vehicle().wheels.size())
      throw Error(ErrorKind::input_data, "a saved state belongs to another simulation", {}, "start anew");
  }
}

}  // namespace treadmark::app
