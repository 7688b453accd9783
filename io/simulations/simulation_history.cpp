// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {
namespace {

template <class Kind, std::size_t count>
Kind kind_of(const std::array<std::string_view, count>& names, const std::string& name) {
  return static_cast<Kind>(std::ranges::find(names, name) - names.begin());
}

PointInput read_point(const TableReader& table, const VehicleModel& vehicle) {
  PointInput point;
  point.name = table.text("name");
  const auto letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  if (point.name.empty() || !std::ranges::all_of(point.name, letter))
    throw Error(ErrorKind::configuration, fmt::format("'{}' cannot be the name of a point", point.name),
                table.need("name").where, "use letters, digits, _ and -");
  point.kind = kind_of<PointKind>(kPointKinds, table.text_or("kind", std::string(kPointKinds[0])));
  point.body = table.text("body");
  std::vector<std::string> bodies;
  for (const BodySpec& body : vehicle.bodies) bodies.push_back(body.name);
  check_name("body", point.body, bodies, table.need("body").where);
  table.need("at_m");
  point.arm = *table.triple("at_m") - std::ranges::find(vehicle.bodies, point.body, &BodySpec::name)->position;
  return point;
}

}  // namespace

void read_history(const TableReader& simulation, SimulationFile& out) {
  out.history.axle_box_y = simulation.number_or("axle_box_y_mm", out.history.axle_box_y);
  out.history.gravity = out.settings.gravity;
  out.history.channels = simulation.words("channels");
  if (const CaseValue* channels = simulation.find("channels")) out.history.channels_where = channels->where;
  std::set<std::string> names;
  for (const CaseValue* one : simulation.tables("points")) {
    const TableReader table(one->table(), one->where, simulation.path_of("points"), point_keys());
    out.history.points.push_back(read_point(table, out.vehicle));
    const PointInput& point = out.history.points.back();
    if (!names.insert(point.name).second) table.fail(fmt::format("two points have the name {}", point.name));
  }
}

void read_assessment(const TableReader& assessment, SimulationFile& out) {
  AssessmentRequest& request = out.assessment.emplace();
  request.vehicle = kind_of<VehicleKind>(kVehicleKinds, assessment.text_or("vehicle", "passenger"));
  request.from = assessment.number_or("from_m", 0.0);
  if (out.irregularities && assessment.find("from_m") == nullptr && assessment.tables("sections").empty()) {
    // where the last wheelset has left the wind-up behind
    const IrregularitySpec& rails = *out.irregularities;
    request.from = std::max(0.0, rails.begin + rails.wind_up - out.start - wheelset_places(out.vehicle).from);
    if (request.from >= out.settings.distance)
      assessment.fail(
          fmt::format("the irregularities have grown to their size at {:.6g} m only, where the run of {:.6g} "
                      "m is over",
                      request.from, out.settings.distance),
          "lengthen the run, or say where the assessment begins (assessment.from_m)");
  }
  request.spectra = assessment.words("spectra");
  const double end = out.settings.distance;
  const auto beyond = [&](const TableReader& table, const char* key) {
    throw Error(ErrorKind::configuration,
                fmt::format("{} = {:.6g}: the run ends at {:.6g} m", table.path_of(key), table.number(key), end),
                table.need(key).where, "distances count from the start of the run");
  };
  if (request.from >= end) beyond(assessment, "from_m");
  std::set<std::string> names;
  for (const CaseValue* one : assessment.tables("sections")) {
    const TableReader table(one->table(), one->where, assessment.path_of("sections"), section_keys());
    AssessmentSection section{table.text("name"), table.number("from_m"), table.number("to_m"),
                              kind_of<SectionKind>(kSectionKinds, table.text_or("kind", "straight"))};
    if (section.name.empty() || !names.insert(section.name).second)
      throw Error(ErrorKind::configuration, fmt::format("'{}' is no name of its own for a section", section.name),
                  table.need("name").where);
    if (section.from >= section.to)
      throw Error(ErrorKind::configuration,
                  fmt::format("a section from {:.6g} to {:.6g} m is none", section.from, section.to),
                  table.need("to_m").where);
    constexpr double kSlack = 1e-9;
    if (section.to > end * (1.0 + kSlack)) beyond(table, "to_m");
    request.sections.push_back(std::move(section));
  }
}

}  // namespace treadmark::io
