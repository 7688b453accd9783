// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/pages/simulation_overlay_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/cases/pages/run_overlay_page.hpp"
#include "treadmark/app/pages/overlay_parts.hpp"
#include "treadmark/app/simulation/pages/history_panels.hpp"
#include "treadmark/app/simulation/pages/simulation_page.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/row_blocks.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using Simulation = io::SimulationResult;
using Simulations = std::vector<Overlaid<Simulation>>;

constexpr std::size_t kMostPointsOfCurve = 3000;  // of a curve

constexpr std::pair<const char*, const char*> kShownColumns[] = {
    {"Q_N", "vertical force Q"},         {"Y_N", "lateral force Y"},
    {"Ty_N", "lateral creep force T_y"}, {"Tx_N", "longitudinal creep force T_x"},
    {"pmax_Pa", "largest pressure"},     {"area_m2", "contact area"},
    {"gap_m", "least distance"},         {"rail_z_m", "vertical displacement of the rail"}};

const io::HistoryColumn* column_of(const Simulation& simulation, const std::string& name) {
  const auto at = ranges::find(simulation.columns, name, &io::HistoryColumn::name);
  return at == simulation.columns.end() ? nullptr : &*at;
}

std::vector<double> values_of(const Simulation& simulation, const io::HistoryColumn& column) {
  return io::column_values(simulation, static_cast<std::size_t>(&column - simulation.columns.data()));
}

/// The curves of all simulations over a column that all of them have.
std::optional<Figure> histories_over(const Simulations& all, const std::string& abscissa, const char* id,
                                     const char* title, const char* label) {
  ChartView view;
  const ShownUnit unit = shown_unit(abscissa);
  view.x = Axis{label, unit.name};
  for (const auto& [name, simulation] : all)
    if (column_of(simulation, abscissa) == nullptr) return {};
  for (const auto& [column, what] : kShownColumns) {
    Panel panel{what, shown_unit(column).name};
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto& [name, simulation] = all[k];
      const std::vector<std::size_t> rows = thinned_rows(simulation, {column}, kMostPointsOfCurve);
      auto y = column_at(simulation, column, rows);
      if (!y || rows.empty()) continue;
      Series series{name, std::move(*y), *column_at(simulation, abscissa, rows)};
      series.dashed = k > 0;
      panel.series.push_back(std::move(series));
    }
    if (!panel.series.empty()) view.panels.push_back(std::move(panel));
  }
  if (view.panels.empty()) return {};
  return Figure{id, title, std::move(view), "Forces act on the rail."};
}

// ------------------------------------------------------------------------------------------------------------ tables

/// Of a history between its instants, straight from one to the next.
struct Measures {
  double largest = kNaN, least = kNaN, mean = kNaN, rms = kNaN;
};

Measures measures_of(const std::vector<double>& times, const std::vector<double>& values) {
  Measures out;
  double span = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double b = values[i];
    if (!std::isfinite(b)) continue;
    out.largest = std::isnan(out.largest) ? b : std::max(out.largest, b);
    out.least = std::isnan(out.least) ? b : std::min(out.least, b);
    if (i == 0 || !std::isfinite(values[i - 1])) continue;
    const double a = values[i - 1], step = times[i] - times[i - 1];
    span += step;
    sum += step * (a + b) / 2.0;
    squares += step * (a * a + a * b + b * b) / 3.0;
  }
  if (span > 0.0) {
    out.mean = sum / span;
    out.rms = std::sqrt(squares / span);
  }
  return out;
}

struct MeasureRow {
  const char* name;
  double Measures::*member;
  bool of_all;  ///< also of columns that are not drawn: vehicles have a hundred
};
constexpr MeasureRow kMeasures[] = {{"largest", &Measures::largest, true},
                                    {"least", &Measures::least, false},
                                    {"mean", &Measures::mean, false},
                                    {"rms", &Measures::rms, true}};

double largest_size(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::fabs(value));
  return most;
}

Table column_table(const Simulations& all, const std::vector<std::string>& names) {
  Table table{"columns",
              "Histories, of quantities that are not drawn above the largest value and the root mean square only. Mean "
              "and root mean square are those over the time, straight from instant to instant.",
              {{"quantity"}, {"meaning"}, {"unit"}}};
  add_columns(table, names, "", "");
  std::vector<const io::HistoryColumn*> columns;
  for (const auto& [name, simulation] : all)
    for (const io::HistoryColumn& column : simulation.columns)
      if (column.name != "t_s" && column.name != "x_m" &&
          ranges::none_of(columns, [&](const auto* known) { return known->name == column.name; }))
        columns.push_back(&column);
  for (const io::HistoryColumn* column : columns) {
    const ShownUnit unit = shown_unit(column->name);
    std::vector<Measures> measures;
    measures.reserve(all.size());
    for (const auto& [name, simulation] : all) {
      const io::HistoryColumn* here = column_of(simulation, column->name);
      const io::HistoryColumn* time = column_of(simulation, "t_s");
      measures.push_back(here != nullptr && time != nullptr
                             ? measures_of(values_of(simulation, *time), values_of(simulation, *here))
                             : Measures{});
    }
    const bool drawn = ranges::any_of(kShownColumns, [&](const auto& one) { return column->name == one.first; });
    for (const MeasureRow& measure : kMeasures) {
      if (!drawn && !measure.of_all) continue;
      std::vector<double> values;
      values.reserve(measures.size());
      for (const Measures& one : measures) values.push_back(unit.factor * one.*measure.member);
      Table::Row row{{fmt::format("{}, {}", shown_name(column->name), measure.name), column->description,
                      !unit.name.empty()    ? unit.name
                      : column->unit == "1" ? ""
                                            : column->unit}};
      add_cells(row, values, largest_size(values));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table named_table(const char* id, const char* caption, const Simulations& all, const std::vector<std::string>& names,
                  const std::function<const std::vector<io::NamedValue>&(const Simulation&)>& list) {
  Table table{id, caption, {{"quantity"}, {"meaning"}, {"unit"}}};
  add_columns(table, names, "", "");
  std::vector<const io::NamedValue*> rows;
  for (const auto& [name, simulation] : all)
    for (const io::NamedValue& one : list(simulation))
      if (ranges::none_of(rows, [&](const auto* known) { return known->name == one.name; })) rows.push_back(&one);
  for (const io::NamedValue* one : rows) {
    const ShownUnit unit = shown_unit(one->name);
    std::vector<double> values;
    for (const auto& [name, simulation] : all) {
      const auto& here = list(simulation);
      const auto found = ranges::find(here, one->name, &io::NamedValue::name);
      values.push_back(found == here.end() ? kNaN : unit.factor * found->value);
    }
    Table::Row row{{shown_name(one->name), one->description,
                    !unit.name.empty() ? unit.name
                    : one->unit == "1" ? ""
                                       : one->unit}};
    add_cells(row, values, largest_size(values));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table event_table(const Simulations& all) {
  Table table{"events", "Contacts: lost and regained, full and from tables.", {{"simulation"}}};
  for (const auto& [name, simulation] : all) {
    Table own = report::table_of("", "", simulation.events, 6);
    if (table.columns.size() == 1) ranges::copy(own.columns, std::back_inserter(table.columns));
    for (Table::Row& row : own.rows) {
      row.cells.insert(row.cells.begin(), name);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

// ---------------------------------------------------------------------------------------------------------- overview

void add_missing_columns(const Simulations& all, Section& overview) {
  for (const auto& [name, simulation] : all) {
    std::vector<std::string> lacking;
    for (const auto& [other, has] : all)
      for (const io::HistoryColumn& column : has.columns)
        if (column_of(simulation, column.name) == nullptr && ranges::find(lacking, column.name) == lacking.end())
          lacking.push_back(column.name);
    if (!lacking.empty())
      overview.blocks.emplace_back(
          Banner{Banner::Kind::warning, fmt::format("{} has not got {}:", name, counted(lacking.size(), "column")),
                 fmt::format("{}. There is nothing to compare them with.", fmt::join(lacking, ", "))});
  }
}

std::vector<SaidByAll> lines_of(const Simulations& all, const std::vector<Origin>& origins) {
  std::vector<SaidByAll> lines;
  const auto say = [&](const char* what, const std::function<std::string(const Simulation&)>& text) {
    SaidByAll line{what};
    for (const auto& [name, simulation] : all) line.texts.push_back(text(simulation));
    lines.push_back(std::move(line));
  };
  const auto last = [](const Simulation& simulation, const char* column, const char* unit) {
    const io::HistoryColumn* at = column_of(simulation, column);
    return at == nullptr || simulation.rows() == 0 ? std::string("–")
                                                   : fmt::format("{:.6g} {}", values_of(simulation, *at).back(), unit);
  };
  say("title", [](const Simulation& one) { return one.title.empty() ? "–" : one.title; });
  for (SaidByAll& line : origins_of(origins, false)) lines.push_back(std::move(line));
  say("status", [](const Simulation& one) { return one.status; });
  say("ends at", [&](const Simulation& one) { return last(one, "t_s", "s"); });
  say("distance", [&](const Simulation& one) { return last(one, "x_m", "m"); });
  say("instants", [](const Simulation& one) { return fmt::format("{}", one.rows()); });
  return lines;
}

Cards cards_of(const Simulations& all) {
  struct Row {
    const char *label, *name;
  };
  constexpr Row kRows[] = {{"Largest vertical force", "q_max_N"},
                           {"Least vertical force", "q_min_N"},
                           {"Largest pressure", "pmax_Pa"},
                           {"Loss of contact", "contact_lost"}};
  Cards cards;
  const auto value_in = [](const Simulation& simulation, const char* name) {
    const auto at = ranges::find(simulation.summary, name, &io::NamedValue::name);
    return at == simulation.summary.end() ? kNaN : shown_unit(name).factor * at->value;
  };
  for (const Row& row : kRows)
    for (std::size_t k = 1; k < all.size(); ++k) {
      const double first = value_in(all.front().result, row.name), here = value_in(all[k].result, row.name);
      if (!std::isfinite(first) || !std::isfinite(here)) continue;
      std::string where = fmt::format("{} to {}", shown({first}), shown({here}));
      if (all.size() > 2) where += ", " + all[k].name;
      cards.cards.push_back(change_card(row.label, change(first, here, 0.0), shown_unit(row.name).name, where));
    }
  return cards;
}

/// When and at which pitch each simulation has its snapshots; a row a step.
Table snapshot_table(const Simulations& all, const std::vector<std::string>& names) {
  struct Snapshot {
    std::vector<double> times, pitches;
  };
  std::map<int, Snapshot> snapshots;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Simulation& simulation = all[k].result;
    for (std::size_t i = 0; i < simulation.snapshots.cases.size(); ++i) {
      Snapshot& one = snapshots[simulation.snapshots.cases[i].number];
      one.times.resize(all.size(), kNaN);
      one.pitches.resize(all.size(), kNaN);
      if (i < simulation.snapshot_times.size()) one.times[k] = simulation.snapshot_times[i];
      one.pitches[k] = 180.0 / kPi * simulation.snapshots.cases[i].pitch;
    }
  }
  Table table{"snapshots", "Snapshots.", {{"snapshot"}}};
  add_columns(table, names, "t", "s");
  add_columns(table, names, "pitch angle", "°");
  for (const auto& [number, one] : snapshots) {
    Table::Row row{{Number{static_cast<double>(number)}}, static_cast<int>(table.rows.size())};
    add_cells(row, one.times, largest_size(one.times));
    add_cells(row, one.pitches, largest_size(one.pitches));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Contact at the snapshots of all.
std::optional<Section> snapshots_of(Simulations& all, const std::vector<std::string>& results, Page& page) {
  Table table = snapshot_table(all, results);
  Timeline timeline{"snapshot"};
  Axis axis{"snapshot", ""};
  for (const Table::Row& row : table.rows) {
    axis.values.push_back(std::get<Number>(row.cells.front()).value);
    timeline.names.push_back(fmt::format("snapshot {}", axis.values.back()));
    timeline.frames.push_back(row.step);
  }
  timeline.axes.push_back(std::move(axis));
  std::vector<NamedRun> runs;
  std::vector<io::SampledSurface> surfaces;
  for (auto& [name, simulation] : all) {
    take_surfaces(simulation.snapshots, fmt::format("r{}_", runs.size() + 1), surfaces);
    runs.push_back({name, std::make_shared<const io::RunResult>(std::move(simulation.snapshots))});
  }
  if (ranges::none_of(runs, [](const NamedRun& run) { return has_fields(*run.result); })) return {};
  Section section{"contact", "Contact at the snapshots"};
  add_overlaid_contact(page, section, runs, timeline.names, std::move(surfaces));
  section.blocks.emplace_back(std::move(table));
  page.timeline = std::move(timeline);
  return section;
}

}  // namespace

Page simulation_overlay_page(Simulations&& all) {
  if (all.size() < 2) throw Error(ErrorKind::configuration, "one simulation alone cannot be overlaid");
  std::vector<std::string> names;
  std::vector<Origin> origins;
  for (const auto& [name, one] : all) {
    names.push_back(name);
    origins.push_back(one);
  }
  const Simulation& first = all.front().result;
  Page page{"overlay", joined(names), ""};
  page.lead =
      fmt::format("{} overlaid: {}", counted(all.size(), "simulation"), title_of(first.title, first.input_file));
  page.full_data = "simulation.h5";
  Section overview{"overview", "Overview"};
  for (const auto& [name, one] : all) add_simulation_banners(one, overview, name);
  add_missing_columns(all, overview);
  add_version_note(origins, overview);
  const bool equal = ranges::all_of(all, [&](const auto& one) {
    return ranges::equal(one.result.columns, first.columns, {}, &io::HistoryColumn::name, &io::HistoryColumn::name) &&
           ranges::equal(one.result.values, first.values,
                         [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
  });
  if (equal)
    overview.blocks.emplace_back(
        Banner{Banner::Kind::note, "No difference:", "all numbers of the histories are the same."});
  if (Cards cards = cards_of(all); !cards.cards.empty()) overview.blocks.emplace_back(std::move(cards));
  overview.blocks.emplace_back(difference_table(names, lines_of(all, origins)));
  page.sections.push_back(std::move(overview));

  Section histories{"histories", "Histories"};
  if (auto figure = histories_over(all, "x_m", "over-distance", "Over the distance", "distance travelled"))
    histories.blocks.emplace_back(std::move(*figure));
  if (auto figure = histories_over(all, "t_s", "over-time", "Over the time", "time"))
    histories.blocks.emplace_back(std::move(*figure));
  if (!histories.blocks.empty()) page.sections.push_back(std::move(histories));
  if (std::optional<Section> contact = snapshots_of(all, names, page)) page.sections.push_back(std::move(*contact));

  Section tables{"tables",
                 "Tables",
                 {named_table(
                      "summary", "Summary. Differences and changes are to the first.", all, names,
                      [](const Simulation& one) -> const auto& { return one.summary; }),
                  named_table(
                      "static", "Static equilibrium at the start.", all, names,
                      [](const Simulation& one) -> const auto& { return one.statics; }),
                  column_table(all, names)}};
  if (Table events = event_table(all); !events.rows.empty()) tables.blocks.emplace_back(std::move(events));
  page.sections.push_back(std::move(tables));
  page.sections.push_back(origins_section(names, origins));
  return page;
}

}  // namespace treadmark::app::pages
