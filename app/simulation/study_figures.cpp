// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/study_figures.hpp"

#include <map>

#include <fmt/format.h>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/case_run.hpp"
#include "treadmark/app/simulation/history_record.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/simulations/table_reader.hpp"
#include "treadmark/report/pictures/histories/history_svg.hpp"
#include "treadmark/report/pictures/histories/summary_svg.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

/// How quantities of a unit are drawn.
struct ShownUnit {
  double factor = 1.0;
  std::string name;
};
ShownUnit shown_unit(const std::string& column) {
  const auto ends = [&](const char* unit) { return column.ends_with(unit); };
  if (ends("_Pa")) return {1e-6, "MPa"};
  if (ends("_N")) return {1e-3, "kN"};
  if (ends("_m2")) return {1e6, "mm2"};
  const auto unit = column.rfind('_');
  return {1.0, unit == std::string::npos ? "" : column.substr(unit + 1)};
}

std::string label_of(const std::string& column, const std::string& given) {
  if (!given.empty()) return given;
  const auto unit = column.rfind('_');
  const ShownUnit shown = shown_unit(column);
  return column.substr(0, unit) + (shown.name.empty() ? "" : " [" + shown.name + "]");
}

pictures::HistoryAxis axis(const std::string& column, const std::string& label) {
  return {column, label_of(column, label), shown_unit(column).factor};
}

fs::path csv_of(fs::path svg) { return svg.replace_extension(".csv"); }

/// "V = 6 m/s" of a variation called "V [m/s]".
std::string named_value(const io::Variation& variation, const std::string& value) {
  const std::string& name = variation.label;
  if (name.empty()) return value;
  const auto unit = name.rfind(" [");
  if (unit == std::string::npos || !name.ends_with(']')) return name + " = " + value;
  return name.substr(0, unit) + " = " + value + ' ' + name.substr(unit + 2, name.size() - unit - 3);
}

class Figures {
 public:
  Figures(const io::StudyFile& file, const fs::path& folder, const io::StudyResult& study)
      : file_(file), folder_(folder), study_(study) {}

  void draw(const io::StudyFigure& figure) {
    switch (figure.kind) {
      case io::StudyFigure::Kind::history:
        draw_history(figure);
        break;
      case io::StudyFigure::Kind::summary:
        draw_summary(figure);
        break;
      case io::StudyFigure::Kind::patches:
        break;  // refused beforehand
    }
  }

 private:
  const io::SimulationResult& result_of(const io::SimulationRun& run) {
    const auto found = results_.find(run.number);
    if (found != results_.end()) return found->second;
    return results_.emplace(run.number, io::read_simulation(run.store)).first->second;
  }

  bool is_drawn(const io::StudyFigure& figure, const io::SimulationRun& run) const {
    const auto& values = file_.runs.at(static_cast<std::size_t>(run.number - 1)).values;
    for (std::size_t v = 0; v < figure.only.size(); ++v)
      if (!figure.only[v].empty() && ranges::find(figure.only[v], values.at(v)) == figure.only[v].end()) return false;
    return true;
  }

  /// The value that a run has of the variation that stands for the lines.
  std::string series_of(const io::StudyFigure& figure, const io::SimulationRun& run) const {
    std::string label = run.label;
    for (const auto& [key, value] : run.swept)
      if (key == figure.series) label = value;
    for (const io::Variation& variation : file_.variations) {
      if (variation.key != figure.series && variation.label != figure.series) continue;
      for (std::size_t i = 0; i < variation.values.size() && i < figure.labels.size(); ++i)
        if (variation.values[i].label == label) return figure.labels[i];
    }
    return label;
  }

  void draw_history(const io::StudyFigure& figure) {
    pictures::HistoryChart chart;
    chart.title = figure.title;
    chart.x = axis(figure.x.empty() ? "t_s" : figure.x, figure.x_label);
    for (const std::string& column : figure.y)
      chart.y.push_back(axis(column, figure.y.size() == 1 ? figure.y_label : ""));
    if (figure.x_range) chart.x_range = {(*figure.x_range)[0], (*figure.x_range)[1]};
    std::vector<pictures::HistoryRun> runs;
    for (const io::SimulationRun& run : study_.runs) {
      if (!is_drawn(figure, run)) continue;
      const io::SimulationResult& result = result_of(run);
      if (result.rows() < 2) continue;
      runs.push_back({&result, figure.series.empty() ? run.label : series_of(figure, run), panel_of(figure, run)});
    }
    if (runs.empty()) return;
    const bool multiples =
        ranges::any_of(runs, [&](const pictures::HistoryRun& r) { return r.panel != runs.front().panel; });
    write_file(folder_ / figure.file,
               multiples ? pictures::history_multiples_svg(runs, chart) : pictures::history_svg(runs, chart));
    write_file(csv_of(folder_ / figure.file), pictures::history_chart_csv(runs, chart));
  }

  /// Runs that differ in more than the lines' variation stand in panels of their own, where one quantity is drawn.
  std::string panel_of(const io::StudyFigure& figure, const io::SimulationRun& run) const {
    if (figure.series.empty() || figure.y.size() != 1) return {};
    std::string panel;
    for (std::size_t v = 0; v < file_.variations.size() && v < run.swept.size(); ++v) {
      const io::Variation& variation = file_.variations[v];
      if (variation.key == figure.series || variation.label == figure.series) continue;
      panel += (panel.empty() ? "" : ", ") + named_value(variation, run.swept[v].second);
    }
    return panel;
  }

  void draw_summary(const io::StudyFigure& figure) {
    pictures::SummaryChart chart;
    chart.title = figure.title;
    chart.key = figure.x;
    chart.x_label = figure.x_label.empty() ? io::label_of_key(study_, figure.x) : figure.x_label;
    chart.quantity = figure.y.front();
    chart.y_label = label_of(chart.quantity, figure.y_label);
    chart.y_factor = shown_unit(chart.quantity).factor;
    for (const io::FigureMark& mark : figure.marks) chart.references.push_back({mark.x, mark.y, mark.label});
    if (chart.quantity == "q_max_N" && !study_.runs.empty()) {
      const double at_rest = io::summary_value(study_.runs.front(), "q_static_N");
      if (at_rest > 0.0) {
        chart.level = at_rest;
        chart.level_label = "at rest";
      }
    }
    io::StudyResult drawn = study_;
    std::erase_if(drawn.runs, [&](const io::SimulationRun& run) { return !is_drawn(figure, run); });
    write_file(folder_ / figure.file, pictures::summary_svg(drawn, chart));
    write_file(csv_of(folder_ / figure.file), pictures::summary_chart_csv(drawn, chart));
  }

  const io::StudyFile& file_;
  const fs::path& folder_;
  const io::StudyResult& study_;
  std::map<int, io::SimulationResult> results_;
};

RunNames names_of(const io::StudyFile& file, const io::StudyRun& of) {
  const auto run = io::read_study_run(file, of);
  const auto* simulation = std::get_if<io::SimulationFile>(&run);
  if (simulation == nullptr) return case_run_names();
  RunNames names{{}, HistorySummary::names(*simulation)};
  for (const io::HistoryColumn& column : history_columns(*simulation)) names.columns.push_back(column.name);
  return names;
}

/// What the runs of a study can show. Those count that differ from the first one in one variation at most.
class NamesOfStudy {
 public:
  explicit NamesOfStudy(const io::StudyFile& file) : file_(file), names_(names_of(file, file.runs.front())) {}

  void require(const std::string& what, const std::string& name, std::vector<std::string> RunNames::*list,
               const SourcePosition& where) {
    while (ranges::find(names_.*list, name) == (names_.*list).end() && add_next()) {
    }
    io::check_name(what, name, names_.*list, where);
  }

 private:
  bool add_next() {
    const auto is_asked = [](const io::StudyRun& run) {
      return ranges::count_if(run.values, [](std::size_t value) { return value != 0; }) == 1;
    };
    while (++next_ < file_.runs.size())
      if (const io::StudyRun& run = file_.runs[next_]; is_asked(run)) {
        const RunNames more = names_of(file_, run);
        for (auto list : {&RunNames::columns, &RunNames::summary})
          for (const std::string& name : more.*list)
            if (ranges::find(names_.*list, name) == (names_.*list).end()) (names_.*list).push_back(name);
        return true;
      }
    return false;
  }

  const io::StudyFile& file_;
  RunNames names_;
  std::size_t next_ = 0;
};

}  // namespace

void check_study_figures(const io::StudyFile& file) {
  if (file.figures.empty() || file.runs.empty()) return;
  std::vector<std::string> keys;
  for (const auto& [key, value] : swept_of(file, file.runs.front())) keys.push_back(key);
  NamesOfStudy names(file);
  const auto refuse = [&](const io::StudyFigure& figure, const std::string& what, const std::string& advice) {
    throw Error(ErrorKind::configuration, fmt::format("figure {}: {}", figure.file.string(), what),
                {file.path.string()}, advice);
  };
  for (const io::StudyFigure& figure : file.figures) {
    if (figure.kind == io::StudyFigure::Kind::patches)
      refuse(figure, "contact patches are drawn by `treadmark simulate` of one run",
             "use kind = \"history\" or \"summary\" in a study");
    if (figure.kind == io::StudyFigure::Kind::summary && figure.y.size() != 1)
      refuse(figure, "a summary shows one quantity", "make a figure for each");
    if (figure.kind == io::StudyFigure::Kind::summary && ranges::find(keys, figure.x) == keys.end())
      refuse(figure, fmt::format("x = '{}' is no varied key", figure.x),
             fmt::format("varied keys: {}", fmt::join(keys, ", ")));
    const std::string name = "figure " + figure.file.string();
    const bool of_histories = figure.kind == io::StudyFigure::Kind::history;
    for (std::size_t i = 0; i < figure.y.size(); ++i)
      names.require(name + (of_histories ? ": the column" : ": the quantity"), figure.y[i],
                    of_histories ? &RunNames::columns : &RunNames::summary, figure.y_where[i]);
    if (of_histories) names.require(name + ": the column", figure.x, &RunNames::columns, figure.x_where);
  }
}

void write_study_figures(const io::StudyFile& file, const fs::path& folder, const io::StudyResult& study) {
  check_study_figures(file);
  Figures figures(file, folder, study);
  for (const io::StudyFigure& figure : file.figures) figures.draw(figure);
}

}  // namespace treadmark::app
