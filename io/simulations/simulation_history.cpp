// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_limits.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {
namespace {

PointInput read_point(const TableOf<PointInput>& table, const VehicleModel& vehicle) {
  PointInput point = table.read();
  const auto letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  if (point.name.empty() || !ranges::all_of(point.name, letter))
    table.refuse(&PointInput::name, fmt::format("'{}' cannot be the name of a point", point.name),
                 "use letters, digits, _ and -");
  std::vector<std::string> bodies;
  for (const BodySpec& body : vehicle.bodies) bodies.push_back(body.name);
  check_name("body", point.body, bodies, table.need(&PointInput::body).where);
  point.arm -= ranges::find(vehicle.bodies, point.body, &BodySpec::name)->position;
  return point;
}

}  // namespace

void read_history(const SimulationTable& simulation, SimulationFile& out) {
  out.history.gravity = out.settings.gravity;
  const auto channels = [](const SimulationFile& f) -> auto& { return f.history.channels; };
  if (const CaseValue* given = simulation.find(channels)) out.history.channels_where = given->where;
  const auto points = [](const SimulationFile& f) -> auto& { return f.history.points; };
  std::set<std::string> names;
  for (const CaseValue* one : simulation.tables(points)) {
    const TableOf table(*one, simulation.path_of(points), point_keys());
    out.history.points.push_back(read_point(table, out.vehicle));
    const PointInput& point = out.history.points.back();
    if (!names.insert(point.name).second) table.fail(fmt::format("two points have the name {}", point.name));
  }
}

void read_assessment(const TableOf<AssessmentRequest>& assessment, const std::filesystem::path& folder,
                     SimulationFile& out) {
  using A = AssessmentRequest;
  using S = AssessmentSection;
  A& request = out.assessment.emplace(assessment.read());
  if (assessment.find(&A::limits) != nullptr) {
    const FileText limits = named_text(assessment, assessment.key(&A::limits), folder);
    request.limits = parse_limits_text(limits.text, limits.file.path.string());
  }
  if (out.irregularities && assessment.find(&A::from) == nullptr && assessment.tables(&A::sections).empty()) {
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
  const double end = out.settings.distance;
  const auto beyond = [&](const auto& table, auto member, double place) {
    table.refuse(member, fmt::format("{} = {:.6g}: the run ends at {:.6g} m", table.path_of(member), place, end),
                 "distances count from the start of the run");
  };
  if (request.from >= end) beyond(assessment, &A::from, request.from);
  std::set<std::string> names;
  for (const CaseValue* one : assessment.tables(&A::sections)) {
    const TableOf table(*one, assessment.path_of(&A::sections), section_keys());
    S section = table.read();
    if (section.name.empty() || !names.insert(section.name).second)
      table.refuse(&S::name, fmt::format("'{}' is no name of its own for a section", section.name));
    if (section.from >= section.to)
      table.refuse(&S::to, fmt::format("a section from {:.6g} to {:.6g} m is none", section.from, section.to));
    constexpr double kSlack = 1e-9;
    if (section.to > end * (1.0 + kSlack)) beyond(table, &S::to, section.to);
    request.sections.push_back(std::move(section));
  }
}

}  // namespace treadmark::io
