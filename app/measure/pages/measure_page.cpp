// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::app {
namespace {

using report::Axis;
using report::ChartView;
using report::Figure;
using report::Number;
using report::Panel;
using report::Series;

Series curve(const char* name, const std::vector<Vec2>& points) {
  Series out{name, {}};
  for (const Vec2& p : points) {
    out.x.push_back(kMilli * p.x());
    out.y.push_back(-kMilli * p.y());
  }
  return out;
}

ChartView section_view(const MeasuredFile& file) {
  ChartView view;
  view.x = Axis{"y", "mm"};
  Panel panel{"height", "mm", false, {curve("measured", file.section)}};
  if (!file.nominal.empty()) {
    panel.series.push_back(curve("nominal", file.nominal));
    panel.series.back().dashed = true;
  }
  view.panels.push_back(std::move(panel));
  return view;
}

/// Metal that is missing, vertically: of the outermost points at one y, where both sections have some.
ChartView missing_view(const MeasuredFile& file, Body body) {
  constexpr double kStep = 0.25e-3;
  const auto outermost = [&](const std::vector<Vec2>& points, double y) {
    double best = kNaN;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec2 &a = points[i], &b = points[i + 1];
      if ((a.x() - y) * (b.x() - y) > 0.0 || a.x() == b.x()) continue;
      const double z = a.y() + (b.y() - a.y()) * (y - a.x()) / (b.x() - a.x());
      best = body == Body::wheel ? std::fmax(best, z) : std::fmin(best, z);
    }
    return best;
  };
  const auto [low, high] = std::ranges::minmax_element(file.section, {}, [](const Vec2& p) { return p.x(); });
  Series missing{"", {}};
  for (double y = low->x() + kStep; y < high->x(); y += kStep) {
    const double away = outermost(file.nominal, y) - outermost(file.section, y);
    missing.x.push_back(kMilli * y);
    missing.y.push_back(kMilli * (body == Body::wheel ? away : -away));
  }
  ChartView view;
  view.x = Axis{"y", "mm"};
  view.panels.push_back({"metal missing, vertically", "mm", false, {std::move(missing)}});
  return view;
}

ChartView revolution_view(const MeasuredFile& file) {
  const measures::RoundMeasures& round = *file.revolution;
  ChartView view;
  Axis x{"angle", "°"};
  Series radius{"at the tape line", {}}, flats{"flats", {}};
  for (std::size_t i = 0; i < file.theta.size(); ++i) {
    x.values.push_back(file.theta[i] * 180.0 / kPi);
    radius.y.push_back(1e6 * (file.tape_radius[i] - round.radius));
  }
  flats.marks = Series::Marks::points;
  for (const measures::RoundFlat& flat : round.flats) {
    flats.x.push_back(flat.theta * 180.0 / kPi);
    flats.y.push_back(-1e6 * flat.depth.value);
    flats.texts.push_back(
        fmt::format("{:.1f} mm long, {:.3f} mm deep", kMilli * flat.length.value, kMilli * flat.depth.value));
  }
  view.x = std::move(x);
  view.panels.push_back({"radius less its mean", "µm", false, {std::move(radius)}});
  if (!round.flats.empty()) view.panels.back().series.push_back(std::move(flats));
  return view;
}

ChartView orders_view(const measures::RoundMeasures& round) {
  ChartView view;
  Series level{"", {}};
  level.marks = Series::Marks::points;
  for (const measures::RoundOrder& order : round.orders) {
    level.x.push_back(order.order);
    level.y.push_back(order.level);
    level.texts.push_back(
        fmt::format("order {}: {:.2f} µm, {:.0f} mm", order.order, 1e6 * order.amplitude, kMilli * order.wavelength));
  }
  view.x = Axis{"order", ""};
  view.panels.push_back({"level", "dB re 1 µm", false, {std::move(level)}});
  return view;
}

ChartView roughness_view(const measures::RoughnessMeasures& roughness) {
  ChartView view;
  Series level{"measured", {}}, limit{"limit", {}}, floor{"noise of the scan", {}};
  limit.dashed = floor.dashed = true;
  Axis x{"wavelength", "mm", true};
  for (const measures::RoughnessBand& band : roughness.bands) {
    x.values.push_back(kMilli * band.wavelength);
    level.y.push_back(band.level);
    limit.y.push_back(band.limit);
    floor.y.push_back(band.floor);
  }
  level.marks = Series::Marks::both;
  view.x = std::move(x);
  view.panels.push_back({"roughness", "dB re 1 µm", false, {std::move(level), std::move(limit), std::move(floor)}});
  return view;
}

/// Numbers of the section over the place: those that are known somewhere.
template <class Numbers>
ChartView stations_view(const std::vector<MeasuredStation<Numbers>>& stations, Axis x, double unit) {
  ChartView view;
  for (const auto& station : stations) x.values.push_back(station.u / unit);
  for (const auto& row : number_rows(Numbers{})) {
    Series series{"", {}};
    for (const auto& station : stations) series.y.push_back(row.in_file(station.numbers));
    if (std::ranges::any_of(series.y, [](double v) { return v == v; }))
      view.panels.push_back({std::string(row.label), "", false, {std::move(series)}});
  }
  view.x = std::move(x);
  return view;
}

template <class Numbers>
report::Table shown_numbers(const MeasuredFile& file, const Numbers& numbers) {
  report::Table table{"numbers", "Measures", {{"measure"}, {"key"}, {"value"}, {"uncertainty"}, {"limit"}, {"status"}}};
  for (const auto& row : number_rows(numbers)) {
    const bool known = row.known(numbers);
    const auto limit = std::ranges::find(file.limits, row.key, [](const LimitResult& l) { return l.limit.key; });
    std::string range, status = known ? "" : row.access.reason(numbers);
    if (limit != file.limits.end()) {
      if (limit->limit.min) range = fmt::format("from {:g}", *limit->limit.min);
      if (limit->limit.max) range += fmt::format("{}to {:g}", range.empty() ? "" : " ", *limit->limit.max);
      if (known) status = word_of(limit->verdict) + (limit->sure ? "" : ", nearer than its uncertainty");
    }
    table.rows.push_back({{std::string(row.label), std::string(row.key), Number{row.in_file(numbers), 5},
                           Number{row.uncertainty_in_file(numbers), 2}, range, status}});
  }
  return table;
}

}  // namespace

report::Page measure_page(const MeasuredFile& file, const MeasureRequest& request) {
  const std::string name = std::filesystem::path(file.file).filename().string();
  report::Page page{"measure", name,
                    fmt::format("Measurements of a {}", request.body == Body::wheel ? "wheel" : "rail")};
  report::Section overview{"overview", "Overview"};
  for (const std::string& note : file.notes)
    overview.blocks.emplace_back(report::Banner{report::Banner::Kind::note, "Note:", note});
  for (const LimitResult& l : file.limits)
    if (l.verdict == Verdict::outside)
      overview.blocks.emplace_back(report::Banner{
          report::Banner::Kind::warning, "Outside its limit:", fmt::format("{} = {:.4g}", l.limit.key, l.value)});
  report::Facts facts;
  facts.entries = {{"file", file.file},
                   {"kind", file.kind},
                   {"nominal section", request.nominal.empty() ? "none" : request.nominal},
                   {"limits", request.limits.file.empty() ? "none" : request.limits.file},
                   {"status", word_of(file.verdict())},
                   {"version", version()}};
  for (const auto& [key, value] : file.said) facts.entries.emplace_back("the file says: " + key, value);
  overview.blocks.emplace_back(std::move(facts));
  overview.blocks.emplace_back(std::visit([&](const auto& n) { return shown_numbers(file, n); }, file.numbers));
  page.sections.push_back(std::move(overview));

  report::Section section{"section", "Section"};
  section.blocks.emplace_back(
      Figure{"outline", "Measured section", section_view(file),
             file.nominal.empty() ? "" : "aligned with the nominal one as for the numbers above"});
  if (!file.nominal.empty())
    section.blocks.emplace_back(Figure{"missing", "Wear over the section", missing_view(file, request.body)});
  page.sections.push_back(std::move(section));
  if (file.revolution) {
    report::Section round{"round", "Round the wheel"};
    round.blocks.emplace_back(Figure{"radius", "Out-of-roundness and flats", revolution_view(file)});
    round.blocks.emplace_back(Figure{"orders", "Polygon orders", orders_view(*file.revolution)});
    if (file.round.size() > 1)
      round.blocks.emplace_back(
          Figure{"stations", "Sections round the wheel", stations_view(file.round, Axis{"angle", "°"}, kPi / 180.0)});
    page.sections.push_back(std::move(round));
  }
  if (file.roughness || file.along.size() > 1) {
    report::Section along{"along", "Along the rail"};
    if (file.roughness) along.blocks.emplace_back(Figure{"roughness", "Roughness", roughness_view(*file.roughness)});
    if (file.along.size() > 1)
      along.blocks.emplace_back(
          Figure{"stations", "Sections along the rail", stations_view(file.along, Axis{"x", "m"}, 1.0)});
    page.sections.push_back(std::move(along));
  }
  page.document = measure_json(file, request);
  return page;
}

}  // namespace treadmark::app
