// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "treadmark/app/stability/response_run.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/text_of.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark {
namespace {

constexpr double kDegree = 180.0 / kPi;

/// Of one curve at one frequency.
struct ResponseRow {
  std::string input, channel, unit;
  double frequency = 0.0;  ///< [Hz]
  std::complex<double> value;
};
using R = const ResponseRow&;
using access::of;

constexpr Column<ResponseRow> kResponse[] = {
    {"input", unit::kOne, "", of<&ResponseRow::input>(), "", kInTable, "input"},
    {"channel", unit::kOne, "", of<&ResponseRow::channel>(), "", kInTable, "channel"},
    {"frequency_Hz", {"Hz"}, "", of<&ResponseRow::frequency>(), "", kInTable, "f"},
    {"real", unit::kOne, "", {[](R r) { return r.value.real(); }}},
    {"imaginary", unit::kOne, "", {[](R r) { return r.value.imag(); }}},
    {"magnitude", unit::kOne, "", {[](R r) { return std::abs(r.value); }}, "", kInTable, "magnitude"},
    {"phase_deg", {"deg"}, "", {[](R r) { return kDegree * std::arg(r.value); }}, "", kInTable, "phase"},
    {"unit", unit::kOne, "", of<&ResponseRow::unit>(), "", kInTable, "unit"}};

/// Of one channel at one frequency.
struct SpectrumRow {
  std::string channel, unit;
  double frequency = 0.0, density = 0.0;  ///< [Hz], [unit^2/Hz]
};
constexpr Column<SpectrumRow> kSpectrum[] = {{"channel", unit::kOne, "", of<&SpectrumRow::channel>()},
                                             {"frequency_Hz", {"Hz"}, "", of<&SpectrumRow::frequency>()},
                                             {"density", unit::kOne, "", of<&SpectrumRow::density>()},
                                             {"unit", unit::kOne, "", of<&SpectrumRow::unit>()}};

constexpr Column<app::ResponseSpectrum> kRms[] = {
    {"channel", unit::kOne, "", of<&app::ResponseSpectrum::channel>(), "", kInTable, "channel"},
    {"rms", unit::kOne, "", of<&app::ResponseSpectrum::rms>(), "", kInTable, "rms"},
    {"unit", unit::kOne, "", of<&app::ResponseSpectrum::unit>(), "", kInTable, "unit"}};

ResponseRow row_of(const app::ResponseRun& run, const app::ResponseCurve& curve, std::size_t i) {
  return {curve.input, curve.channel, curve.unit, run.frequency[i], curve.values[i]};
}

}  // namespace

template <>
std::span<const Column<ResponseRow>> columns() {
  return kResponse;
}
template <>
std::span<const Column<SpectrumRow>> columns() {
  return kSpectrum;
}
template <>
std::span<const Column<app::ResponseSpectrum>> columns() {
  return kRms;
}

namespace app {
namespace {

using io::Json;

/// What is drawn together: the ends of its channels' names, and what they are.
struct Drawn {
  std::string_view ending, what;
};
constexpr Drawn kForces{"_N", "forces"}, kAccelerations{"_m_s2", "accelerations"}, kMoved{"_m", "displacements"},
    kTurned{"_rad", "rotations"};

/// Motions are drawn where nothing else was asked for.
std::array<Drawn, 2> drawn_of(const ResponseRun& run) {
  const bool moved = ranges::none_of(run.curves, [](const ResponseCurve& c) {
    return c.channel.ends_with(kForces.ending) || c.channel.ends_with(kAccelerations.ending);
  });
  return moved ? std::array{kMoved, kTurned} : std::array{kForces, kAccelerations};
}

/// Values over the frequency, above 0.
struct DrawnCurve {
  std::string channel, unit;
  std::vector<double> values;
};

/// Magnitudes under one input.
std::vector<DrawnCurve> magnitudes(const ResponseRun& run, const std::string& input) {
  std::vector<DrawnCurve> out;
  for (const ResponseCurve& curve : run.curves) {
    if (curve.input != input) continue;
    DrawnCurve& to = out.emplace_back(DrawnCurve{curve.channel, curve.unit, {}});
    for (const auto& value : curve.values) to.values.push_back(std::abs(value));
  }
  return out;
}

std::string density_unit(const std::string& unit) { return '(' + unit + ")^2/Hz"; }

std::vector<DrawnCurve> densities(const ResponseRun& run) {
  std::vector<DrawnCurve> out;
  for (const ResponseSpectrum& s : run.spectra) out.push_back({s.channel, density_unit(s.unit), s.density});
  return out;
}

std::optional<pictures::Chart> chart_of(const ResponseRun& run, const std::string& title,
                                        const std::vector<DrawnCurve>& curves, const Drawn& drawn) {
  constexpr std::size_t kMost = 8;  // that can be told apart
  // What a symmetric vehicle does not feel is rounding.
  constexpr double kNothing = 1e-9;
  const auto largest = [](const DrawnCurve& curve) { return *ranges::max_element(curve.values); };
  std::map<std::string, double> most;  // by unit
  for (const DrawnCurve& curve : curves) most[curve.unit] = std::max(most[curve.unit], largest(curve));
  pictures::Chart chart;
  chart.x_label = "frequency [Hz]";
  chart.x_scale = chart.y_scale = pictures::AxisScale::log;
  chart.x_range = {run.frequency.front(), run.frequency.back()};
  for (const DrawnCurve& curve : curves) {
    if (!curve.channel.ends_with(drawn.ending)) continue;
    if (!(largest(curve) > kNothing * most[curve.unit])) continue;
    if (chart.series.size() == kMost) break;
    chart.title = fmt::format("{}: {}", title, drawn.what);
    chart.y_label = '[' + curve.unit + ']';
    pictures::ChartSeries series;
    series.name = curve.channel;
    series.style = static_cast<int>(chart.series.size());
    for (std::size_t i = 0; i < run.frequency.size(); ++i) series.curve.push_back({run.frequency[i], curve.values[i]});
    chart.series.push_back(std::move(series));
  }
  if (chart.series.empty()) return std::nullopt;
  return chart;
}

}  // namespace

std::string response_table(const ResponseRun& run) {
  // Each curve at its highest magnitude.
  std::vector<ResponseRow> rows;
  rows.reserve(run.curves.size());
  for (const ResponseCurve& curve : run.curves) {
    const auto most = std::max_element(curve.values.begin(), curve.values.end(),
                                       [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
    rows.push_back(row_of(run, curve, static_cast<std::size_t>(most - curve.values.begin())));
  }
  return fmt::format("{} at {:g} m/s, {:g} to {:g} Hz; each at its highest\n", run.title, run.speed,
                     run.frequency.front(), run.frequency.back()) +
         io::table_of(rows) +
         (run.spectra.empty() ? "" : "on this track, between these frequencies\n" + io::table_of(run.spectra)) +
         (run.stable ? "" : fmt::format("{}\n", kUnstable));
}

std::string response_csv(const ResponseRun& run) {
  std::vector<ResponseRow> rows;
  rows.reserve(run.curves.size() * run.frequency.size());
  for (const ResponseCurve& curve : run.curves)
    for (std::size_t i = 0; i < run.frequency.size(); ++i) rows.push_back(row_of(run, curve, i));
  return io::csv_of(rows, Digits::all);
}

std::string spectra_csv(const ResponseRun& run) {
  std::vector<SpectrumRow> rows;
  for (const ResponseSpectrum& s : run.spectra)
    for (std::size_t i = 0; i < run.frequency.size(); ++i)
      rows.push_back({s.channel, density_unit(s.unit), run.frequency[i], s.density[i]});
  return io::csv_of(rows, Digits::all);
}

std::string response_json(const ResponseRun& run) {
  Json out;
  out["treadmark"] = {{"version", version()}, {"git", git_revision()}};
  out["input"] = {{"file", run.request.file.string()}, {"settings", run.request.overrides}};
  out["title"] = run.title;
  out["speed_m_s"] = io::number(run.speed);
  out["stable"] = run.stable;
  out["frequency_Hz"] = io::numbers(run.frequency);
  out["responses"] = Json::array();
  for (const ResponseCurve& curve : run.curves) {
    std::vector<double> real, imaginary;
    real.reserve(curve.values.size());
    imaginary.reserve(curve.values.size());
    for (const auto& value : curve.values) {
      real.push_back(value.real());
      imaginary.push_back(value.imag());
    }
    out["responses"].push_back({{"input", curve.input},
                                {"channel", curve.channel},
                                {"unit", curve.unit},
                                {"real", io::numbers(real)},
                                {"imaginary", io::numbers(imaginary)}});
  }
  for (const ResponseSpectrum& s : run.spectra) {
    Json one = io::json_of(s, Digits::all);
    one["density"] = io::numbers(s.density);
    out["spectra"].push_back(std::move(one));
  }
  out["modes"] = Json::array();
  for (const vehicle::Eigenmode& mode : run.modes)
    out["modes"].push_back({{"frequency_Hz", io::number(mode.frequency)},
                            {"damping_ratio", io::number(mode.damping_ratio)},
                            {"motion", vehicle::describe(mode, run.system)}});
  return io::dumped(out, 2) + '\n';
}

std::string response_svg(const ResponseRun& run) {
  pictures::ChartSheet sheet;
  sheet.title = fmt::format("{}, {:g} m/s", run.title, run.speed);
  sheet.width = 620.0;
  sheet.height = 280.0;
  sheet.gap_y = 66.0;
  sheet.top = 58.0;
  sheet.legend = pictures::ChartSheet::Legend::each;
  if (!run.stable) sheet.remarks.emplace_back(kUnstable);
  std::string last;
  for (const ResponseCurve& curve : run.curves) {
    if (curve.input == last) continue;
    last = curve.input;
    for (const Drawn& drawn : drawn_of(run))
      if (auto chart = chart_of(run, curve.input, magnitudes(run, curve.input), drawn))
        sheet.charts.push_back(std::move(*chart));
  }
  if (!run.spectra.empty())
    for (const Drawn& drawn : drawn_of(run))
      if (auto chart = chart_of(run, "power spectral density on this track", densities(run), drawn))
        sheet.charts.push_back(std::move(*chart));
  return pictures::draw_sheet(sheet);
}

void write_response_folder(const std::filesystem::path& folder, const ResponseRun& run) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  write_file(output.path() / "response.csv", response_csv(run));
  write_file(output.path() / "response.svg", response_svg(run));
  if (!run.spectra.empty()) write_file(output.path() / "spectra.csv", spectra_csv(run));
  if (const std::string modes = modes_svg(run); !modes.empty()) write_file(output.path() / "modes.svg", modes);
  write_file(output.path() / "response.json", response_json(run));
  output.move_into("response.json");
}

}  // namespace app
}  // namespace treadmark
