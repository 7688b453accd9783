// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/simulation/pages/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/app/simulation/pages/history_panels.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/number_text.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/histories/study_store.hpp"
#include "treadmark/io/settings/key_words.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

constexpr std::size_t kMostPoints = 1200, kMostPointsOfAll = 200'000;  // of the history of a run, and of all runs
constexpr std::size_t kFewestPoints = 100;
const std::vector<std::string> kQuantities{"q_max_N", "q_min_N", "ty_max_N", "pmax_Pa", "Fn_max_N", "approach_max_m"};
const std::vector<std::pair<std::string, std::string>> kColumns{
    {"Q_N", "vertical force Q"}, {"Ty_N", "lateral creep force T_y"}, {"pmax_Pa", "largest pressure"}};

const std::string kDistance = "x_m", kCase = "case";  // what histories of simulations and of case files are over

/// Values of a key in the runs; nothing unless all are numbers and some differ.
std::optional<std::vector<double>> numbers_of(const io::StudyTable& table, const std::string& key) {
  std::vector<double> out;
  for (const io::SimulationRun* run : table.runs) {
    const std::string* text = io::swept_value(*run, key);
    const auto number = text ? finite_number(*text) : std::nullopt;
    if (!number) return {};
    out.push_back(*number);
  }
  if (out.empty() || ranges::min(out) == ranges::max(out)) return {};
  return out;
}

std::string unit_of_key(const std::string& key) { return io::words_of_key(key).unit; }

std::string run_name(const io::SimulationRun& run) {
  return fmt::format("run {}{}{}", run.number, run.label.empty() ? "" : ": ", run.label);
}

/// A key as the study calls it, without the unit that its label may end with: the axis has one.
std::string name_of_key(const io::StudyResult& study, const std::string& key) {
  const std::string& label = io::label_of_key(study, key);
  const std::string unit = " [" + unit_of_key(key) + "]";
  if (label == key) return io::words_of_key(key).name;
  return label.ends_with(unit) ? label.substr(0, label.size() - unit.size()) : label;
}

/// What tells the lines of a chart over one key apart: the values of all other keys.
std::string line_name(const io::StudyResult& study, const io::SimulationRun& run, const io::StudyTable& table,
                      const std::string& key) {
  std::string name;
  for (const std::string& other : table.keys) {
    if (other == key) continue;
    const std::string* value = io::swept_value(run, other);
    const std::string unit = unit_of_key(other);
    name += fmt::format("{}{} {}{}{}", name.empty() ? "" : ", ", name_of_key(study, other), value ? *value : "–",
                        unit.empty() ? "" : " ", unit);
  }
  return name.empty() ? "all runs" : name;
}

/// Quantities over a swept key, as the figure of forces by speed in papers: a line for each choice of the other keys.
ChartView over_key(const io::StudyResult& study, const io::StudyTable& table, const std::string& key,
                   const std::vector<double>& x) {
  ChartView view;
  view.x = Axis{name_of_key(study, key), unit_of_key(key), false, {}};
  for (const std::string& quantity : kQuantities) {
    const auto known = ranges::find(table.quantities, quantity, &io::NamedValue::name);
    if (known == table.quantities.end()) continue;
    const ShownUnit unit = shown_unit(quantity);
    Panel panel{known->description, unit.name};
    std::map<std::string, std::vector<std::size_t>> lines;
    std::vector<std::string> order;
    for (std::size_t i = 0; i < table.runs.size(); ++i) {
      const std::string name = line_name(study, *table.runs[i], table, key);
      if (!lines.contains(name)) order.push_back(name);
      lines[name].push_back(i);
    }
    for (const std::string& name : order) {
      std::vector<std::size_t>& runs = lines[name];
      ranges::stable_sort(runs, {}, [&](std::size_t i) { return x[i]; });
      Series series{name, {}};
      series.marks = Series::Marks::both;
      for (const std::size_t i : runs) {
        series.x.push_back(x[i]);
        series.y.push_back(unit.factor * io::summary_value(*table.runs[i], quantity));
        series.steps.push_back(static_cast<double>(i));
        series.texts.push_back(run_name(*table.runs[i]));
      }
      panel.series.push_back(std::move(series));
    }
    view.panels.push_back(std::move(panel));
  }
  return view;
}

/// The history of the run that is chosen.
ChartView history_by_run(const io::StudyTable& table) {
  ChartView view;
  view.x = Axis{"distance travelled", "m", false, {}};
  for (const auto& [column, label] : kColumns)
    view.panels.push_back({label, shown_unit(column).name, false, {Series{label, {}}}});
  const std::size_t most =
      std::clamp(kMostPointsOfAll / std::max<std::size_t>(1, table.runs.size()), kFewestPoints, kMostPoints);
  for (const io::SimulationRun* run : table.runs) {
    ChartView::Curves curves;
    curves.y.assign(kColumns.size(), std::vector<std::vector<double>>(1));
    if (!run->store.empty()) {
      const io::SimulationResult result = io::read_simulation(run->store);
      const std::vector<std::size_t> rows = thinned_rows(result, {"Q_N", "Ty_N", "pmax_Pa"}, most);
      const std::string& x = result.columns.empty() || result.columns.front().name == "case" ? kCase : kDistance;
      if (x == kCase) view.x = Axis{"case", ""};
      curves.x = column_at(result, x, rows).value_or(std::vector<double>());
      for (std::size_t k = 0; k < kColumns.size(); ++k)
        curves.y[k][0] = column_at(result, kColumns[k].first, rows).value_or(std::vector<double>(curves.x.size(), NAN));
    }
    view.by_step.push_back(std::move(curves));
  }
  return view;
}

bool has_history(const ChartView& view) {
  return ranges::any_of(view.by_step, [](const ChartView::Curves& curves) { return curves.x.size() > 1; });
}

Table run_table(const io::StudyTable& table) {
  Table out{"runs", "Runs of the study", {{"run"}}};
  for (const std::string& key : table.keys) out.columns.push_back({io::words_of_key(key).name, unit_of_key(key)});
  for (const io::NamedValue& quantity : table.quantities)
    out.columns.push_back({shown_name(quantity.name), shown_unit(quantity.name).name});
  out.columns.push_back({"status"});
  out.columns.push_back({"message"});
  for (std::size_t i = 0; i < table.runs.size(); ++i) {
    const io::SimulationRun& run = *table.runs[i];
    Table::Row row{{Number{static_cast<double>(run.number)}}, static_cast<int>(i)};
    for (const std::string& key : table.keys) {
      const std::string* value = io::swept_value(run, key);
      const auto number = value ? finite_number(*value) : std::nullopt;
      row.cells.emplace_back(number ? Cell(Number{*number}) : Cell(value ? *value : std::string()));
    }
    for (const io::NamedValue& quantity : table.quantities)
      row.cells.emplace_back(Number{shown_unit(quantity.name).factor * io::summary_value(run, quantity.name)});
    row.cells.emplace_back(run.status);
    row.cells.emplace_back(run.message);
    out.rows.push_back(std::move(row));
  }
  return out;
}

Section overview(const StudyOnDisk& disk, const io::StudyTable& table) {
  const io::StudyResult& study = disk.study;
  Section section{"overview", "Overview"};
  if (!disk.unfinished.empty()) {
    std::string numbers;
    for (std::size_t k = 0; k < std::min<std::size_t>(12, disk.unfinished.size()); ++k)
      numbers += fmt::format("{}{}", k > 0 ? ", " : "", disk.unfinished[k]);
    section.blocks.emplace_back(Banner{
        Banner::Kind::failed, "Not finished.",
        fmt::format("{} missing: run {}{}. The same treadmark sweep command goes on.",
                    counted(disk.unfinished.size(), "run"), numbers, disk.unfinished.size() > 12 ? " ..." : "")});
  }
  std::size_t failed = 0;
  std::string first;
  for (const io::SimulationRun& run : study.runs)
    if (run.status != "complete") {
      ++failed;
      if (first.empty())
        first = fmt::format("{}: {}{}{}", run_name(run), run.status, run.message.empty() ? "" : ", ", run.message);
    }
  if (failed > 0)
    section.blocks.emplace_back(
        Banner{Banner::Kind::failed, counted(failed, "run") + " did not complete.", "The first: " + first});
  Cards cards;
  cards.cards.push_back(
      {"Runs", fmt::format("{} of {}", study.runs.size(), study.runs.size() + disk.unfinished.size())});
  for (const std::string& quantity : kQuantities) {
    double most = NAN;
    std::string where;
    for (const io::SimulationRun* run : table.runs) {
      const double value = io::summary_value(*run, quantity);
      if (std::isfinite(value) && !(quantity == "q_min_N" ? value >= most : value <= most)) {
        most = value;
        where = run_name(*run);
      }
    }
    if (std::isnan(most)) continue;
    const auto known = ranges::find(table.quantities, quantity, &io::NamedValue::name);
    const ShownUnit unit = shown_unit(quantity);
    cards.cards.push_back({known->description, fmt::format("{} {}", shown({unit.factor * most}), unit.name), where});
  }
  section.blocks.emplace_back(std::move(cards));
  return section;
}

}  // namespace

Page sweep_page(const StudyOnDisk& disk) {
  const io::StudyTable table = io::study_table(disk.study);
  Page page{"sweep", title_of(disk.study.title, disk.study.input_file), ""};
  std::vector<std::string> names;
  for (const std::string& key : table.keys) names.push_back(name_of_key(disk.study, key));
  page.lead = fmt::format("Study of {} over {}", counted(table.runs.size(), "run"), fmt::join(names, ", "));
  page.full_data = "sweep.h5";
  page.sections.push_back(overview(disk, table));
  if (!table.runs.empty()) {
    Timeline timeline{"run"};
    for (const io::SimulationRun* run : table.runs) {
      if (run->status != "complete") timeline.notable.push_back(timeline.names.size());
      timeline.names.push_back(run_name(*run));
    }
    Section summaries{"summaries", "Summaries"};
    int number = 0;
    for (const std::string& key : table.keys)
      if (const auto x = numbers_of(table, key)) {
        const std::string name = name_of_key(disk.study, key);
        timeline.axes.push_back({name, unit_of_key(key), false, *x});
        if (ChartView view = over_key(disk.study, table, key, *x); !view.panels.empty())
          summaries.blocks.emplace_back(Figure{fmt::format("summary-{}", ++number), "Over " + name, std::move(view),
                                               "A click on a point chooses its run."});
      }
    Axis runs{"run", ""};
    for (const io::SimulationRun* run : table.runs) runs.values.push_back(run->number);
    timeline.axes.push_back(std::move(runs));
    page.timeline = std::move(timeline);
    if (!summaries.blocks.empty()) page.sections.push_back(std::move(summaries));
    if (ChartView history = history_by_run(table); has_history(history))
      page.sections.push_back(
          {"history", "History of a run", {Figure{"history-of-run", "Forces of the chosen run", std::move(history)}}});
    page.sections.push_back({"runs", "Runs", {run_table(table)}});
  }
  Section pictures{"figures", "Figures of the study"};
  for (const auto& [name, svg] : disk.pictures)
    pictures.blocks.emplace_back(Figure{"picture-" + name, name, PictureView{svg}});
  if (!pictures.blocks.empty()) page.sections.push_back(std::move(pictures));
  add_origin(page, disk.study);
  return page;
}

namespace {

namespace fs = std::filesystem;

/// Numbers of all runs of the study, from its identity: lines "run 12".
std::vector<int> runs_of(const fs::path& file) {
  std::istringstream lines(io::profiles::read_text(file, "study", {}));
  std::vector<int> numbers;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("run ")) continue;
    int number = 0;
    const char* end = line.data() + line.size();
    const auto [at, error] = from_chars(line.data() + 4, end, number);
    if (error != std::errc() || at != end || number < 1)
      throw Error(ErrorKind::input_data, fmt::format("\"{}\" names no run", line), {file.string()},
                  "give a folder that treadmark sweep wrote");
    numbers.push_back(number);
  }
  return numbers;
}

std::string label_of(const std::vector<std::pair<std::string, std::string>>& swept) {
  std::string label;
  for (const auto& [key, value] : swept) label += (label.empty() ? "" : ", ") + value;
  return label;
}

}  // namespace

StudyOnDisk read_study_folder(const fs::path& folder) {
  StudyOnDisk out;
  const fs::path whole = folder / "sweep.h5";  // written when all runs are finished
  if (fs::exists(whole)) out.study = io::read_study_head(whole);
  if (out.study.input_file.empty())
    out.study.input_file =
        folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
  for (const int number : runs_of(folder / "study.id")) {
    const fs::path store = folder / "runs" / fmt::format("run_{:04}", number) / "simulation.h5";
    if (!fs::exists(store)) {
      out.unfinished.push_back(static_cast<std::size_t>(number));
      continue;
    }
    io::SimulationResult run = io::read_simulation_head(store);
    if (out.study.version.empty()) {
      out.study.version = run.version;
      out.study.git = run.git;
      out.study.input_sha256 = run.input_sha256;
      out.study.title = run.title;
      out.study.inputs = run.inputs;
    }
    out.study.runs.push_back({number, run.swept, label_of(run.swept), run.status, run.message, run.summary, store});
  }
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".svg") pictures.push_back(entry.path());
  ranges::sort(pictures);
  for (const fs::path& picture : pictures)
    out.pictures.emplace_back(picture.filename().string(), io::profiles::read_text(picture, "study", {}));
  return out;
}

}  // namespace treadmark::app::pages
