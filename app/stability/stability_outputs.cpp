// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>
#include <cmath>
#include <map>

#include "treadmark/app/stability/stability_run.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/tables/number.hpp"
#include "treadmark/pictures/chart.hpp"

namespace treadmark::app {
namespace {

using io::Json;

Json json_mode(const vehicle::Eigenmode& mode, const vehicle::Multibody& system) {
  return {{"real_1_per_s", io::number(mode.value.real())},
          {"frequency_Hz", io::number(mode.frequency)},
          {"damping_ratio", io::number(mode.damping_ratio)},
          {"motion", vehicle::describe(mode, system)}};
}

const char* word(vehicle::StabilityVerdict verdict) {
  switch (verdict) {
    case vehicle::StabilityVerdict::stable:
      return "stable";
    case vehicle::StabilityVerdict::critical:
      return "critical";
    case vehicle::StabilityVerdict::unstable:
      return "unstable";
    case vehicle::StabilityVerdict::unknown:
      break;
  }
  return "unknown";
}

Json json_falling(const FallingRun& run) {
  Json out = {{"verdict", falling_word(run)}, {"message", falling_verdict(run)}};
  if (run.critical) {
    out["critical_speed_low_m_s"] = io::number(run.critical->low);
    out["critical_speed_high_m_s"] = io::number(run.critical->high);
  }
  if (run.forces_fall && !run.forces_fall->never_above && !run.forces_fall->at_end)
    out["guiding_forces_speed_m_s"] = io::number(run.forces_fall->speed);
  out["amplitude_m"] = io::number(run.request.amplitude);
  out["window_m"] = io::number(run.request.window);
  out["runs"] = Json::array();
  for (const Fall& fall : run.falls) {
    Json one = {{"status", fall.status},
                {"message", fall.message},
                {"from_m_s", io::number(fall.settings.from)},
                {"to_m_s", io::number(fall.settings.to)},
                {"deceleration_m_s2", io::number(fall.settings.deceleration)}};
    if (fall.status == "complete") {
      one["first_amplitude_m"] = io::number(fall.result.first_amplitude);
      if (fall.result.verdict == vehicle::FallVerdict::died) one["died_at_m_s"] = io::number(fall.result.speed);
    }
    out["runs"].push_back(std::move(one));
  }
  return out;
}

/// A line for each vibration through all speeds at which it is shown; x and y of a mode at a speed.
template <class X, class Y>
void add_branches(pictures::Chart& chart, const StabilityRun& run, X&& x, Y&& y) {
  constexpr double kMostDamping = 0.5;  // of what is shown
  std::map<int, pictures::Curve> branches;
  for (const vehicle::ModesAtSpeed& at : run.result.at)
    for (std::size_t i = 0; i < at.modes.size(); ++i) {
      const vehicle::Eigenmode& m = at.modes[i];
      if (m.frequency > 0.0 && m.frequency <= run.request.shown && m.damping_ratio < kMostDamping)
        branches[at.branch[i]].push_back({x(at, m), y(at, m)});
    }
  int style = 0;
  for (auto& [branch, curve] : branches) {
    pictures::ChartSeries series;
    series.style = style++;
    series.width = 1.8;
    series.curve = std::move(curve);
    chart.series.push_back(std::move(series));
  }
}

/// Amplitude over speed, over the same speeds as the damping.
pictures::Chart falling_chart(const StabilityRun& run) {
  pictures::Chart chart;
  chart.title = "amplitude of the wheelset that hunts most, while the speed falls";
  chart.x_label = "V [m/s]";
  chart.y_label = "[mm]";
  chart.x_range = {run.request.from, run.request.to};
  for (const Fall& fall : run.falling->falls) {
    pictures::ChartSeries series;
    series.name = fmt::format("{:g} m/s2", fall.settings.deceleration);
    pictures::set_look(series, chart.series.size(), run.falling->falls.size());
    for (const vehicle::SwayAt& at : fall.result.sway)
      series.curve.push_back({at.speed, 1e3 * std::sqrt(2.0) * at.rms});
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

std::string stability_table(const StabilityRun& run) {
  std::string text = fmt::format("{}\n{:>9} {:>9} {:>9} {:>11}  {}\n", run.title, "V [m/s]", "damping", "f [Hz]",
                                 "growth [1/s]", "least damped vibration, kinetic energy");
  for (const vehicle::ModesAtSpeed& at : run.result.at) {
    if (at.report.status != Status::ok || !at.least_damped) {
      text +=
          fmt::format("{:>9.4g}  {}\n", at.speed, at.report.status != Status::ok ? at.report.message : "no vibrations");
      continue;
    }
    const vehicle::Eigenmode& m = at.modes[*at.least_damped];
    text += fmt::format("{:>9.4g} {:>9.4f} {:>9.4g} {:>11.4g}  {}\n", at.speed, m.damping_ratio, m.frequency,
                        m.value.real(), vehicle::describe(m, run.system));
  }
  text += stability_verdict(run) + '\n';
  if (run.falling) text += falling_verdict(*run.falling) + '\n';
  return text;
}

std::string stability_csv(const StabilityRun& run) {
  std::string text = "speed_m_s,branch,real_1_per_s,imaginary_1_per_s,frequency_Hz,damping_ratio,motion\n";
  for (const vehicle::ModesAtSpeed& at : run.result.at)
    for (std::size_t i = 0; i < at.modes.size(); ++i) {
      const vehicle::Eigenmode& m = at.modes[i];
      text += fmt::format("{},{},{},{},{},{},{}\n", io::csv_number(at.speed), at.branch[i],
                          io::csv_number(m.value.real()), io::csv_number(m.value.imag()), io::csv_number(m.frequency),
                          io::csv_number(m.damping_ratio), io::csv_cell(vehicle::describe(m, run.system)));
    }
  return text;
}

std::string stability_json(const StabilityRun& run) {
  Json out;
  out["treadmark"] = {{"version", version()}, {"git", git_revision()}};
  out["input"] = {{"file", run.request.file.string()}, {"settings", run.request.overrides}};
  out["title"] = run.title;
  out["verdict"] = word(run.result.verdict);
  out["message"] = stability_verdict(run);
  if (const auto& critical = run.result.critical) {
    out["critical_speed_m_s"] = io::number(critical->speed);
    out["critical_speed_error_m_s"] = io::number(critical->error);
    out["critical_mode"] = json_mode(critical->beyond.modes[*critical->beyond.fastest_growth], run.system);
  }
  out["speeds"] = Json::array();
  for (const vehicle::ModesAtSpeed& at : run.result.at) {
    Json one = {{"speed_m_s", io::number(at.speed)},
                {"status", std::string(to_string(at.report.status))},
                {"message", at.report.message},
                {"residual", io::number(at.residual)},
                {"eigenvalues", at.modes.size()}};
    if (at.least_damped) one["least_damped"] = json_mode(at.modes[*at.least_damped], run.system);
    if (at.fastest_growth) one["fastest_growth"] = json_mode(at.modes[*at.fastest_growth], run.system);
    out["speeds"].push_back(std::move(one));
  }
  if (run.falling) out["falling_speed"] = json_falling(*run.falling);
  return io::dumped(out, 2) + '\n';
}

std::string stability_svg(const StabilityRun& run) {
  pictures::Chart locus, damping;
  locus.title = "eigenvalues; a mark at the highest speed";
  locus.x_label = "real part [1/s]";
  locus.y_label = "frequency [Hz]";
  locus.y_range = {0.0, run.request.shown};
  const double fastest = run.result.at.back().speed;
  add_branches(
      locus, run, [](const auto&, const auto& m) { return m.value.real(); },
      [](const auto&, const auto& m) { return m.frequency; });
  pictures::ChartSeries last;
  last.joined = false;
  for (const vehicle::Eigenmode& m : run.result.at.back().modes)
    if (m.frequency > 0.0 && m.frequency <= run.request.shown && m.damping_ratio < 0.5)
      last.points.push_back({m.value.real(), m.frequency, 3.0, "", fmt::format("{:g} m/s", fastest)});
  locus.series.push_back(std::move(last));
  damping.title = "damping ratio";
  damping.x_label = "V [m/s]";
  damping.y_label = "share of critical damping";
  add_branches(
      damping, run, [](const auto& at, const auto&) { return at.speed; },
      [](const auto&, const auto& m) { return m.damping_ratio; });
  pictures::ChartSeries none;
  none.levels = {0.0};
  damping.series.push_back(std::move(none));
  pictures::ChartSheet sheet;
  sheet.charts = {std::move(locus), std::move(damping)};
  if (run.falling) sheet.charts.push_back(falling_chart(run));
  sheet.title = run.title;
  sheet.width = 620.0;
  sheet.height = 300.0;
  sheet.gap_y = 66.0;
  sheet.top = 58.0;
  sheet.bottom = 66.0;
  const std::string verdict = stability_verdict(run);
  const std::size_t colon = verdict.find(": ");
  sheet.remarks.push_back(verdict.substr(0, colon));
  if (colon != std::string::npos) sheet.remarks.push_back(verdict.substr(colon + 2));
  if (run.falling) {
    std::string falling = falling_verdict(*run.falling);
    for (std::size_t end;
         (end = falling.find(": at ")) != std::string::npos || (end = falling.find("; ")) != std::string::npos;) {
      sheet.remarks.push_back(falling.substr(0, end));
      falling.erase(0, end + 2);
    }
    sheet.remarks.push_back(falling);
  }
  sheet.remarks.push_back(
      fmt::format("vibrations up to {:g} Hz with less than half of critical damping", run.request.shown));
  return pictures::draw_sheet(sheet);
}

void write_stability_folder(const std::filesystem::path& folder, const StabilityRun& run) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  write_file(output.path() / "eigenvalues.csv", stability_csv(run));
  if (run.falling) write_file(output.path() / "falling.csv", falling_csv(*run.falling));
  write_file(output.path() / "stability.svg", stability_svg(run));
  write_file(output.path() / "stability.json", stability_json(run));
  output.move_into("stability.json");
}

}  // namespace treadmark::app
