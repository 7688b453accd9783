// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/import_tables.hpp"

#include <limits>

namespace treadmark::app::report {
namespace {

Number whole(const JsonTree& node, const char* key) { return {static_cast<double>(node.count(key)), 12}; }

/// Place along the band: degrees of a wheel, mm of a rail.
Column along_column(const JsonTree& report) {
  return report.text("body") == "wheel" ? Column{"angle", "°"} : Column{"x", "mm"};
}
Number along(const JsonTree& report, const JsonTree& node) {
  return {node.number(report.text("body") == "wheel" ? "u_deg" : "u_mm"), 6};
}

}  // namespace

Table input_table(const JsonTree& report) {
  Table table{"inputs", "Files that were read.", {{"file"}, {"format"}, {"points"}, {"not finite"}, {"SHA-256"}}};
  for (const JsonTree& input : report.at("inputs").items())
    table.rows.push_back({{input.text("file"), input.text("format"), whole(input, "points"), whole(input, "not_finite"),
                           input.text("sha256")}});
  return table;
}

Table removed_table(const JsonTree& report) {
  Table table{"removed",
              "Points that are not in the surface, in the order of the steps.",
              {{"reason"}, {"points"}, {"of all", "%"}, {"rule"}}};
  const double all = static_cast<double>(report.count("points_read"));
  const JsonTree why = report.at("removed_why");
  for (const auto& [reason, count] : report.at("removed").entries()) {
    const double points = static_cast<double>(count.count());
    table.rows.push_back(
        {{reason, Number{points, 12}, Number{all > 0.0 ? 100.0 * points / all : 0.0, 3}, why.text(reason)}});
  }
  return table;
}

Table hole_table(const JsonTree& report) {
  Table table{"holes",
              "Places without points, largest first.",
              {along_column(report), {"y", "mm"}, {"s", "mm"}, {"diameter", "mm"}, {"area", "mm²"}, {"filled"}}};
  for (const JsonTree& hole : report.at("coverage").at("holes").items())
    table.rows.push_back({{along(report, hole), Number{hole.number("y_mm")}, Number{hole.number("s_mm")},
                           Number{hole.number("diameter_mm"), 3}, Number{hole.number("area_mm2"), 3},
                           std::string(hole.flag("filled") ? "by the fit" : "stays open")}});
  return table;
}

Table damage_table(const JsonTree& report) {
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
  double number = 0.0;
  for (const JsonTree& part : report.at("damage").items()) {
    number += 1.0;
    table.rows.push_back(
        {{Number{number}, along(report, part), Number{part.number("y_mm")}, Number{part.number("s_mm")},
          Number{part.number("length_mm")}, Number{part.number("width_mm")}, Number{part.number("depth_mm")},
          Number{part.number("volume_mm3")}}});
  }
  return table;
}

Table pass_table(const JsonTree& frame) {
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
  for (const JsonTree& pass : frame.at("passes").items()) {
    Table::Row row{{whole(pass, "pass"), whole(pass, "points")}};
    for (const char* key : {"shift_mm", "turn_mrad"})
      for (const double value : pass.at(key).numbers()) row.cells.emplace_back(Number{value, 3});
    row.cells.resize(table.columns.size(), Number{std::numeric_limits<double>::quiet_NaN()});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table level_table(const JsonTree& report) {
  Table table{"levels",
              "The sum of splines, from coarse to fine along and across. Functions are used only where the points call "
              "for them.",
              {{"knots along", "mm"}, {"knots across", "mm"}, {"functions"}, {"used"}, {"iterations"}}};
  for (const JsonTree& level : report.at("fit").at("levels").items())
    table.rows.push_back({{Number{level.number("knot_a_mm")}, Number{level.number("knot_s_mm")},
                           whole(level, "functions"), whole(level, "used"), whole(level, "iterations")}});
  return table;
}

Table output_table(const JsonTree& report) {
  Table table{"outputs",
              "Surfaces that were written, read back and compared with the fitted one.",
              {{"file"},
               {"kind"},
               {"content"},
               {"size", "bytes"},
               {"largest distance", "µm"},
               {"rms distance", "µm"},
               {"SHA-256"}}};
  for (const JsonTree& output : report.at("outputs").items())
    table.rows.push_back({{output.text("file"), output.text("kind"), output.text("details"), whole(output, "bytes"),
                           Number{output.number("height_max_um"), 3}, Number{output.number("height_rms_um"), 3},
                           output.text("sha256")}});
  return table;
}

Table step_table(const JsonTree& times) {
  Table table{"steps", "Steps and their wall-clock times.", {{"step"}, {"time", "s"}}};
  for (const JsonTree& step : times.at("steps").items())
    table.rows.push_back({{step.text("step"), Number{step.number("seconds"), 3}}});
  return table;
}

}  // namespace treadmark::app::report
