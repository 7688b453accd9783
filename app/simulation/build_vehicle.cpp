// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/build_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/simulation/history_record.hpp"
#include "treadmark/app/simulation/line_summary.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/stopwatch.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/vehicle/contacts/check_rail.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_on_rail.hpp"
#include "treadmark/solvers/vehicle/contacts/switched_contact.hpp"
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"
#include "treadmark/solvers/vehicle/track/lateral_track.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::app {
namespace {

constexpr double kRailBeyond = 0.5;  // [m], ahead of and behind what the wheels pass

UsedBodies bodies_of(const wheelrail::Geometry& geometry, double radius, Side side) {
  UsedBodies used;
  used.wheel = {Body::wheel, geometry.wheel, nullptr, geometry.round_wheel, radius};
  used.rail = {Body::rail, geometry.rail, nullptr, geometry.prismatic_rail, 0.0};
  used.left = side == Side::left;
  return used;
}

io::SurfaceSource round_wheel(const io::SimulationFile& file) {
  io::SurfaceSource source = file.other_wheel ? *file.other_wheel : file.contact.wheel;
  source.defects = {};
  source.offsets = {};
  return source;
}

/// Whatever represents it.
io::SurfaceSource as_given(io::SurfaceSource source) {
  source.backend.clear();
  source.resolution = 0.0;
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

io::WheelRailCase contact_input(const io::SimulationFile& file, const io::WheelContactInput& wheel) {
  io::WheelRailCase input = file.contact;
  if (const double radius = file.wheel_radius(wheel.wheelset); radius != input.wheelset.nominal_radius) {
    input.wheelset.nominal_radius = radius;
    input.state.velocity.pitch = -input.state.velocity.x / radius;
  }
  input.side = wheel.side;
  input.rail = file.rail(wheel.side);
  if (wheel.side == Side::left && !input.track.gauge_based) input.track.rail_y0 = -input.track.rail_y0;
  return input;
}

namespace {

/// Place of an axle along the vehicle [m].
double axle_x(const io::SimulationFile& file, int wheelset) {
  const std::string& body = file.vehicle.wheelsets.at(static_cast<std::size_t>(wheelset)).body;
  return ranges::find(file.vehicle.bodies, body, &BodySpec::name)->position.x();
}

}  // namespace

double rail_place(const io::SimulationFile& file, int wheelset) {
  return file.settings.rail_start + (axle_x(file, wheelset) - axle_x(file, 0));
}

namespace {

bool is_chosen(const io::WheelContactInput& wheel) { return wheel.model == io::ContactModelInput::automatic; }

bool has_full(const io::WheelContactInput& wheel) { return wheel.model != io::ContactModelInput::table; }

bool has_table(const io::WheelContactInput& wheel) {
  return wheel.model != io::ContactModelInput::full || wheel.changes_over();
}

/// Below a wheel, where it varies along the track.
vehicle::FrictionAlong friction_below(const io::SimulationFile& file, const io::WheelContactInput& wheel) {
  const io::FrictionVariation& v = file.contact.friction_variation;
  if (v.kind != io::FrictionVariation::Kind::along_track) return {};
  return {v.positions, v.laws, rail_place(file, wheel.wheelset)};
}

/// A shape with a radius of its own is no wheel of two.
void refuse_other_radii(const io::SimulationFile& file) {
  const auto refuse = [&](const io::SurfaceSource& shape, const char* what, auto&& has) {
    const auto first = ranges::find_if(file.wheels, has);
    const auto other = std::find_if(first, file.wheels.end(), [&](const io::WheelContactInput& wheel) {
      return has(wheel) && file.wheel_radius(wheel.wheelset) != file.wheel_radius(first->wheelset);
    });
    if (other == file.wheels.end()) return;
    throw Error(ErrorKind::configuration,
                fmt::format("the wheels of wheelset {} have a radius of {:.6g} mm and those of wheelset {} {:.6g} mm, "
                            "but {}",
                            first->wheelset + 1, 1e3 * file.wheel_radius(first->wheelset), other->wheelset + 1,
                            1e3 * file.wheel_radius(other->wheelset), what),
                shape.where,
                "give a profile or slices, or the shape of wheels without defects as simulation.other_wheel");
  };
  constexpr const char *kShape = "the shape of both lies about its axle, with one radius",
                       *kTable = "the table of deviations of both counts along the circumference of one";
  const auto damaged = [](const io::WheelContactInput& wheel) { return has_full(wheel) && wheel.defects; };
  const io::SurfaceSource& wheel = file.contact.wheel;
  if (has_own_radius(wheel))
    refuse(wheel, kShape, [&](const io::WheelContactInput& w) { return !file.other_wheel || damaged(w); });
  if (file.other_wheel && has_own_radius(*file.other_wheel))
    refuse(*file.other_wheel, kShape, [&](const io::WheelContactInput& w) { return !damaged(w) || has_table(w); });
  if (!wheel.offsets.file.empty() && !wheel.offsets.angles_deg) refuse(wheel, kTable, damaged);
}

/// Where a wheel's contact is found in full.
vehicle::FullStretch stretch_of(const io::SimulationFile& file, const io::WheelContactInput& wheel) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  vehicle::FullStretch stretch;
  stretch.from = wheel.full_from.value_or(-kFar);
  stretch.to = wheel.full_to.value_or(kFar);
  stretch.rail_x = rail_place(file, wheel.wheelset);
  return stretch;
}

class Builder {
 public:
  Builder(const io::SimulationFile& file, SurfaceStore& store, ContactTables& kept)
      : file_(file), store_(store), kept_(kept) {}

  wheelrail::Geometry full_geometry(const io::WheelContactInput& wheel) {
    wheelrail::Geometry bodies = geometry(wheel_source(file_, wheel), file_.wheel_radius(wheel.wheelset),
                                          file_.rail(wheel.side), rail_region(wheel.side));
    if ((wheel.changes_over() || is_chosen(wheel)) && !bodies.round_wheel)
      throw Error(ErrorKind::configuration,
                  fmt::format("{} is not round: its contact cannot change over to a table", wheel_name(wheel)),
                  file_.contact.wheel.where,
                  "give it contact = \"full\" without full_from_m and full_to_m, or say defects = false");
    return bodies;
  }

  /// Refuses a rail that is another one than that of the tables where a wheel takes its forces from a table.
  void require_section(const io::WheelContactInput& wheel) {
    const io::SurfaceSource& own = file_.rail(wheel.side);
    const io::SurfaceSource source = table_rail(wheel.side);
    if (is_chosen(wheel)) return;
    const bool is_full = wheel.model == io::ContactModelInput::full;
    // Rails without their defects are what tables are of.
    if (is_full ? !wheel.changes_over() : natural_rail(undamaged(own)).constant_profile()) return;
    const vehicle::FullStretch stretch = stretch_of(file_, wheel);
    const double begin = stretch.rail_x, end = begin + file_.settings.distance;
    const auto require = [&](double from, double to) {
      if (from < to) require_section(wheel, {natural_rail(own), natural_rail(source)}, from, to);
    };
    if (!is_full) return require(begin, end);
    require(begin, std::min(end, stretch.from + stretch.blend));
    require(std::max(begin, stretch.to - stretch.blend), end);
  }

  /// Where the rail below a wheel is another one than that of its table [m], a little more.
  std::vector<std::pair<double, double>> damaged_places(const io::WheelContactInput& wheel) {
    constexpr double kPiece = 10.0, kBeside = 0.03;  // [m]
    const Rails rails{natural_rail(file_.rail(wheel.side)), natural_rail(table_rail(wheel.side))};
    std::vector<std::pair<double, double>> places;
    if (rails.own.constant_profile()) return places;
    const double begin = rail_place(file_, wheel.wheelset) - kBeside,
                 end = begin + file_.settings.distance + 2.0 * kBeside;
    for (double from = begin; from < end; from += kPiece) {
      check_cancelled();
      const RailsCompared compared = compare_rails(rails, from, std::min(end, from + kPiece));
      if (compared.apart > kSamePlace) refuse_place(wheel, compared.apart);
      for (int ix = 0; ix < compared.grid.nx; ++ix) {
        if (!(compared.most[static_cast<std::size_t>(ix)] > kSameHeight)) continue;
        const double x = compared.grid.x(ix);
        if (places.empty() || x - kBeside > places.back().second) places.emplace_back(x - kBeside, 0.0);
        places.back().second = x + kBeside;
      }
    }
    return places;
  }

  /// As the wheels of a radius are given, whatever represents them in the analysis.
  std::shared_ptr<const DefectDepth> defect_depth(double radius) {
    io::SurfaceSource given = file_.contact.wheel;
    given.backend = "";
    given.resolution = 0.0;
    const auto natural = [&] { return store_.get(given, Body::wheel, radius, Region{}).natural; };
    const auto wheel = natural();
    if (wheel->constant_profile()) return nullptr;
    if (given.defects.empty() && given.offsets.file.empty())
      return std::make_shared<const DefectDepth>(wheel->surface, nullptr);
    given.defects = {};
    given.offsets = {};
    return std::make_shared<const DefectDepth>(wheel->surface, natural()->surface);
  }

  /// Round wheel, rail without defects, both as they are given.
  wheelrail::Geometry table_geometry(Side side, double radius) {
    const io::SurfaceSource wheel = as_given(round_wheel(file_));
    wheelrail::Geometry bodies = geometry(wheel, radius, table_rail(side), Region{});
    if (!bodies.round_wheel)
      throw Error(ErrorKind::configuration, "wheels with table contact must be round", wheel.where,
                  "give the shape of the round wheels as simulation.other_wheel");
    if (!bodies.constant_profiles())
      throw Error(ErrorKind::configuration, "wheels with table contact need a rail of one section",
                  file_.table_rail ? file_.table_rail->where : file_.rail(side).where,
                  file_.table_rail ? "simulation.table_rail must not vary"
                                   : "give it as simulation.table_rail, or give every wheel contact = \"full\"");
    return bodies;
  }

  /// Whether there can be a table of a side.
  bool has_section(Side side, double radius) {
    return geometry(as_given(round_wheel(file_)), radius, table_rail(side), Region{}).constant_profiles();
  }

  std::shared_ptr<const vehicle::ContactTable> table(Side side, double radius, double wheel_load) {
    // Rails are right-hand ones: one table serves both sides of one shape.
    auto& made = tables_[{is_common(side) ? nullptr : &file_.rail(side), radius}];
    if (made) return made;
    // Before the cache is asked: this notes which surfaces a result comes from.
    const wheelrail::Geometry bodies = table_geometry(side, radius);
    wheelrail::Problem problem = to_problem(file_.contact, true);
    problem.wheelset.nominal_radius = radius;
    const std::string content = store_.content_key(round_wheel(file_), Body::wheel, radius) + " on " +
                                store_.content_key(table_rail(side), Body::rail, 0.0);
    return made = kept_.get(content, problem, wheel_load,
                            [&] { return kept_contact_table(kept_.cache(), content, bodies, problem, wheel_load); });
  }

  bool has_creep_table() const { return file_.settings.creep_forces == io::CreepForcesInput::exact_table; }

  /// Refuses a material that the table of creep forces is not for.
  void require_creep_table() const {
    if (has_creep_table()) vehicle::require_tabulated(to_problem(file_.contact, true).material);
  }

  /// Null where creep forces are those of the linear theory.
  std::shared_ptr<const vehicle::CreepTable> creep_table(const Progress& progress) {
    if (!has_creep_table()) return nullptr;
    require_creep_table();
    return kept_.creep(combine(to_problem(file_.contact, true).material).poisson,
                       [&](std::size_t finished, std::size_t all) {
                         if (progress.report) progress.report(finished, all, "table of creep forces");
                       });
  }

 private:
  static io::SurfaceSource undamaged(io::SurfaceSource rail) {
    rail.defects = {};
    rail.offsets = {};
    rail.backend = "";
    rail.resolution = 0.0;
    return rail;
  }

  const NaturalSurface& natural_rail(const io::SurfaceSource& source) {
    return *store_.get(source, Body::rail, 0.0, Region{}).natural;
  }

  /// Whether tables of a side are those of simulation.table_rail.
  bool is_common(Side side) {
    return file_.table_rail && !natural_rail(undamaged(file_.rail(side))).constant_profile();
  }

  io::SurfaceSource table_rail(Side side) { return undamaged(is_common(side) ? *file_.table_rail : file_.rail(side)); }

  /// What wheels of a side with full contact pass.
  Region rail_region(Side side) const {
    Region region;
    bool any = false;
    for (const io::WheelContactInput& wheel : file_.wheels) {
      if (wheel.side != side || !has_full(wheel)) continue;
      const vehicle::FullStretch stretch = stretch_of(file_, wheel);
      const double low = std::max(stretch.rail_x, stretch.from) - kRailBeyond,
                   high = std::min(stretch.rail_x + file_.settings.distance, stretch.to) + kRailBeyond;
      if (!(low < high)) continue;
      region.u_min = any ? std::min(region.u_min, low) : low;
      region.u_max = any ? std::max(region.u_max, high) : high;
      any = true;
    }
    return region;
  }

  struct Rails {
    const NaturalSurface& own;
    const NaturalSurface& of_table;
  };

  static constexpr double kSameHeight = 1e-5, kSamePlace = 1e-5;  // [m]
  struct RailsCompared {
    Grid2 grid;
    std::vector<double> most;  ///< by x: what heights differ by at most
    double apart = 0.0;        ///< of their origins
  };
  RailsCompared compare_rails(const Rails& rails, double from, double to) const {
    constexpr double kAside = 0.036, kAcross = 1e-3, kAlong = 5e-3;  // looked at, about the profile's origin [m]
    constexpr int kMost = 2000;
    wheelrail::Problem problem = to_problem(file_.contact, true);
    problem.wheelset.tape_line.reset();  // of the wheel, which is not asked for
    const auto origin = [&](const NaturalSurface& rail) {
      return wheelrail::place({rail.surface, nullptr, rail.constant_profile(), true}, problem).X_TR;
    };
    const Pose X_TR = origin(rails.own), X_TR_table = origin(rails.of_table);
    const int nx = 2 + std::clamp(to_whole<int>((to - from) / kAlong), 0, kMost - 2);
    const int ny = 2 * to_whole<int>(kAside / kAcross) + 1;
    RailsCompared out{{from, X_TR.origin.y() - kAside, (to - from) / (nx - 1), kAcross, nx, ny},
                      std::vector<double>(static_cast<std::size_t>(nx), 0.0),
                      (X_TR.origin - X_TR_table.origin).norm()};
    const Grid2& grid = out.grid;
    std::vector<double> z(grid.size()), z_table(grid.size()), slope(grid.size());
    rails.own.surface->heights({X_TR.inverse(), grid}, {z, {}, {}});
    rails.of_table.surface->heights({X_TR_table.inverse(), grid}, {z_table, {}, slope});
    for (int iy = 0; iy < ny; ++iy)
      for (int ix = 0; ix < nx; ++ix) {
        const std::size_t i = grid.index(ix, iy);
        if (!(std::abs(slope[i]) <= 1.0)) continue;
        const double off = std::isnan(z[i]) ? std::numeric_limits<double>::infinity() : std::abs(z[i] - z_table[i]);
        double& most = out.most[static_cast<std::size_t>(ix)];
        most = std::max(most, off);
      }
    return out;
  }

  SourcePosition place_of_rail(const io::WheelContactInput& wheel) const {
    const SourcePosition where = file_.rail(wheel.side).where;
    return where.file.empty() ? SourcePosition{file_.path.string(), 1, 1} : where;
  }

  [[noreturn]] void refuse_place(const io::WheelContactInput& wheel, double apart) const {
    throw Error(
        ErrorKind::configuration,
        fmt::format("the rail below {} and that of its table lie {:.3g} mm apart", wheel_name(wheel), 1e3 * apart),
        place_of_rail(wheel),
        "their gauge is measured at x = 0: begin where both are the same, or place them by rail_y_mm");
  }

  void require_section(const io::WheelContactInput& wheel, const Rails& rails, double from, double to) const {
    const RailsCompared compared = compare_rails(rails, from, to);
    if (compared.apart > kSamePlace) refuse_place(wheel, compared.apart);
    const auto most = ranges::max_element(compared.most);
    if (*most <= kSameHeight) return;
    throw Error(
        ErrorKind::configuration,
        fmt::format("{} takes its forces from a table at x = {:.6g} m along the rail, which differs there by "
                    "{:.3g} mm from the rail of the table",
                    wheel_name(wheel), compared.grid.x(static_cast<int>(most - compared.most.begin())), 1e3 * *most),
        place_of_rail(wheel),
        "give the wheel contact = \"full\" there (full_from_m, full_to_m) or \"auto\", or another "
        "simulation.table_rail");
  }

  wheelrail::Geometry geometry(const io::SurfaceSource& wheel_source, double radius,
                               const io::SurfaceSource& rail_source, const Region& region) {
    for (const io::SurfaceSource* source : {&rail_source, &wheel_source}) refuse_one_place(*source, "a simulation");
    const StoredSurface& rail = store_.get(rail_source, Body::rail, 0.0, region);
    const StoredSurface& wheel = store_.get(wheel_source, Body::wheel, radius, Region{});
    return {rail.represented.surface, wheel.represented.surface, rail.constant_profile(), wheel.constant_profile()};
  }

  const io::SimulationFile& file_;
  SurfaceStore& store_;
  ContactTables& kept_;
  /// By the rail that they are of (null: simulation.table_rail) and the radius of the wheels [m].
  std::map<std::pair<const io::SurfaceSource*, double>, std::shared_ptr<const vehicle::ContactTable>> tables_;
};

/// Of a step with a full contact [m].
double full_travel(const io::SimulationFile& file) {
  constexpr double kWithin = 0.99;  // a wheelset may run a little ahead of the vehicle
  return kWithin * file.settings.max_step_elements * file.contact.discretisation.dx;
}

vehicle::ChoiceSettings choice_settings(const io::SimulationFile& file, const io::WheelContactInput& wheel, double load,
                                        std::vector<std::pair<double, double>> always_full) {
  const io::SimulationSettings& s = file.settings;
  return {
      {s.force_error, s.wear_error}, load, full_travel(file), std::move(always_full), rail_place(file, wheel.wheelset),
      friction_below(file, wheel)};
}

/// What moves below each wheelset beside rails that bend: nothing where they bend sideways, too.
std::optional<TrackModel> track_below(const io::SimulationFile& file) {
  if (file.flexible_track && file.flexible_track->sideways) return std::nullopt;
  return file.flexible_track ? vehicle::lateral_track(*file.flexible_track) : file.track;
}

/// The rails that bend below all wheels: one for each side, or one for each wheel.
class RailsBelow {
 public:
  RailsBelow(const io::SimulationFile& file, const vehicle::Multibody& system) : file_(file), system_(system) {
    if (!file.settings.shared_rails) return;
    std::vector<int> all(system.wheelsets.size());
    std::iota(all.begin(), all.end(), 0);
    for (const Side side : {Side::left, Side::right}) shared_[side] = below(all);
  }

  /// on: a wheel whose element knows nothing of the rail.
  std::shared_ptr<vehicle::ContactElement> upon(const vehicle::WheelOnRail& on) const {
    constexpr double kTolerance = 1e-4;  // a tenth of what a step may leave
    const auto set = static_cast<std::size_t>(on.wheelset);
    const auto shared = shared_.find(on.side);
    const bool alone = shared == shared_.end();
    return std::make_shared<vehicle::ContactOnRail>(on.element, alone ? below({on.wheelset}) : shared->second,
                                                    alone ? 0 : set, kTolerance, on.rail_marker,
                                                    system_.wheelsets.at(set).nominal_radius);
  }

  /// One rail.
  std::shared_ptr<vehicle::LoadedRail> below(const std::vector<int>& wheelsets) const {
    constexpr double kNoNumericalDamping = 1.0;  // rails have their own
    std::vector<double> places, loads;
    for (const int wheelset : wheelsets) {
      places.push_back(file_.settings.from_midspan + axle_x(file_, wheelset));
      loads.push_back(0.5 * system_.wheelset_load.at(static_cast<std::size_t>(wheelset)));
    }
    return std::make_shared<vehicle::LoadedRail>(
        vehicle::MovingRail(*file_.flexible_track, file_.settings.profile, places, kNoNumericalDamping), loads);
  }

 private:
  const io::SimulationFile& file_;
  const vehicle::Multibody& system_;
  std::map<Side, std::shared_ptr<vehicle::LoadedRail>> shared_;
};

/// A wheel's contact with a check rail beside it.
std::shared_ptr<vehicle::ContactElement> beside(const io::CheckRailInput& rail, const io::SimulationFile& file,
                                                const io::WheelContactInput& wheel, const vehicle::WheelOnRail& on) {
  const vehicle::CheckRail check{rail.from,    rail.to,       rail.face_y,       rail.depth, rail.stiffness,
                                 rail.damping, rail.friction, rail.flare_length, rail.flare};
  const vehicle::FlangeBack back{0.5 * file.contact.wheelset.flange_back_distance,
                                 file.vehicle.wheelsets.at(static_cast<std::size_t>(wheel.wheelset)).nominal_radius,
                                 rail_place(file, wheel.wheelset)};
  return std::make_shared<vehicle::ContactWithCheckRail>(on.element, wheel.side, check, back, on.rail_marker);
}

}  // namespace

std::string wheel_name(const io::WheelContactInput& wheel) {
  return fmt::format("ws{}_{}", wheel.wheelset + 1, wheel.side == Side::left ? "left" : "right");
}

namespace {

/// A vehicle whose wheels lack their contacts. Finds errors that need none.
vehicle::VehicleOnTrack outline(const io::SimulationFile& file, bool irregularities) {
  refuse_other_radii(file);
  vehicle::VehicleOnTrack v;
  v.speed = file.settings.speed;
  v.system = vehicle::assemble(file.vehicle, track_below(file), v.speed, file.settings.gravity);
  v.line = build_line(file, v.system, irregularities);
  for (const io::WheelContactInput& wheel : file.wheels)
    v.wheels.push_back({wheel.wheelset, wheel.side, wheel_name(wheel), nullptr, Vec3::Zero()});
  HistoryRecord::columns_of(file, v);  // refuses names that are none
  vehicle::check(integration_settings(file));
  return v;
}

}  // namespace

BuiltVehicle build_vehicle(const io::SimulationFile& file, SurfaceStore& store, ContactTables* tables,
                           const Progress& progress) {
  ContactTables own;
  Builder builder(file, store, tables != nullptr ? *tables : own);
  BuiltVehicle built;
  vehicle::VehicleOnTrack& v = built.vehicle;
  v = outline(file, true);
  v.pitch_at_start.assign(v.system.wheelsets.size(), 0.0);
  std::optional<RailsBelow> rails;
  const auto lay_rails = [&] {
    if (file.flexible_track) rails.emplace(file, v.system);
  };
  lay_rails();
  // On rails that bend, and beside check rails, which are fixed to the running ones.
  const auto mounted = [&](std::shared_ptr<vehicle::ContactElement> contact, std::size_t i) {
    vehicle::WheelOnRail on = v.wheels[i];
    on.element = std::move(contact);
    for (const io::CheckRailInput& rail : file.check_rails)
      if (rail.side == on.side) on.element = beside(rail, file, file.wheels[i], on);
    return rails ? rails->upon(on) : on.element;
  };
  // Of the heaviest wheels with this radius, which have tables of their own.
  const auto load_of = [&](double radius) {
    double most = 0.0;
    for (std::size_t set = 0; set < v.system.wheelset_load.size(); ++set)
      if (file.wheel_radius(static_cast<int>(set)) == radius) most = std::max(most, v.system.wheelset_load[set]);
    return most / 2.0;
  };
  const auto table_of = [&](const io::WheelContactInput& wheel) {
    const double radius = file.wheel_radius(wheel.wheelset);
    return builder.table(wheel.side, radius, load_of(radius));
  };
  const auto tabulated = [&](const io::WheelContactInput& wheel) {
    const Stopwatch watch(built.table_seconds);
    return std::make_shared<vehicle::TableContact>(table_of(wheel), wheel.side, builder.creep_table(progress),
                                                   friction_below(file, wheel));
  };
  for (std::size_t i = 0; i < file.wheels.size(); ++i) {
    const io::WheelContactInput& wheel = file.wheels[i];
    vehicle::WheelOnRail& on = v.wheels[i];
    if (wheel.pitch) v.pitch_at_start.at(static_cast<std::size_t>(wheel.wheelset)) = *wheel.pitch;
    std::shared_ptr<vehicle::TableContact> from_table;
    const double radius = file.wheel_radius(wheel.wheelset);
    if (has_table(wheel)) {
      builder.require_section(wheel);
      from_table = tabulated(wheel);
      on.rail_marker = table_of(wheel)->nominal().X_TR.origin;
      if (on.side == Side::left) on.rail_marker.y() = -on.rail_marker.y();
    }
    if (has_full(wheel)) {
      const wheelrail::Geometry geometry = builder.full_geometry(wheel);
      const wheelrail::Problem problem = to_problem(contact_input(file, wheel), geometry.round_wheel);
      on.rail_marker = vehicle::rail_marker_at_rest(geometry, problem);
      built.full.push_back(std::make_shared<vehicle::FullContact>(
          geometry, problem, rail_place(file, wheel.wheelset),
          std::min(full_travel(file), integration_settings(file).max_travel), friction_below(file, wheel)));
      built.bodies.push_back(bodies_of(geometry, radius, wheel.side));
      on.element = built.full.back();
      if (is_chosen(wheel))
        on.element = built.chosen.emplace_back(std::make_shared<vehicle::ChosenContact>(
            built.full.back(), from_table,
            choice_settings(file, wheel, load_of(radius), builder.damaged_places(wheel))));
      else if (from_table)
        on.element = std::make_shared<vehicle::SwitchedContact>(built.full.back(), from_table, stretch_of(file, wheel));
    } else {
      built.full.push_back(nullptr);
      built.bodies.emplace_back();
      on.element = from_table;
    }
    on.element = mounted(on.element, i);
  }
  v.connect();
  const bool any_full = ranges::any_of(
      file.wheels, [](const io::WheelContactInput& wheel) { return wheel.model == io::ContactModelInput::full; });
  const auto easy_start = [&]() -> std::optional<vehicle::VehicleOnTrack> {
    try {
      if (!ranges::all_of(file.wheels, [&](const io::WheelContactInput& wheel) {
            return builder.has_section(wheel.side, file.wheel_radius(wheel.wheelset));
          }))
        return std::nullopt;
      lay_rails();
      vehicle::VehicleOnTrack easy = v;
      for (std::size_t i = 0; i < v.wheels.size(); ++i) easy.wheels[i].element = mounted(tabulated(file.wheels[i]), i);
      return easy;
    } catch (const Error&) {  // full contacts do without
      return std::nullopt;
    }
  };
  // Tables are made of what files name: of a shape put in its place they would know nothing.
  if (any_full && v.line && v.line->point(0.0).curvature.value != 0.0 && !store.replaced()) built.easy = easy_start();
  const bool fields = !file.fields.pitch.empty() || !file.fields.position.empty();
  std::map<double, std::shared_ptr<const DefectDepth>> depths;  // by radius
  for (const io::WheelContactInput& wheel : file.wheels) {
    auto& depth = built.defect_depth.emplace_back();
    if (!fields || wheel.model != io::ContactModelInput::full || !wheel.defects) continue;
    const auto [of_radius, is_new] = depths.try_emplace(file.wheel_radius(wheel.wheelset));
    if (is_new) of_radius->second = builder.defect_depth(of_radius->first);
    depth = of_radius->second;
  }
  return built;
}

std::vector<io::HistoryColumn> history_columns(const io::SimulationFile& file) {
  return HistoryRecord::columns_of(file, outline(file, false));
}

void check_vehicle(const io::SimulationFile& file, SurfaceStore& store) {
  ContactTables none;
  Builder builder(file, store, none);
  const vehicle::VehicleOnTrack vehicle = outline(file, false);
  if (file.flexible_track) RailsBelow(file, vehicle.system).below({0});
  for (const io::WheelContactInput& wheel : file.wheels) {
    const bool full = has_full(wheel);
    const auto table = [&] { return builder.table_geometry(wheel.side, file.wheel_radius(wheel.wheelset)); };
    const wheelrail::Geometry geometry = full ? builder.full_geometry(wheel) : table();
    if (full && has_table(wheel)) table();
    if (has_table(wheel)) builder.require_creep_table();
    builder.require_section(wheel);
    vehicle::rail_marker_at_rest(geometry, to_problem(contact_input(file, wheel), geometry.round_wheel));
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
      ranges::any_of(file.wheels, [](const auto& w) { return w.model == io::ContactModelInput::full; });
  constexpr double kNoLimit = 0.1;  // [m]
  out.max_travel = any_full ? full_travel(file) : kNoLimit;
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
