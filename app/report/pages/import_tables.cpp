// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/import_tables.hpp"

#include "treadmark/app/report/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::app::report {
namespace {

constexpr double kSquare = 1e6, kCube = 1e9;  // m^2 to mm^2, m^3 to mm^3

Number whole(std::size_t count) { return {static_cast<double>(count), 12}; }

/// A number in the unit of its factor, with the digits of report.json.
Number shown_in(double factor, double value, int digits = 4) { return {in_file(factor * value), digits}; }
Number length_in(double value, int digits = 4) { return shown_in(kMilli, value, digits); }

/// Place along the band: degrees of a wheel, mm of a rail.
Column along_column(const io::ImportReport& report) {
  return report.body == Body::wheel ? Column{"angle", "°"} : Column{"x", "mm"};
}
Number along(const io::ImportReport& report, double u) {
  return shown_in(report.body == Body::wheel ? 180.0 / kPi : kMilli, u, 6);
}

}  // namespace

Table input_table(const io::ImportReport& report) {
  Table table{"inputs", "Files that were read.", {{"file"}, {"format"}, {"points"}, {"not finite"}, {"SHA-256"}}};
  for (const auto& input : report.inputs)
    table.rows.push_back({{input.file, input.format, whole(input.points), whole(input.not_finite), input.sha256}});
  return table;
}

Table removed_table(const io::ImportReport& report) {
  Table table{"removed",
              "Points that are not in the surface, in the order of the steps.",
              {{"reason"}, {"points"}, {"of all", "%"}, {"rule"}}};
  const double all = static_cast<double>(report.points_read);
  for (const auto& [reason, count, why] : io::removed_by_reason(report)) {
    const double points = static_cast<double>(count);
    table.rows.push_back({{reason, Number{points, 12}, Number{all > 0.0 ? 100.0 * points / all : 0.0, 3}, why}});
  }
  return table;
}

Table hole_table(const io::ImportReport& report) {
  Table table{"holes",
              "Places without points, largest first.",
              {along_column(report), {"y", "mm"}, {"s", "mm"}, {"diameter", "mm"}, {"area", "mm²"}, {"filled"}}};
  for (const auto& hole : report.holes)
    table.rows.push_back({{along(report, hole.u), length_in(hole.y), length_in(hole.s), length_in(hole.diameter, 3),
                           shown_in(kSquare, hole.area, 3), std::string(hole.filled ? "by the fit" : "stays open")}});
  return table;
}

Table damage_table(const io::ImportReport& report) {
  Table table{"damage",
              "Damage, largest first. Negative depths and volumes stand out of the surface.",
              {{"number"},
               along_column(report),
               {"y", "mm"},
               {"s", "mm"},
               {"length", "mm"},
               {"width", "mm"},
               {"depth", "mm"},
               {"missing volume", "mm³"}}};
  for (const auto& part : report.damage)
    table.rows.push_back({{Number{static_cast<double>(table.rows.size() + 1)}, along(report, part.u), length_in(part.y),
                           length_in(part.s), length_in(part.length), length_in(part.width), length_in(part.depth),
                           shown_in(kCube, part.volume)}});
  return table;
}

Table pass_table(const io::ImportReport& report) {
  Table table{"passes",
              "Passes and what they were moved by, in the axes of the surface.",
              {{"pass"},
               {"points"},
               {"shift x", "mm"},
               {"shift y", "mm"},
               {"shift z", "mm"},
               {"turn x", "mrad"},
               {"turn y", "mrad"},
               {"turn z", "mrad"}}};
  for (const auto& pass : report.passes) {
    Table::Row row{{Number{static_cast<double>(pass.pass), 12}, whole(pass.points)}};
    for (const Vec3& vector : {pass.shift_S, pass.turn_S})
      for (const double value : vector) row.cells.emplace_back(length_in(value, 3));  // or mrad
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table level_table(const io::ImportReport& report) {
  Table table{"levels",
              "The sum of splines, from coarse to fine along and across. Functions are used only where the points call "
              "for them.",
              {{"knots along", "mm"}, {"knots across", "mm"}, {"functions"}, {"used"}, {"iterations"}}};
  for (const auto& level : report.levels)
    table.rows.push_back({{length_in(level.knot_a), length_in(level.knot_s), whole(level.functions), whole(level.used),
                           Number{static_cast<double>(level.iterations), 12}}});
  return table;
}

Table output_table(const io::ImportReport& report) {
  Table table{"outputs",
              "Surfaces that were written, read back and compared with the fitted one.",
              {{"file"},
               {"kind"},
               {"content"},
               {"size", "bytes"},
               {"largest distance", "µm"},
               {"rms distance", "µm"},
               {"SHA-256"}}};
  for (const auto& output : report.outputs)
    table.rows.push_back(
        {{output.file, output.kind, output.details, whole(output.bytes), shown_in(kMicro, output.height_max, 3),
          shown_in(kMicro, output.height_rms, 3), output.sha256}});
  return table;
}

Table step_table(const io::ImportReport& report) {
  Table table{"steps", "Steps and their wall-clock times.", {{"step"}, {"time", "s"}}};
  for (const auto& step : report.steps) table.rows.push_back({{step.name, shown_in(1.0, step.seconds, 3)}});
  return table;
}

}  // namespace treadmark::app::report
