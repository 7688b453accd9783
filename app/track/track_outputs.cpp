// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>
#include <cmath>

#include "treadmark/app/track/track_run.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/simulations/write_track.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/shown.hpp"
#include "treadmark/io/tables/text_of.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark {
namespace {

using Bay = app::TrackResult::Bay;
using access::of;

constexpr FileUnit kHz{"Hz"};

constexpr Column<Bay> kBay[] = {
    {"seats", unit::kOne, "", of<&Bay::seats>()},
    {"bay_m", unit::kM, "", of<&Bay::length>(), "", kInTable, "distance of sleepers"},
    {"pinned_pinned_Hz", kHz, "", of<&Bay::pinned_pinned>(), "by formula", kInTable, "pinned-pinned frequency"},
    {"lateral_pinned_pinned_Hz", kHz, "", of<&Bay::lateral_pinned_pinned>(), "by formula", kInTable,
     "pinned-pinned frequency, lateral"},
    {"peak_Hz", kHz, "", of<&Bay::peak>(), "", kInTable, "most between against over sleepers"},
    {"peak_ratio", unit::kOne, "", of<&Bay::peak_ratio>(), "", kInTable, "  so many times"}};

}  // namespace

template <>
std::span<const Column<Bay>> columns() {
  return kBay;
}

namespace app {
namespace {

using io::Json;

constexpr double kNano = 1e9, kDegreeOfRad = 180.0 / kPi;

std::vector<const TrackCurve*> all_curves(const TrackResult& result) {
  std::vector<const TrackCurve*> all;
  for (const TrackCurve& curve : result.curves) all.push_back(&curve);
  if (result.fitted) all.push_back(&result.fitted->curve);
  for (const TrackCurve& curve : result.lateral) all.push_back(&curve);
  return all;
}

/// The third of an octave, about: every so many frequencies that a table has some 20 lines.
std::vector<std::size_t> table_rows(std::size_t count) {
  constexpr std::size_t kLines = 20;
  std::vector<std::size_t> rows;
  for (std::size_t line = 0; line < kLines; ++line)
    if (const std::size_t row = line * (count - 1) / (kLines - 1); rows.empty() || row != rows.back())
      rows.push_back(row);
  return rows;
}

std::vector<double> magnitudes_in(const TrackCurve& curve) {
  std::vector<double> all;
  for (const auto& value : curve.receptance) all.push_back(std::abs(value));
  return all;
}

std::vector<double> phases_in(const TrackCurve& curve) {
  std::vector<double> all;
  for (const auto& value : curve.receptance) all.push_back(kDegreeOfRad * std::arg(value));
  return all;
}

pictures::Chart chart_over_frequency(const TrackResult& result, const char* title, const char* y, double factor,
                                     std::vector<double> (*values)(const TrackCurve&)) {
  pictures::Chart chart;
  chart.title = title;
  chart.x_label = "frequency [Hz]";
  chart.y_label = y;
  chart.x_scale = pictures::AxisScale::log;
  chart.x_range = {result.frequency.front(), result.frequency.back()};
  int style = 0;
  for (const TrackCurve* curve : all_curves(result)) {
    pictures::ChartSeries series;
    series.name = curve->name;
    series.style = style++;
    series.width = 2.0;
    if (curve->key == "fitted") series.dashes = "5 4";
    const std::vector<double> y_values = values(*curve);
    for (std::size_t i = 0; i < y_values.size(); ++i)
      series.curve.push_back({result.frequency[i], factor * y_values[i]});
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

std::string track_table(const TrackResult& r) {
  constexpr std::size_t kLabels = 36;
  std::string text = fmt::format("{}: {}\n", r.name, r.flexible ? "flexible" : "lumped");
  for (const TrackCurve* curve : all_curves(r))
    if (curve->key != "cross")
      text += io::text_line("stiffness at rest, " + curve->name, kLabels,
                            fmt::format("{:.5g} MN/m", kMega / curve->at_rest));
  if (r.bay) text += io::lines_of(*r.bay, kLabels);
  if (r.fitted) {
    const vehicle::ReceptanceError& e = r.fitted->fit.error;
    text += fmt::format(
        "fit of {} layers to '{}', {:.4g} to {:.4g} Hz: off by {:.2g} (root mean square of the logarithm), at most "
        "{:.2g} at {:.4g} Hz\n",
        r.fitted->fit.layers.size(), r.typical().name, r.frequency.front(), r.frequency.back(), e.rms, e.worst,
        e.worst_frequency);
    for (const vehicle::LumpedLayer& layer : r.fitted->fit.layers)
      text += fmt::format("  {:>9.5g} kg on {:>9.5g} MN/m, {:>9.5g} kN s/m\n", layer.mass, kMega * layer.stiffness,
                          1e-3 * layer.damping);
  }
  std::vector<std::vector<std::string>> lines{{"  f [Hz]"}};
  for (const TrackCurve* curve : all_curves(r)) lines.front().push_back(curve->name);
  for (const std::size_t row : table_rows(r.frequency.size())) {
    lines.push_back({fmt::format("{:>8.5g}", r.frequency[row])});
    for (const TrackCurve* curve : all_curves(r))
      lines.back().push_back(fmt::format("{:>9.4g} {:>7.1f}", kNano * std::abs(curve->receptance[row]),
                                         kDegreeOfRad * std::arg(curve->receptance[row])));
  }
  return text + "receptance [nm/N] and phase [deg]\n" + io::table_text(lines, {1});
}

std::string track_csv(const TrackResult& r) {
  std::string text = "frequency_Hz";
  for (const TrackCurve* curve : all_curves(r)) text += fmt::format(",{0}_m_per_N,{0}_phase_deg", curve->key);
  text += '\n';
  for (std::size_t i = 0; i < r.frequency.size(); ++i) {
    text += io::csv_number(r.frequency[i]);
    for (const TrackCurve* curve : all_curves(r))
      text += ',' + io::csv_number(std::abs(curve->receptance[i])) + ',' +
              io::csv_number(kDegreeOfRad * std::arg(curve->receptance[i]));
    text += '\n';
  }
  return text;
}

std::string track_json(const TrackResult& r) {
  Json out;
  out["treadmark"] = {{"version", version()}, {"git", git_revision()}};
  out["input"] = {{"file", r.request.file.string()}, {"settings", r.request.overrides}};
  out["name"] = r.name;
  out["kind"] = r.flexible ? "flexible" : "lumped";
  if (r.bay) {
    io::add_all(out, *r.bay);
    out["deflection"] = {{"x_m", io::numbers(r.bay->x)}, {"m_per_N", io::numbers(r.bay->deflection)}};
  }
  if (r.request.aside != 0.0) out["aside_m"] = io::number(r.request.aside);
  out["frequency_Hz"] = io::numbers(r.frequency);
  out["curves"] = Json::object();
  for (const TrackCurve* curve : all_curves(r))
    out["curves"][curve->key] = {{"stiffness_at_rest_N_per_m", io::number(1.0 / curve->at_rest)},
                                 {"m_per_N", io::numbers(magnitudes_in(*curve))},
                                 {"phase_deg", io::numbers(phases_in(*curve))}};
  if (r.fitted) {
    const vehicle::LumpedFit& fit = r.fitted->fit;
    Json layers = Json::array();
    for (const vehicle::LumpedLayer& layer : fit.layers)
      layers.push_back({{"mass_kg", io::number(layer.mass)},
                        {"stiffness_N_per_m", io::number(layer.stiffness)},
                        {"damping_N_s_per_m", io::number(layer.damping)}});
    out["fit"] = {{"to", r.typical().key},
                  {"layers", std::move(layers)},
                  {"converged", fit.report.status == Status::ok},
                  {"rms_of_logarithm", io::number(fit.error.rms)},
                  {"largest_of_logarithm", io::number(fit.error.worst)},
                  {"largest_at_Hz", io::number(fit.error.worst_frequency)}};
  }
  return io::dumped(out, 2) + '\n';
}

std::string track_svg(const TrackResult& r) {
  pictures::ChartSheet sheet;
  sheet.title = r.name;
  sheet.width = 620.0;
  sheet.height = 240.0;
  sheet.gap_y = 66.0;
  sheet.top = 58.0;
  sheet.legend = pictures::ChartSheet::Legend::common;
  sheet.charts = {chart_over_frequency(r, "receptance", "motion under a force [nm/N]", kNano, magnitudes_in),
                  chart_over_frequency(r, "phase", "ahead of the force [deg]", 1.0, phases_in)};
  sheet.charts.front().y_scale = pictures::AxisScale::log;
  sheet.series = pictures::named(sheet.charts.front().series);
  if (r.bay) {
    pictures::Chart chart;
    chart.title = "at rest, force between sleepers";
    chart.x_label = "along the rail [m]";
    chart.y_label = "deflection [nm/N]";
    chart.y_down = true;
    chart.x_range = {r.bay->x.front(), r.bay->x.back()};
    pictures::ChartSeries line;
    line.width = 2.0;
    for (std::size_t i = 0; i < r.bay->x.size(); ++i) line.curve.push_back({r.bay->x[i], kNano * r.bay->deflection[i]});
    chart.series.push_back(std::move(line));
    sheet.charts.push_back(std::move(chart));
  }
  return pictures::draw_sheet(sheet);
}

std::string fitted_text(const TrackResult& r) {
  const vehicle::ReceptanceError& e = r.fitted->fit.error;
  const bool lateral = r.fitted->track.bodies.front().free[static_cast<std::size_t>(Freedom::y)];
  return io::track_text(
      r.fitted->track, r.source,
      {fmt::format("Made by treadmark track from {}: {} layers whose vertical receptance is that of '{}'",
                   r.request.file.filename().string(), r.fitted->fit.layers.size(), r.typical().name),
       fmt::format("from {:.4g} to {:.4g} Hz, off by {:.2g} (root mean square of the logarithm), at most {:.2g} at "
                   "{:.4g} Hz.",
                   r.frequency.front(), r.frequency.back(), e.rms, e.worst, e.worst_frequency),
       lateral ? "Lateral springs and roll are those of [lateral], not fitted." : "Rails do not move sideways.",
       "Both halves of the track are equal and not connected."});
}

void write_track_folder(const std::filesystem::path& folder, const TrackResult& result) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  write_file(output.path() / "receptance.csv", track_csv(result));
  write_file(output.path() / "track.svg", track_svg(result));
  if (result.fitted) write_file(output.path() / "fitted.toml", fitted_text(result));
  write_file(output.path() / "track.json", track_json(result));
  output.move_into("track.json");
}

}  // namespace app
}  // namespace treadmark
