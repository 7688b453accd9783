// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/text_of.hpp"

namespace treadmark::app {
namespace {

using geometry::Conicity;
using geometry::Position;
using geometry::WheelsetOnTrack;

constexpr std::size_t kLabels = 24;  // room for them on the terminal

std::string load_text(const geometry::LoadedFunctions& f) {
  return io::lines_of(f, kLabels) + io::text_line("  right", kLabels, io::phrase_of(f.at_middle.right)) +
         io::text_line("  left", kLabels, io::phrase_of(f.at_middle.left));
}

std::string sweep_text(const GaugeSweep& sweep) {
  std::string out = fmt::format("{:>12}{:>14}\n", "gauge mm", "at 3 mm");
  for (std::size_t g = 0; g < sweep.gauges.size(); ++g)
    out += fmt::format("{:>12.6g}{:>14}{}\n", kMilli * sweep.gauges[g],
                       sweep.trouble[g].empty() ? io::shown_number(sweep.at_3mm[g].tan_gamma, 4) : "-",
                       sweep.trouble[g].empty() ? "" : "  " + sweep.trouble[g]);
  return out;
}

}  // namespace

std::string functions_csv(const GeometryResult& result) {
  const geometry::AnalysisSettings& settings = result.request.settings;
  const WheelsetOnTrack wheelset =
      geometry::place(result.right, result.left, result.placement, settings.roll, settings.yaw);
  const std::vector<Position>& rows = result.analysis.functions.rows;
  std::string out;
  const auto end_line = [&] { out.back() = '\n'; };
  io::add_heads<FunctionRow>(out);
  if (result.load) io::add_heads<geometry::LoadedPosition>(out);
  end_line();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    io::add_cells(out, FunctionRow{rows[i], wheelset});
    if (result.load) io::add_cells(out, result.load->rows[i]);
    end_line();
  }
  return out;
}

std::string conicity_csv(const GeometryResult& result) { return io::csv_of(conicity_rows(result.analysis, &result)); }

std::string sweep_csv(const GaugeSweep& sweep) {
  std::string out = "gauge_mm,amplitude_mm,tan_gamma_e,reason\n";
  for (std::size_t g = 0; g < sweep.gauges.size(); ++g) {
    if (!sweep.trouble[g].empty())
      out += fmt::format("{},,,{}\n", io::csv_cell(kMilli * sweep.gauges[g]), io::csv_cell(sweep.trouble[g]));
    for (const Conicity& c : sweep.conicity[g])
      out += fmt::format("{},{},{},{}\n", io::csv_cell(kMilli * sweep.gauges[g]), io::csv_cell(kMilli * c.amplitude),
                         io::csv_cell(c.tan_gamma), io::csv_cell(c.reason));
  }
  return out;
}

std::string geometry_text(const GeometryResult& result) {
  const geometry::ContactFunctions& f = result.analysis.functions;
  const auto end = [](const char* name, const geometry::ShiftLimit& limit) {
    return io::text_line(name, kLabels,
                         fmt::format("{:.2f} mm{}", kMilli * limit.y, limit.limited ? ": then " + limit.reason : ""));
  };
  std::string out = io::lines_of(result, kLabels);
  out += end("displacement left", f.to_left) + end("displacement right", f.to_right);
  if (const auto& fresh = result.with_new) {
    const GeometryRequest& r = result.request;
    out += io::text_line("with new profiles", kLabels,
                         fmt::format("{} at 3 mm ({})", io::shown_number(fresh->at_3mm.tan_gamma, 4),
                                     r.new_wheel.empty() || r.new_rail.empty() ? r.new_wheel + r.new_rail
                                                                               : r.new_wheel + " on " + r.new_rail));
  }
  if (result.load) out += load_text(*result.load);
  if (!f.jumps.empty()) out += "jumps of contact points\n" + io::table_of(f.jumps);
  if (!result.analysis.conicity.empty()) out += "conicity\n" + io::table_of(conicity_rows(result.analysis, &result));
  if (result.sweep) out += sweep_text(*result.sweep);
  return out;
}

}  // namespace treadmark::app
