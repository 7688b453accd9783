// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/pages/bench_page.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

constexpr double kMegabytes = 1e-6;  // bytes -> MB

/// A row with its numbers as the files have them, and what names it.
struct Row {
  const BenchRow* data;
  std::string label = {};  ///< "mesh 0.5 mm"
  bool wheel = false;

  double number(std::string_view key) const {
    const auto& column = *ranges::find(columns<BenchRow>(), key, &treadmark::Column<BenchRow>::key);
    return io::rounded(column.in_file(*data), column.access.whole ? Digits::all : Digits::six);
  }
  const char* body() const { return wheel ? "wheel" : "rail"; }
};

std::vector<Row> rows_of(const BenchReport& bench) {
  std::vector<Row> rows;
  for (const BenchRow& data : bench.rows) {
    Row row{&data, data.backend, data.body == Body::wheel};
    if (const double resolution = row.number("resolution_mm"); resolution > 0.0)
      row.label += fmt::format(" {:.4g} mm", resolution);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string one_line(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : ", ") + part;
  return out;
}

void add_banners(const BenchReport& bench, const std::vector<Row>& rows, Section& overview) {
  if (!bench.complete)
    overview.blocks.emplace_back(
        Banner{Banner::Kind::failed, "Interrupted.",
               fmt::format("Only what was finished is here: {}.", counted(rows.size(), "row"))});
  std::size_t wrong = 0;
  std::string reasons;
  for (const Row& row : rows) {
    if (row.data->agrees) continue;
    reasons += fmt::format("{}{}, {}: {}", wrong++ == 0 ? "" : "; ", row.label, row.body(), row.data->reason);
  }
  if (wrong > 0)
    overview.blocks.emplace_back(
        Banner{Banner::Kind::failed, fmt::format("{} of {} without figures:", wrong, counted(rows.size(), "row")),
               fmt::format("what does not agree, or could not be built, is not timed. {}.", reasons)});
  if (rows.empty()) overview.blocks.emplace_back(Banner{Banner::Kind::note, "No rows.", "Nothing was measured."});
}

/// The least of a quantity over rows, and whose it is.
Cards::Card least(const std::vector<Row>& rows, const char* label, const char* key, double factor, const char* unit,
                  bool rail_too) {
  double best = NAN;
  std::string whose;
  for (const Row& row : rows) {
    const double value = row.number(key);
    if ((!row.wheel && !rail_too) || !std::isfinite(value) || value >= best) continue;
    best = value;
    whose = row.label;
  }
  return {label, std::isnan(best) ? "–" : fmt::format("{} {}", shown({factor * best, 3}), unit), whose};
}

Cards cards_of(const BenchReport& bench, const std::vector<Row>& rows) {
  const auto agree = ranges::count_if(rows, [](const Row& row) { return row.data->agrees; });
  Cards cards;
  cards.cards = {{"Rows that agree", fmt::format("{} of {}", agree, rows.size()),
                  "with the surfaces as given and with single heights"},
                 least(rows, "Fastest height on the wheel", "ns_per_height", 1.0, "ns", false),
                 least(rows, "Fastest first search", "search_cold_s", kMilli, "ms", false),
                 least(rows, "Fastest distance", "distance_s", kMilli, "ms", false),
                 {"Threads", fmt::format("{}", bench.threads), bench.machine}};
  return cards;
}

Facts facts_of(const BenchReport& bench) {
  const std::string& file = bench.input_file;
  Facts facts;
  facts.entries = {{"Machine", bench.machine},
                   {"Date", bench.date},
                   {"Version", bench.git.empty() ? bench.version : fmt::format("{} ({})", bench.version, bench.git)},
                   {"Compiler", bench.compiler}};
  facts.entries.insert(facts.entries.end(), bench.libraries.begin(), bench.libraries.end());
  facts.entries.emplace_back("Input", file.empty() ? "the built-in case" : file);
  if (!file.empty()) facts.entries.emplace_back("SHA-256 of the input", bench.input_sha256);
  const std::string settings = one_line(bench.settings);
  facts.entries.emplace_back("Settings", settings.empty() ? "as in the input" : settings);
  facts.entries.emplace_back("Surfaces as given", bench.truth);
  facts.entries.emplace_back("Time for a measure", duration_text(io::rounded(bench.seconds_per_measure, Digits::six)));
  facts.entries.emplace_back("Time of the whole run", duration_text(io::rounded(bench.seconds, Digits::six)));
  return facts;
}

/// The names of representations in the order of the file; one a pair of rows.
std::vector<std::string> names_of(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    if (ranges::find(names, row.label) == names.end()) names.push_back(row.label);
  return names;
}

struct Quantity {
  const char* name;
  const char* key;
};

/// Points over the representations, a series a quantity of one body.
Panel panel_of(const std::vector<Row>& rows, const char* label, const char* unit, double factor,
               const std::vector<Quantity>& quantities, bool wheel) {
  const std::vector<std::string> names = names_of(rows);
  Panel panel{label, unit, true};
  for (const Quantity& quantity : quantities) {
    Series series{quantity.name, std::vector<double>(names.size(), NAN), {}, Series::Marks::points,
                  false,         std::vector<std::string>(names.size())};
    for (const Row& row : rows) {
      if (row.wheel != wheel) continue;
      const auto place = static_cast<std::size_t>(ranges::find(names, row.label) - names.begin());
      const double value = factor * row.number(quantity.key);
      series.y[place] = value > 0.0 ? value : NAN;
      series.texts[place] = fmt::format("{}, {}: {} {}", row.label, quantity.name, shown({value, 3}), unit);
    }
    if (ranges::any_of(series.y, [](double y) { return std::isfinite(y); })) panel.series.push_back(std::move(series));
  }
  return panel;
}

/// The same quantity of wheel and rail.
Panel both_bodies(const std::vector<Row>& rows, const char* label, const char* unit, double factor, const char* key) {
  Panel panel = panel_of(rows, label, unit, factor, {{"wheel", key}}, true);
  Panel rail = panel_of(rows, label, unit, factor, {{"rail", key}}, false);
  panel.series.insert(panel.series.end(), rail.series.begin(), rail.series.end());
  return panel;
}

ChartView chart_of(const std::vector<Row>& rows, std::vector<Panel> panels) {
  ChartView view;
  Axis axis{"representation", ""};
  axis.labels = names_of(rows);
  for (std::size_t i = 0; i < axis.labels.size(); ++i) axis.values.push_back(static_cast<double>(i));
  view.x = std::move(axis);
  for (Panel& panel : panels)
    if (!panel.series.empty()) view.panels.push_back(std::move(panel));
  return view;
}

Section charts_of(const std::vector<Row>& rows) {
  const std::vector<Quantity> heights{{"level", "ns_per_height"},
                                      {"tilted", "ns_per_height_tilted"},
                                      {"tilted, with slopes", "ns_per_normal"},
                                      {"what the offsets lie on", "base_ns_per_height"}};
  const std::vector<Quantity> detection{{"first search", "search_cold_s"},
                                        {"after a small move", "search_warm_s"},
                                        {"undeformed distance", "distance_s"}};
  Section section{"costs", "Costs"};
  const auto add = [&](const char* id, const char* title, ChartView view, const char* note) {
    if (!view.panels.empty()) section.blocks.emplace_back(Figure{id, title, std::move(view), note});
  };
  add("heights", "Time of a height",
      chart_of(rows, {panel_of(rows, "on the wheel", "ns", 1.0, heights, true),
                      panel_of(rows, "on the rail", "ns", 1.0, heights, false)}),
      "Level: the plane is level with the body. Tilted: rolled, yawed and pitched by 0.05, 0.03 and 0.02 rad.");
  add("detection", "Contact detection",
      chart_of(rows, {panel_of(rows, "wheel on rail", "ms", kMilli, detection, true)}),
      "Wheel and rail both in this representation.");
  add("memory", "Size, construction and accuracy",
      chart_of(rows, {both_bodies(rows, "memory", "MB", kMegabytes, "memory_bytes"),
                      both_bodies(rows, "time to build", "ms", kMilli, "build_s"),
                      both_bodies(rows, "largest deviation", "µm", 1.0, "difference_um")}),
      "Deviation: largest normal distance from the surface as given. Zero is not shown.");
  return section;
}

Table table_of(const std::vector<Row>& rows) {
  Table table{"rows",
              "All figures. Times stand only where everything agrees.",
              {{"representation"}, {"resolution", "mm"}, {"body"}, {"agrees"}}};
  for (const Row& row : rows)
    table.rows.push_back({{row.data->backend, Number{row.number("resolution_mm")}, row.body(),
                           std::string(row.data->agrees ? "yes" : "no")}});
  for (const auto& column : columns<BenchRow>()) {
    if (column.label.empty()) continue;
    const std::string_view unit = column.unit.name;
    const bool memory = unit == "bytes";
    table.columns.push_back({std::string(column.label), memory         ? "MB"
                                                        : unit == "um" ? "µm"
                                                        : unit == "1"  ? ""
                                                                       : std::string(unit)});
    for (std::size_t i = 0; i < rows.size(); ++i)
      table.rows[i].cells.emplace_back(
          Number{(memory ? kMegabytes : 1.0) * rows[i].number(column.key), unit == "1" ? 12 : 3});
  }
  table.columns.push_back({"reason"});
  for (std::size_t i = 0; i < rows.size(); ++i) table.rows[i].cells.emplace_back(rows[i].data->reason);
  return table;
}

}  // namespace

Page bench_page(const BenchReport& bench, std::string document) {
  const std::vector<Row> rows = rows_of(bench);
  const std::string& input = bench.input_file;
  Page page{"bench", input.empty() ? "Costs of surfaces" : fmt::format("Costs of surfaces: {}", title_of({}, input)),
            fmt::format("{} in {} on {}", counted(rows.size(), "row"), counted(names_of(rows).size(), "representation"),
                        bench.machine)};
  page.document = std::move(document);
  Section overview{"overview", "Overview"};
  add_banners(bench, rows, overview);
  overview.blocks.emplace_back(cards_of(bench, rows));
  page.sections.push_back(std::move(overview));
  if (Section charts = charts_of(rows); !charts.blocks.empty()) page.sections.push_back(std::move(charts));
  page.sections.push_back({"figures", "Figures", {table_of(rows)}});
  add_origin(page, bench, facts_of(bench));
  return page;
}

Page bench_page(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "bench.json";
  return bench_page(read_bench(file), io::profiles::read_text(file, "result", {}));
}

}  // namespace treadmark::app::pages
