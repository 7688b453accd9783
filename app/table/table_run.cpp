// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/simulation/kept_tables.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/app/table/force_tables.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/text_of.hpp"

namespace treadmark::app {
namespace {

/// The case's pair as tables know it, a right-hand one.
wheelrail::Problem prototype_of(const io::WheelRailCase& given) {
  wheelrail::Problem p = to_problem(given, true);
  p.side = wheelrail::Side::right;
  return p;
}

double load_of(const io::WheelRailCase& given, const TableRequest& request) {
  if (request.load) return *request.load;
  if (given.vertical_force_prescribed && given.vertical_force > 0.0) return given.vertical_force;
  throw Error(ErrorKind::configuration, "the case prescribes no vertical force, about which the loads of a table lie",
              {}, "give wheelset.vertical_force_N in the case, or load_kN");
}

TableHead head_of(const vehicle::ContactTable& table, const TableRequest& request, double load) {
  const wheelrail::Placement& nominal = table.nominal();
  TableHead h;
  h.load = load;
  h.roll_most = request.axes.roll.most, h.roll_intervals = request.axes.roll.intervals;
  h.yaw_most = request.axes.yaw.most, h.yaw_intervals = request.axes.yaw.intervals;
  h.element_size = request.axes.element_size;
  h.rail_y = nominal.X_TR.origin.y(), h.rail_z = nominal.X_TR.origin.z();
  h.rail_roll = roll_yaw_pitch(nominal.X_TR.rotation).roll;
  h.wheelset_z = nominal.X_TWs.origin.z();
  h.wheel_y = nominal.X_TW.origin.y(), h.wheel_z = nominal.X_TW.origin.z();
  h.points = request.check.points, h.speed = request.check.speed, h.creepage = request.check.creepage;
  h.creep_forces = request.exact_creep ? "exact_table" : "linear";
  return h;
}

/// In the order of the sheets.
std::vector<TableNode> nodes_of(const std::vector<vehicle::ContactTableColumns>& sheets, const TableRequest& request,
                                double load) {
  const std::vector<vehicle::TableTurn> turns = vehicle::table_turns(request.axes.roll, request.axes.yaw);
  std::vector<TableNode> nodes;
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (const vehicle::ContactTableColumn& column : sheets[i])
      for (std::size_t k = 0; k < column.under.size(); ++k) {
        vehicle::ContactUnderLoad contact = column.under[k];
        contact.parts.clear();
        for (const vehicle::ContactPart& part : column.under[k].parts)
          nodes.push_back(
              {turns[i].roll, turns[i].yaw, column.y, load * request.axes.relative_loads[k], contact, part});
      }
  return nodes;
}

}  // namespace

MadeTable make_table(const io::Case& given, const wheelrail::Geometry& geometry, const TableRequest& request,
                     const io::ContentCache* cache, const Progress& progress) {
  const auto* pair = std::get_if<io::WheelRailCase>(&given.content);
  if (!pair) throw Error(ErrorKind::configuration, "a table of forces is that of a wheel on a rail, not of a patch");
  if (pair->friction_variation.kind == io::FrictionVariation::Kind::along_track)
    throw Error(ErrorKind::configuration,
                "friction varies along the track (friction.along_track), of which a table of forces knows no place",
                given.where, "give one law, or one by inclination of the rail");
  const wheelrail::Problem prototype = prototype_of(*pair);
  const double load = load_of(*pair, request);
  vehicle::require_sensible(request.check);
  if (request.exact_creep) vehicle::require_tabulated(prototype.material);  // refused before anything takes long
  const auto sheets = vehicle::solve_contact_sheets(geometry, prototype, load, request.axes, progress);
  const auto contact = vehicle::contact_table_of(sheets, geometry, prototype, load, request.axes);
  std::shared_ptr<const vehicle::CreepTable> creep;
  if (request.exact_creep)
    creep = kept_creep_table(cache, combine(prototype.material).poisson, request.creep,
                             [&](std::size_t finished, std::size_t all) {
                               if (progress.report) progress.report(finished, all, "table of creep forces");
                             });
  MadeTable made{{},
                 given,
                 head_of(*contact, request, load),
                 nodes_of(sheets, request, load),
                 vehicle::ForceTable(contact, pair->side, creep)};
  made.table.keep(vehicle::check_table(made.table, geometry, prototype, request.check, progress));
  return made;
}

MadeTable make_table(const std::filesystem::path& case_file, const TableRequest& request, const io::ContentCache* cache,
                     const Progress& progress) {
  const io::CaseFile file = read_registered_case(case_file.string(), request.overrides);
  const auto found = ranges::find_if(
      file.cases, [](const io::Case& c) { return std::holds_alternative<io::WheelRailCase>(c.content); });
  if (found == file.cases.end())
    throw Error(ErrorKind::configuration, "there is no wheel on a rail in this file", {case_file.string(), 0, 0});
  const auto& pair = std::get<io::WheelRailCase>(found->content);
  SurfaceStore store;
  const StoredSurface& rail = store.get(pair.rail, Body::rail, profile_radius(pair, Body::rail), Region{});
  const StoredSurface& wheel = store.get(pair.wheel, Body::wheel, profile_radius(pair, Body::wheel), Region{});
  MadeTable made = make_table(*found,
                              {rail.represented.surface, wheel.represented.surface,
                               rail.constant_profile() && !pair.roller, wheel.constant_profile()},
                              request, cache, progress);
  made.title = file.title;
  return made;
}

std::string table_text(const MadeTable& made) {
  const vehicle::ContactTable& t = made.table.contact();
  const auto angles = [](const vehicle::TableAngles& a) {
    return fmt::format("-{0:.4g} to {0:.4g} mrad{1}", kMilli * a.reach(), a.intervals == 0 ? ", to first order" : "");
  };
  constexpr std::size_t kWidth = 28;
  std::string out = io::text_line("lateral place", kWidth,
                                  fmt::format("{:.4g} to {:.4g} mm", kMilli * t.y_min(), kMilli * t.y_max()));
  out += io::text_line("roll of wheel on rail", kWidth, angles(t.roll()));
  out += io::text_line("yaw", kWidth, angles(t.yaw()));
  out += io::text_line("loads up to", kWidth, fmt::format("{:.4g} kN", 1e-3 * t.most_load()));
  out += io::lines_of(made.head, kWidth);
  if (const auto& check = made.table.check())
    out += io::lines_of(*check, kWidth) + "\nerrors against the exact theory\n" + io::table_of(check->errors);
  return out;
}

std::string table_json(const MadeTable& made) {
  const vehicle::ContactTable& t = made.table.contact();
  io::Json out = io::json_of(made.head);
  out["y_min_m"] = io::number(t.y_min()), out["y_max_m"] = io::number(t.y_max());
  out["nodes"] = made.nodes.size();
  if (const auto& check = made.table.check()) {
    out["check"] = io::json_of(*check);
    out["check"]["errors"] = io::json_of(check->errors);
  }
  return io::dumped(out);
}

}  // namespace treadmark::app
