// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>

#include "treadmark/app/lists/result_list.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/settings/key_words.hpp"
#include "treadmark/io/tables/shown.hpp"

namespace treadmark::app {
namespace {

std::vector<std::size_t> shown_columns(const ResultList& list) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < list.numbers.size(); ++k)
    if (list.numbers[k].shown) out.push_back(k);
  return out;
}

double number_of(const ListRow& row, std::size_t column) {
  return column < row.numbers.size() ? row.numbers[column] : std::nan("");
}

/// A number of all rows that have it, from the worst row to the best.
report::ChartView column_view(const std::vector<const ListRow*>& rows, const ListColumn& column, std::size_t k) {
  report::ChartView view;
  constexpr std::size_t kMostNames = 40;
  const bool named = rows.size() <= kMostNames;
  view.x = report::Axis{named ? "from the worst to the best" : "rank, 1 is the worst", ""};
  for (const ListRow* row : rows)
    if (named) view.x->labels.push_back(row->name);
  report::Series series{"", {}};
  series.marks = report::Series::Marks::points;
  double place = named ? -1.0 : 0.0;  // names count from 0
  for (const ListRow* row : rows) {
    ++place;
    if (!row->error.empty() || std::isnan(number_of(*row, k))) continue;
    series.x.push_back(place);
    series.y.push_back(number_of(*row, k));
    series.texts.push_back(row->name);
  }
  const io::KeyWords words = io::words_of_key(column.name);
  view.panels.push_back({words.name, words.unit, false, {std::move(series)}, column.levels});
  return view;
}

}  // namespace

std::string list_text(const ResultList& list) {
  const std::vector<std::size_t> columns = shown_columns(list);
  std::vector<std::vector<std::string>> lines{{"name", "status"}};
  for (const std::size_t k : columns) lines.front().push_back(list.numbers[k].name);
  std::string failed;
  for (const ListRow* row : list.worst_first()) {
    if (!row->error.empty()) {
      failed += fmt::format("{}: failed: {}\n", row->name, row->error);
      continue;
    }
    lines.push_back({row->name, row->status});
    for (const std::size_t k : columns) {
      const double value = number_of(*row, k);
      lines.back().push_back(std::isnan(value) ? "-" : fmt::format("{:.3f}", value + 0.0));
    }
  }
  return failed + (lines.size() > 1 ? io::table_text(lines, {1}) : std::string()) +
         fmt::format("{} {}, {} failed\n", list.rows.size(), list.things, list.failed());
}

std::string list_csv(const ResultList& list) {
  std::string out = "name";
  for (const std::string& name : list.words) out += ',' + name;
  out += ",status,error";
  for (const ListColumn& column : list.numbers) out += ',' + column.name;
  out += '\n';
  for (const ListRow& row : list.rows) {
    out += io::csv_cell(row.name);
    for (std::size_t k = 0; k < list.words.size(); ++k)
      out += ',' + (k < row.words.size() ? io::csv_cell(row.words[k]) : std::string());
    out += ',' + io::csv_cell(row.status) + ',' + io::csv_cell(row.error);
    for (std::size_t k = 0; k < list.numbers.size(); ++k) out += ',' + io::csv_cell(number_of(row, k));
    out += '\n';
  }
  return out;
}

void write_list_store(const std::filesystem::path& file, const ResultList& list) {
  io::Hdf5Writer out(file);
  const std::vector<io::Attribute> identity{{"format", std::string("treadmark-list-1")},
                                            {"version", std::string(version())},
                                            {"title", list.title},
                                            {"settings", list.settings}};
  out.root().add(identity);
  const auto texts = [&](const std::string& name, const char* meaning, auto value) {
    std::vector<std::string> all;
    for (const ListRow& row : list.rows) all.push_back(value(row));
    out.root().write({name, {all.size()}, "1", meaning}, std::span<const std::string>(all));
  };
  texts("name", "of the row", [](const ListRow& row) { return row.name; });
  texts("status", "of the row", [](const ListRow& row) { return row.status; });
  texts("error", "why there are no numbers", [](const ListRow& row) { return row.error; });
  for (std::size_t k = 0; k < list.words.size(); ++k)
    texts(list.words[k], "as it was given",
          [&](const ListRow& row) { return k < row.words.size() ? row.words[k] : std::string(); });
  for (std::size_t k = 0; k < list.numbers.size(); ++k) {
    std::vector<double> all;
    for (const ListRow& row : list.rows) all.push_back(number_of(row, k));
    const std::string& name = list.numbers[k].name;
    const std::string unit = io::words_of_key(name).unit;
    out.root().write({name, {all.size()}, unit.empty() ? "1" : unit, "the unit ends the name"},
                     std::span<const double>(all));
  }
  out.commit();
}

report::Page list_page(const ResultList& list) {
  const std::vector<const ListRow*> rows = list.worst_first();
  const std::vector<std::size_t> columns = shown_columns(list);
  report::Page page{"list", list.title, fmt::format("{} {}, the worst first", list.rows.size(), list.things)};
  report::Section overview{"overview", "Overview"};
  report::Cards cards;
  cards.cards.push_back({list.things, fmt::format("{}", list.rows.size()), fmt::format("{} failed", list.failed())});
  std::vector<std::string> statuses;
  for (const ListRow& row : list.rows)
    if (row.error.empty() && ranges::find(statuses, row.status) == statuses.end()) statuses.push_back(row.status);
  for (const std::string& status : statuses)
    cards.cards.push_back({status, fmt::format("{}", ranges::count(list.rows, status, &ListRow::status)), ""});
  overview.blocks.emplace_back(std::move(cards));
  report::Facts facts;
  facts.entries = {{"version", std::string(version())}, {"settings", list.settings}};
  overview.blocks.emplace_back(std::move(facts));
  page.sections.push_back(std::move(overview));

  report::Section all{"list", "All " + list.things};
  report::Table table{"rows", "From the worst to the best", {{"name"}, {"status"}}};
  for (const std::size_t k : columns) {
    io::KeyWords words = io::words_of_key(list.numbers[k].name);
    table.columns.push_back({std::move(words.name), std::move(words.unit)});
  }
  for (const ListRow* row : rows) {
    report::Table::Row cells{{row->name, row->error.empty() ? row->status : "failed: " + row->error}};
    for (const std::size_t k : columns) cells.cells.emplace_back(report::Number{number_of(*row, k)});
    table.rows.push_back(std::move(cells));
  }
  all.blocks.emplace_back(std::move(table));
  page.sections.push_back(std::move(all));
  report::Section charts{"numbers", "Numbers"};
  for (const std::size_t k : columns) {
    report::ChartView view = column_view(rows, list.numbers[k], k);
    if (view.panels.front().series.front().y.empty()) continue;
    std::string title = view.panels.front().label;
    charts.blocks.emplace_back(report::Figure{fmt::format("column-{}", k), std::move(title), std::move(view),
                                              "each point is a row of the table, in its order"});
  }
  if (!charts.blocks.empty()) page.sections.push_back(std::move(charts));
  return page;
}

}  // namespace treadmark::app
