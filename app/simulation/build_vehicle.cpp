// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/build_vehicle.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/simulation/line_summary.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/stopwatch.hpp"
#include "treadmark/solvers/vehicle/contact_on_rail.hpp"
#include "treadmark/solvers/vehicle/lateral_track.hpp"
#include "treadmark/solvers/vehicle/table_contact.hpp"

namespace treadmark::app {
namespace {

constexpr double kRailBeyond = 0.5;  // [m], ahead of and behind what the wheels pass

UsedBodies bodies_of(const wheelrail::Geometry& geometry, const io::SimulationFile& file, Side side) {
  UsedBodies used;
  used.wheel = {Body::wheel, geometry.wheel, nullptr, geometry.round_wheel, file.contact.wheelset.nominal_radius};
  used.rail = {Body::rail, geometry.rail, nullptr, geometry.prismatic_rail, 0.0};
  used.left = side == Side::left;
  return used;
}

io::SurfaceSource round_wheel(const io::SimulationFile& file) {
  io::SurfaceSource source = file.other_wheel ? *file.other_wheel : file.contact.wheel;
  source.defects = {};
  return source;
}

}  // namespace

io::SurfaceSource wheel_source(const io::SimulationFile& file, const io::WheelContactInput& wheel) {
  if (wheel.defects) return file.contact.wheel;
  io::SurfaceSource source = round_wheel(file);
  source.backend = file.contact.wheel.backend;
  source.resolution = file.contact.wheel.resolution;
  return source;
}

namespace {

class Builder {
 public:
  Builder(const io::SimulationFile& file, SurfaceStore& store) : file_(file), store_(store) {
    rail_region_.u_min = -kRailBeyond;
    rail_region_.u_max = file.settings.distance + kRailBeyond;
  }

  wheelrail::Geometry full_geometry(const io::WheelContactInput& wheel) {
    return geometry(wheel_source(file_, wheel), file_.contact.rail);
  }

  /// As the wheels are given, whatever represents them in the analysis.
  std::shared_ptr<const DefectDepth> defect_depth() {
    io::SurfaceSource given = file_.contact.wheel;
    given.backend = "";
    given.resolution = 0.0;
    const auto natural = [&] {
      return store_.get(given, Body::wheel, file_.contact.wheelset.nominal_radius, Region{}).natural;
    };
    const auto wheel = natural();
    if (wheel->constant_profile()) return nullptr;
    if (given.defects.empty()) return std::make_shared<const DefectDepth>(wheel->surface, nullptr);
    given.defects = {};
    return std::make_shared<const DefectDepth>(wheel->surface, natural()->surface);
  }

  /// Round wheel, rail without defects, both as they are given.
  wheelrail::Geometry table_geometry() {
    io::SurfaceSource wheel = round_wheel(file_), rail = file_.contact.rail;
    rail.defects = {};
    wheel.backend = rail.backend = "";
    wheel.resolution = rail.resolution = 0.0;
    const wheelrail::Geometry bodies = geometry(wheel, rail);
    if (!bodies.constant_profiles())
      throw Error(ErrorKind::configuration,
                  bodies.round_wheel ? "wheels with table contact need a rail of one section"
                                     : "wheels with table contact must be round",
                  wheel.where,
                  bodies.round_wheel ? "give every wheel contact = \"full\""
                                     : "give the shape of the round wheels as simulation.other_wheel");
    return bodies;
  }

  std::shared_ptr<const vehicle::ContactTable> table(double wheel_load) {
    if (!table_) table_ = vehicle::build_contact_table(table_geometry(), to_problem(file_.contact, true), wheel_load);
    return table_;
  }

 private:
  wheelrail::Geometry geometry(const io::SurfaceSource& wheel_source, const io::SurfaceSource& rail_source) {
    const StoredSurface& rail = store_.get(rail_source, Body::rail, 0.0, rail_region_);
    const StoredSurface& wheel = store_.get(wheel_source, Body::wheel, file_.contact.wheelset.nominal_radius, Region{});
    return {rail.represented.surface, wheel.represented.surface, rail.constant_profile(), wheel.constant_profile()};
  }

  const io::SimulationFile& file_;
  SurfaceStore& store_;
  Region rail_region_;
  std::shared_ptr<const vehicle::ContactTable> table_;
};

/// What moves below each wheelset beside rails that bend.
std::optional<TrackModel> track_below(const io::SimulationFile& file) {
  return file.flexible_track ? vehicle::lateral_track(*file.flexible_track) : file.track;
}

/// The rail under a wheelset from where the simulation starts.
vehicle::MovingRail rail_below(const io::SimulationFile& file, std::size_t wheelset) {
  const std::string& body = file.vehicle.wheelsets.at(wheelset).body;
  const double x = std::ranges::find(file.vehicle.bodies, body, &BodySpec::name)->position.x();
  constexpr double kNoNumericalDamping = 1.0;  // rails have their own
  return {*file.flexible_track, file.settings.speed, file.settings.from_midspan + x, kNoNumericalDamping};
}

}  // namespace

std::size_t BuiltVehicle::watched_wheel() const {
  const auto first_full = std::ranges::find_if(full, [](const auto& element) { return element != nullptr; });
  return first_full != full.end() ? static_cast<std::size_t>(first_full - full.begin()) : 0;
}

std::string wheel_name(const io::WheelContactInput& wheel) {
  return fmt::format("ws{}_{}", wheel.wheelset + 1, wheel.side == Side::left ? "left" : "right");
}

BuiltVehicle build_vehicle(const io::SimulationFile& file, SurfaceStore& store) {
  refuse_line(file);
  Builder builder(file, store);
  BuiltVehicle built;
  vehicle::VehicleOnTrack& v = built.vehicle;
  v.speed = file.settings.speed;
  v.system = vehicle::assemble(file.vehicle, track_below(file), v.speed, file.settings.gravity);
  v.pitch_at_start.assign(v.system.wheelsets.size(), 0.0);
  for (const io::WheelContactInput& wheel : file.wheels) {
    vehicle::WheelOnRail on{wheel.wheelset, wheel.side, wheel_name(wheel), nullptr, Vec3::Zero()};
    if (wheel.pitch) v.pitch_at_start.at(static_cast<std::size_t>(wheel.wheelset)) = *wheel.pitch;
    if (wheel.model == io::ContactModelInput::full) {
      const wheelrail::Geometry geometry = builder.full_geometry(wheel);
      io::WheelRailCase input = file.contact;
      input.side = wheel.side;
      const wheelrail::Problem problem = to_problem(input, geometry.round_wheel);
      on.rail_marker = vehicle::rail_marker_at_rest(geometry, problem);
      built.full.push_back(std::make_shared<vehicle::FullContact>(geometry, problem));
      built.bodies.push_back(bodies_of(geometry, file, wheel.side));
      on.element = built.full.back();
    } else {
      const Stopwatch watch(built.table_seconds);
      const double load = *std::ranges::max_element(v.system.wheelset_load) / 2.0;
      const auto table = builder.table(load);
      on.element = std::make_shared<vehicle::TableContact>(table, on.side);
      on.rail_marker = table->nominal().X_TR.origin;
      if (on.side == Side::left) on.rail_marker.y() = -on.rail_marker.y();
      built.full.push_back(nullptr);
      built.bodies.emplace_back();
    }
    if (file.flexible_track) {
      constexpr double kTolerance = 1e-4;  // a tenth of what a step may leave
      const auto set = static_cast<std::size_t>(wheel.wheelset);
      on.element = std::make_shared<vehicle::ContactOnRail>(on.element, rail_below(file, set),
                                                            0.5 * v.system.wheelset_load.at(set), kTolerance);
    }
    v.wheels.push_back(std::move(on));
  }
  v.connect();
  const bool fields = !file.fields.pitch.empty() || !file.fields.position.empty();
  const auto damaged = [](const io::WheelContactInput& w) {
    return w.model == io::ContactModelInput::full && w.defects;
  };
  if (fields && std::ranges::any_of(file.wheels, damaged)) built.defect_depth = builder.defect_depth();
  return built;
}

void check_vehicle(const io::SimulationFile& file, SurfaceStore& store) {
  Builder builder(file, store);
  if (file.flexible_track) rail_below(file, 0);
  vehicle::assemble(file.vehicle, track_below(file), file.settings.speed, file.settings.gravity);
  for (const io::WheelContactInput& wheel : file.wheels) {
    const bool full = wheel.model == io::ContactModelInput::full;
    const wheelrail::Geometry geometry = full ? builder.full_geometry(wheel) : builder.table_geometry();
    io::WheelRailCase input = file.contact;
    input.side = wheel.side;
    vehicle::rail_marker_at_rest(geometry, to_problem(input, geometry.round_wheel));
  }
}

vehicle::SimulationSettings integration_settings(const io::SimulationFile& file) {
  const io::SimulationSettings& s = file.settings;
  vehicle::SimulationSettings out;
  out.duration = s.duration;
  out.position_tolerance = s.tolerance;
  out.min_step = s.min_step;
  out.max_step = s.max_step.value_or(1e-3);
  const bool any_full =
      std::ranges::any_of(file.wheels, [](const auto& w) { return w.model == io::ContactModelInput::full; });
  constexpr double kNoLimit = 0.1;  // [m]
  // A wheelset may run a little ahead of the vehicle.
  constexpr double kWithin = 0.99;
  out.max_travel = any_full ? kWithin * s.max_step_elements * file.contact.discretisation.dx : kNoLimit;
  if (file.flexible_track) {
    // The error of a rail's motion is not estimated: steps are short against its waves and elements.
    constexpr double kShortest = 5e-5, kOfBay = 0.02;
    const std::vector<RailSeat>& seats = file.flexible_track->seats;
    out.max_step = s.max_step.value_or(kShortest);
    out.max_travel = std::min(out.max_travel, kOfBay * (seats[1].x - seats[0].x));
  }
  out.step.spectral_radius = s.spectral_radius;
  return out;
}

}  // namespace treadmark::app
