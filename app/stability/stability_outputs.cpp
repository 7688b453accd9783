// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>
#include <cmath>
#include <complex>
#include <map>
#include <optional>

#include "treadmark/app/stability/stability_run.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/text_of.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark {
namespace {

/// A motion at a speed.
struct ModeRow {
  double speed = 0.0;                             ///< [m/s]
  std::optional<int> branch = {};                 ///< where it is followed through the speeds
  std::complex<double> value = {kNaN, kNaN};      ///< eigenvalue [1/s]
  double frequency = kNaN, damping_ratio = kNaN;  ///< [Hz], [-]
  std::string motion;                             ///< in words, or why there is none
};
using M = const ModeRow&;
using access::of;

constexpr FileUnit kPerSecond{"1/s"};

constexpr Column<ModeRow> kModes[] = {
    {"speed_m_s", {"m/s"}, "", of<&ModeRow::speed>(), "", kInTable, "V"},
    {"", {"km/h", 3.6, "m/s"}, "", of<&ModeRow::speed>(), "", kInTable, "V"},
    {"branch",
     unit::kOne,
     "",
     {[](M m) { return 1.0 * *m.branch; }, nullptr, [](M m) { return m.branch.has_value(); }, true}},
    {"real_1_per_s", kPerSecond, "", {[](M m) { return m.value.real(); }}, "", kInTable, "growth"},
    {"imaginary_1_per_s", kPerSecond, "", {[](M m) { return m.value.imag(); }}},
    {"frequency_Hz", {"Hz"}, "", of<&ModeRow::frequency>(), "", kInTable, "f"},
    {"damping_ratio", unit::kOne, "", of<&ModeRow::damping_ratio>(), "", kInTable, "damping", 4},
    {"motion", unit::kOne, "", of<&ModeRow::motion>(), "", kInTable, "least damped vibration, kinetic energy"}};

ModeRow mode_row(const vehicle::ModesAtSpeed& at, std::size_t i, const vehicle::Multibody& system) {
  const vehicle::Eigenmode& m = at.modes[i];
  ModeRow row{at.speed, {}, m.value, m.frequency, m.damping_ratio, vehicle::describe(m, system)};
  if (i < at.branch.size()) row.branch = at.branch[i];
  return row;
}

}  // namespace

template <>
std::span<const Column<ModeRow>> columns() {
  return kModes;
}

namespace app {
namespace {

using io::Json;

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
  std::vector<ModeRow> rows;
  for (const vehicle::ModesAtSpeed& at : run.result.at)
    if (at.report.status == Status::ok && at.least_damped)
      rows.push_back(mode_row(at, *at.least_damped, run.system));
    else
      rows.push_back(
          {.speed = at.speed, .motion = at.report.status != Status::ok ? at.report.message : "no vibrations"});
  std::string text = run.title + '\n' + io::table_of(rows) + stability_verdict(run) + '\n';
  if (run.falling) text += falling_verdict(*run.falling) + '\n';
  return text;
}

std::string stability_csv(const StabilityRun& run) {
  std::vector<ModeRow> rows;
  for (const vehicle::ModesAtSpeed& at : run.result.at)
    for (std::size_t i = 0; i < at.modes.size(); ++i) rows.push_back(mode_row(at, i, run.system));
  return io::csv_of(rows, Digits::all);
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
    out["critical_mode"] = io::json_of(mode_row(critical->beyond, *critical->beyond.fastest_growth, run.system));
  }
  out["speeds"] = Json::array();
  for (const vehicle::ModesAtSpeed& at : run.result.at) {
    Json one = {{"speed_m_s", io::number(at.speed)},
                {"status", std::string(to_string(at.report.status))},
                {"message", at.report.message},
                {"residual", io::number(at.residual)},
                {"eigenvalues", at.modes.size()}};
    if (at.least_damped) one["least_damped"] = io::json_of(mode_row(at, *at.least_damped, run.system));
    if (at.fastest_growth) one["fastest_growth"] = io::json_of(mode_row(at, *at.fastest_growth, run.system));
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

}  // namespace app
}  // namespace treadmark
