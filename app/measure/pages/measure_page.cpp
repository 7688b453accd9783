// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/settings/key_words.hpp"
#include "treadmark/model/shape/body_name.hpp"

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

/// A length that is measured, as a line with its name and number.
void add_gauge(Panel& panel, const char* name, const measures::Measure& measure, const Vec2& from, const Vec2& to) {
  if (!measure.known()) return;
  panel.series.push_back(curve("", {from, to}));
  panel.series.back().name = fmt::format("{} {:.2f} mm", name, kMilli * measure.value);
  panel.series.back().marks = Series::Marks::both;
}

void add_gauges(Panel& panel, const WheelNumbers& n, const MeasuredFile& file) {
  const measures::WheelGauge gauge;
  const Vec2 tip = *ranges::max_element(file.section, {}, [](const Vec2& p) { return p.y(); });
  const double face = n.flange_thickness.value - gauge.tape_line, upper = n.flange_height.value - gauge.below_tip;
  add_gauge(panel, "Sh", n.flange_height, {tip.x(), 0.0}, {tip.x(), n.flange_height.value});
  add_gauge(panel, "Sd", n.flange_thickness, {-gauge.tape_line, gauge.face_depth}, {face, gauge.face_depth});
  if (n.flange_thickness.known())
    add_gauge(panel, "qR", n.flange_gradient, {face - n.flange_gradient.value, upper}, {face, upper});
}

/// From the nominal section inwards; its crown is at the origin and the gauge side at y < 0.
void add_gauges(Panel& panel, const RailNumbers& n, const MeasuredFile& file) {
  const measures::RailGauge gauge;
  Vec2 side(kNaN, gauge.side_depth), corner(kNaN, kNaN);
  double nearest = kInfinity;
  for (std::size_t i = 0; i + 1 < file.nominal.size(); ++i) {
    const Vec2 &a = file.nominal[i], &b = file.nominal[i + 1], step = b - a;
    if ((a.y() - side.y()) * (b.y() - side.y()) <= 0.0 && a.y() != b.y())
      side.x() = std::fmin(side.x(), a.x() + step.x() * (side.y() - a.y()) / step.y());
    const double off = std::fabs(std::atan2(-step.y(), step.x()) - gauge.oblique);
    if (a.x() < 0.0 && a.y() < 2.0 * gauge.side_depth && off < nearest) nearest = off, corner = 0.5 * (a + b);
  }
  const Vec2 inwards(std::sin(gauge.oblique), std::cos(gauge.oblique));
  add_gauge(panel, "W1", n.w1, {0.0, 0.0}, {0.0, n.w1.value});
  add_gauge(panel, "W2", n.w2, side, side + Vec2(n.w2.value, 0.0));
  add_gauge(panel, "W3", n.w3, corner, corner + n.w3.value * inwards);
}

ChartView section_view(const MeasuredFile& file) {
  ChartView view;
  view.to_scale = true;
  view.x = Axis{"y", "mm"};
  Panel panel{"height", "mm", false, {curve("measured", file.section)}};
  if (!file.nominal.empty()) {
    panel.series.push_back(curve("nominal", file.nominal));
    panel.series.back().dashed = true;
  }
  if (!file.section.empty()) std::visit([&](const auto& n) { add_gauges(panel, n, file); }, file.numbers);
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
  const auto [low, high] = ranges::minmax_element(file.section, {}, [](const Vec2& p) { return p.x(); });
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
    if (ranges::any_of(series.y, [](double v) { return v == v; }))
      view.panels.push_back({std::string(row.label), io::words_of_key(row.key).unit, false, {std::move(series)}});
  }
  view.x = std::move(x);
  return view;
}

std::string range_of(const Limit& limit) {
  std::string range = limit.min ? fmt::format("from {:g}", *limit.min) : "";
  if (limit.max) range += fmt::format("{}to {:g}", range.empty() ? "" : " ", *limit.max);
  return range;
}

template <class Numbers>
report::Table shown_numbers(const MeasuredFile& file, const Numbers& numbers) {
  report::Table table{
      "numbers", "Measures", {{"measure"}, {"value"}, {"unit"}, {"uncertainty"}, {"limit"}, {"status"}}};
  const auto in_decimals = [](double value, int decimals) {
    const double before = value == 0.0 || !std::isfinite(value) ? 1.0 : std::floor(std::log10(std::fabs(value))) + 1.0;
    return Number{value, std::max(1, to_whole<int>(before) + decimals)};
  };
  for (const auto& row : number_rows(numbers)) {
    const bool known = row.known(numbers);
    const auto limit = ranges::find(file.limits, row.key, [](const LimitResult& l) { return l.limit.key; });
    std::string range, status = known ? "" : row.access.reason(numbers);
    if (limit != file.limits.end()) {
      range = range_of(limit->limit);
      if (known) status = word_of(limit->verdict) + how_sure(*limit);
    }
    table.rows.push_back(
        {{std::string(row.label), in_decimals(row.in_file(numbers), row.decimals), io::words_of_key(row.key).unit,
          Number{row.uncertainty_in_file(numbers), 2}, range, status}});
  }
  return table;
}

/// "flange height Sh = 27.2 mm, allowed from 27.5".
template <class Numbers>
std::string broken_limit(const LimitResult& limit, const Numbers& numbers) {
  const auto rows = number_rows(numbers);
  const auto row = ranges::find(rows, limit.limit.key, [](const auto& one) { return one.key; });
  const std::string name(row == rows.end() ? std::string_view(limit.limit.key) : row->label);
  return fmt::format("{} = {:.4g} {}, allowed {}", name, limit.value, io::words_of_key(limit.limit.key).unit,
                     range_of(limit.limit));
}

}  // namespace

report::Page measure_page(const MeasuredFile& file, const MeasureRequest& request) {
  const std::string name = std::filesystem::path(file.file).filename().string();
  report::Page page{"measure", name, fmt::format("Measurements of a {}", body_name(request.body))};
  report::Section overview{"overview", "Overview"};
  for (const std::string& note : file.notes)
    overview.blocks.emplace_back(report::Banner{report::Banner::Kind::note, "Note:", note});
  for (const LimitResult& l : file.limits)
    if (l.verdict == Verdict::outside)
      overview.blocks.emplace_back(report::Banner{
          report::Banner::Kind::warning,
          "Outside its limit:", std::visit([&](const auto& n) { return broken_limit(l, n); }, file.numbers)});
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
