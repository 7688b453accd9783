// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/tables/csv_of.hpp"

namespace treadmark::app {
namespace {

using geometry::Conicity;
using geometry::Position;
using geometry::WheelsetOnTrack;

/// A number for the terminal; a dash where there is none.
std::string shown(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("-");
}

std::string load_text(const geometry::LoadedFunctions& f) {
  constexpr double kKilo = 1e-3;
  const auto doubts = [](const geometry::LoadedSide& side) {
    return fmt::format("misfit {:.0f} %{}", 100.0 * side.misfit, side.shared ? ", shared by a second contact" : "");
  };
  std::string out =
      fmt::format("{:<22}{:g} kN; at y = {:.3f} mm, holding force {} kN\n", "axle load", kKilo * f.load.weight,
                  kMilli * f.middle, shown(std::round(f.at_middle.holding_force) * kKilo + 0.0, 3));
  for (const bool right : {true, false}) {
    const geometry::LoadedSide& side = right ? f.at_middle.right : f.at_middle.left;
    out += fmt::format("{:<22}normal force {} kN, ", right ? "  right" : "  left", shown(kKilo * side.normal_force, 2));
    out += side.reason.empty()
               ? fmt::format("largest pressure {:.0f} MPa, ellipse {:.2f} by {:.2f} mm, approach {:.1f} um, {}\n",
                             kMega * side.pressure, 2.0 * kMilli * side.semi_axis_x, 2.0 * kMilli * side.semi_axis_y,
                             kMicro * side.approach, doubts(side))
               : "no pressure: " + side.reason + "\n";
  }
  if (std::isnan(f.largest_y)) return out;
  return out + fmt::format("{:<22}{:.0f} MPa within {:.3g} mm of that displacement: {} side at y = {:.2f} mm, {}\n",
                           "largest pressure", kMega * f.largest.pressure, kMilli * f.amplitude,
                           f.largest_right ? "right" : "left", kMilli * f.largest_y, doubts(f.largest));
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

std::string conicity_csv(const GeometryResult& result) {
  const geometry::Analysis& a = result.analysis;
  std::string out = "amplitude_mm,tan_gamma_e,noise,harmonic,wavelength_mm,turns_left_mm,turns_right_mm,reason\n";
  for (std::size_t i = 0; i < a.conicity.size(); ++i) {
    const Conicity& c = a.conicity[i];
    const double wave = geometry::wavelength(c.tan_gamma, a.wheel_origins, 0.5 * (a.radius_right + a.radius_left));
    out += fmt::format("{},{},{},{},{},{},{},{}\n", io::csv_cell(kMilli * c.amplitude), io::csv_cell(c.tan_gamma),
                       result.noise ? io::csv_cell(result.noise->of_amplitude[i]) : "",
                       a.harmonic.empty() ? "" : io::csv_cell(a.harmonic[i]),
                       std::isfinite(wave) ? io::csv_cell(kMilli * wave) : "", io::csv_cell(kMilli * c.low),
                       io::csv_cell(kMilli * c.high), io::csv_cell(c.reason));
  }
  return out;
}

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

std::string sweep_text(const GaugeSweep& sweep) {
  std::string out = fmt::format("{:>12}{:>14}\n", "gauge mm", "at 3 mm");
  for (std::size_t g = 0; g < sweep.gauges.size(); ++g)
    out += fmt::format("{:>12.6g}{:>14}{}\n", kMilli * sweep.gauges[g],
                       shown(sweep.trouble[g].empty() ? sweep.at_3mm[g].tan_gamma : kNaN, 4),
                       sweep.trouble[g].empty() ? "" : "  " + sweep.trouble[g]);
  return out;
}

std::string geometry_text(const GeometryResult& result) {
  const geometry::Analysis& a = result.analysis;
  const GeometryRequest& r = result.request;
  std::string out;
  const auto line = [&](const char* name, const std::string& value) { out += fmt::format("{:<22}{}\n", name, value); };
  const auto both = [](const std::string& right, const std::string& left) {
    return left.empty() || left == right ? right : fmt::format("{} right, {} left", right, left);
  };
  line("wheels", both(r.wheel, r.wheel_left));
  line("rails", both(r.rail, r.rail_left));
  line("diameters", fmt::format("{:.2f} mm right, {:.2f} mm left", 2e3 * a.radius_right, 2e3 * a.radius_left));
  line("gauge", fmt::format("{} mm, active faces {} mm, clearance {} mm", shown(kMilli * a.gauge, 3),
                            shown(kMilli * a.active_faces, 3), shown(kMilli * (a.gauge - a.active_faces), 3)));
  const auto end = [](const geometry::ShiftLimit& limit) {
    return fmt::format("{:.2f} mm{}", kMilli * limit.y, limit.limited ? ": then " + limit.reason : std::string());
  };
  line("displacement left", end(a.functions.to_left));
  line("displacement right", end(a.functions.to_right));
  line("equilibrium", a.equilibrium ? fmt::format("y = {:.3f} mm", kMilli * *a.equilibrium) : a.no_equilibrium);
  for (const geometry::Jump& jump : a.functions.jumps) {
    const geometry::Touch &before = jump.right ? jump.before.right : jump.before.left,
                          &after = jump.right ? jump.after.right : jump.after.left;
    line("jump",
         fmt::format("y = {:.4f} mm, {}: from {:.2f} to {:.2f} mm on the rail, delta r from {:.3f} to {:.3f} mm",
                     kMilli * jump.before.y, jump.right ? "right" : "left", kMilli * before.rail_y,
                     kMilli * after.rail_y, kMilli * jump.before.radius_difference(),
                     kMilli * jump.after.radius_difference()));
  }
  line("conicity", fmt::format("{} at {:.3g} mm ({}){}", shown(a.single.tan_gamma, 4), kMilli * a.single.amplitude,
                               a.rule, a.single.reason.empty() ? "" : ", " + a.single.reason));
  line("conicity at 3 mm", shown(a.at_3mm.tan_gamma, 4));
  if (result.noise)
    line("  from noise",
         fmt::format("+-{} at {:.3g} mm, +-{} at 3 mm (standard deviations)", shown(result.noise->single, 4),
                     kMilli * a.single.amplitude, shown(result.noise->at_3mm, 4)));
  if (result.with_new)
    line("with new profiles",
         fmt::format(
             "{} at 3 mm ({})", shown(result.with_new->at_3mm.tan_gamma, 4),
             r.new_wheel.empty() || r.new_rail.empty() ? r.new_wheel + r.new_rail : r.new_wheel + " on " + r.new_rail));
  line("nonlinearity", shown(kMillimetre * a.nonlinearity, 5) + " 1/mm");
  line("contact spread", fmt::format("rail {} mm, wheel {} mm for 3 mm to both sides", shown(kMilli * a.spread.rail, 2),
                                     shown(kMilli * a.spread.wheel, 2)));
  line("steers to", fmt::format("{} m radius, delta r {} mm before the flange", shown(a.steering.smallest_radius, 0),
                                shown(kMilli * a.steering.largest_difference, 3)));
  line("stiffness by gravity", fmt::format("{} N/mm per kN of axle load", shown(a.gravitational_stiffness, 4)));
  if (result.load) out += load_text(*result.load);
  if (a.conicity.empty()) return out;
  out += fmt::format("{:>12}{:>14}{:>12}{:>14}\n", "amplitude mm", "tan gamma_e", "harmonic", "wavelength m");
  if (result.with_new) out.insert(out.size() - 1, fmt::format("{:>14}", "new profiles"));
  for (std::size_t i = 0; i < a.conicity.size(); ++i) {
    const Conicity& c = a.conicity[i];
    out += fmt::format(
        "{:>12.4g}{:>14}{:>12}{:>14}{}{}\n", kMilli * c.amplitude, shown(c.tan_gamma, 4),
        a.harmonic.empty() ? "-" : shown(a.harmonic[i], 4),
        shown(geometry::wavelength(c.tan_gamma, a.wheel_origins, 0.5 * (a.radius_right + a.radius_left)), 2),
        result.with_new ? fmt::format("{:>14}", shown(result.with_new->conicity[i].tan_gamma, 4)) : std::string(),
        c.reason.empty() ? "" : "  " + c.reason);
  }
  return out;
}

}  // namespace treadmark::app
