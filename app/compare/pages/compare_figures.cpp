// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/compare/pages/compare_figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/pictures/comparison_cases.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using Candidate = ComparedCandidate;
using CandidateValue = double (*)(const Candidate&);
constexpr std::size_t kFew = 8;

double pressure_error(const Candidate& c) { return c.judged_error_percent; }
double height(const Candidate& c) { return c.height_max_um; }
double time_ms(const Candidate& c) { return kMilli * c.mean_seconds(); }
double memory(const Candidate& c) { return c.memory_MB; }
double build_ms(const Candidate& c) { return kMilli * c.build_s; }

std::string with_unit(double value, const char* unit) {
  return std::isfinite(value) ? fmt::format("{} {}", shown({value, 3}), unit) : "–";
}

std::string hover(const ComparedCandidates& all, const Candidate& c) {
  return fmt::format("{}: error of the {} {}, surface {}, {} a case, {}", c.label, all.pressure.words,
                     with_unit(c.judged_error_percent, "%"), with_unit(c.height_max_um, "µm"),
                     with_unit(time_ms(c), "ms"), with_unit(c.memory_MB, "MB"));
}

/// Candidates with a resolution by their backends, coarse before fine, in the order in which the backends appear.
std::vector<std::vector<const Candidate*>> by_backend(const ComparedCandidates& all) {
  std::vector<std::vector<const Candidate*>> groups;
  for (const Candidate& c : all.candidates) {
    if (c.as_given()) continue;
    const auto known =
        ranges::find_if(groups, [&](const auto& group) { return group.front()->data->name == c.data->name; });
    if (known == groups.end())
      groups.push_back({&c});
    else
      known->push_back(&c);
  }
  for (auto& group : groups)
    ranges::stable_sort(group,
                        [](const Candidate* a, const Candidate* b) { return a->resolution_mm > b->resolution_mm; });
  return groups;
}

/// Where a value lies on a logarithmic axis; NaN = nowhere.
double placed(double value, double least) {
  if (value >= 0.0 && value < least) return least;
  return value > 0.0 ? value : Candidate::kNone;
}

/// A curve a backend; what has no resolution becomes a level.
Panel over_resolution(const ComparedCandidates& all, const std::string& label, const char* unit, CandidateValue value,
                      double least, bool with_truth) {
  Panel panel{label, unit, true};
  for (const auto& group : by_backend(all)) {
    Series series{group.front()->data->name, {}, {}, Series::Marks::both};
    for (const Candidate* c : group) {
      const double y = placed(value(*c), least);
      if (std::isnan(y)) continue;
      series.x.push_back(c->resolution_mm);
      series.y.push_back(y);
      series.texts.push_back(hover(all, *c));
    }
    if (!series.y.empty()) panel.series.push_back(std::move(series));
  }
  for (const Candidate& c : all.candidates) {
    if (!c.as_given() || (!with_truth && &c == all.truth())) continue;
    const double y = placed(value(c), least);
    if (!std::isnan(y)) panel.levels.push_back({y, c.label + (&c == all.truth() ? " (reference)" : " (as given)")});
  }
  return panel;
}

std::string error_of_pressure(const ComparedCandidates& all) {
  return fmt::format("error of the {}", all.pressure.words);
}

Axis resolution_axis() { return {"resolution", "mm", true}; }

/// A number of the files, in the unit of its name; NaN where it does not exist.
double number_in(const io::ComparedRow& row, std::string_view key) {
  const auto& column = *ranges::find(columns<io::ComparedRow>(), key, &treadmark::Column<io::ComparedRow>::key);
  return column.known(row) ? in_file(column.in_file(row)) : Candidate::kNone;
}

/// Of the numbers that the file has.
double mean(const io::ComparisonCandidate& candidate, double io::ComparisonRow::*value) {
  double sum = 0.0, count = 0.0;
  for (const io::ComparisonRow& row : candidate.rows) {
    if (!std::isfinite(row.*value)) continue;
    sum += in_file(row.*value);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : Candidate::kNone;
}

Candidate compared_candidate(const io::ComparisonCandidate& data, const std::vector<int>& cases,
                             const io::JudgedPressure& pressure) {
  Candidate out{&data, io::candidate_label(data)};
  if (data.has_resolution()) out.resolution_mm = in_file(kMilli * data.resolution);
  for (const int number : cases) out.rows.push_back(pictures::find_row(data, number));
  const io::CandidateDigest all = io::digest(data);
  out.pmax_error_percent = in_file(1e2 * all.pmax_error);
  out.mean_pressure_error_percent = in_file(1e2 * all.mean_pressure_error);
  out.judged_error_percent = in_file(1e2 * all.*pressure.error);
  out.area_error_percent = in_file(1e2 * all.area_error);
  out.force_error_percent = in_file(1e2 * all.force_error);
  out.position_error_mm = in_file(kMilli * all.position_error);
  out.search_s = mean(data, &io::ComparisonRow::search_s);
  out.distance_s = mean(data, &io::ComparisonRow::distance_s);
  if (!data.failure.empty()) return out;  // what there is of it was not measured
  out.height_max_um = in_file(kMicro * all.height_max);
  out.height_rms_um = in_file(kMicro * all.height_rms);
  out.slope_max_mrad = in_file(kMilli * all.slope_max);
  out.curvature_max_per_m = in_file(all.curvature_max);
  out.build_s = in_file(data.wheel.build_seconds) + in_file(data.rail.build_seconds);
  out.memory_MB = 1e-6 * static_cast<double>(all.memory_bytes);
  return out;
}

}  // namespace

ComparedCandidates compared(const io::Comparison& comparison) {
  ComparedCandidates out{io::judged_pressure(comparison), {}, {}};
  for (const io::ComparisonCandidate& candidate : comparison.candidates)
    for (const io::ComparisonRow& row : candidate.rows) out.cases.push_back(row.case_number);
  ranges::sort(out.cases);
  out.cases.erase(std::unique(out.cases.begin(), out.cases.end()), out.cases.end());
  for (const io::ComparisonCandidate& candidate : comparison.candidates)
    out.candidates.push_back(compared_candidate(candidate, out.cases, out.pressure));
  return out;
}

ChartView accuracy_chart(const ComparedCandidates& all) {
  ChartView view;
  view.x = resolution_axis();
  view.panels = {over_resolution(all, error_of_pressure(all), "%", pressure_error, kLeastShown, false),
                 over_resolution(all, "surface deviation", "µm", height, kLeastShown, false)};
  return view;
}

ChartView cost_chart(const ComparedCandidates& all) {
  ChartView view;
  view.x = resolution_axis();
  view.panels = {over_resolution(all, "detection", "ms", time_ms, 0.0, true),
                 over_resolution(all, "memory", "MB", memory, 0.0, true),
                 over_resolution(all, "time to build", "ms", build_ms, 0.0, true)};
  return view;
}

ChartView trade_chart(const ComparedCandidates& all) {
  ChartView view;
  view.x = Axis{"mean time of search and distance a case", "ms", true};
  Panel panel{error_of_pressure(all), "%", true};
  const auto add = [&](const std::vector<const Candidate*>& group, const std::string& name) {
    Series series{name, {}, {}, Series::Marks::both};
    for (const Candidate* c : group) {
      const double x = placed(time_ms(*c), 0.0), y = placed(c->judged_error_percent, kLeastShown);
      if (std::isnan(x) || std::isnan(y)) continue;
      series.x.push_back(x);
      series.y.push_back(y);
      series.texts.push_back(hover(all, *c));
    }
    if (!series.y.empty()) panel.series.push_back(std::move(series));
  };
  for (const auto& group : by_backend(all)) add(group, group.front()->data->name);
  for (const Candidate& c : all.candidates)
    if (c.as_given() && &c != all.truth()) add({&c}, c.label + " (as given)");
  view.panels.push_back(std::move(panel));
  return view;
}

std::vector<const Candidate*> drawn_over_cases(const ComparedCandidates& all) {
  std::vector<const Candidate*> solved;
  for (const Candidate& c : all.candidates)
    if (c.solved()) solved.push_back(&c);
  if (solved.size() <= kFew) return solved;
  std::vector<const Candidate*> out;
  for (const Candidate* c : solved) {
    const bool finest = ranges::none_of(solved, [&](const Candidate* other) {
      return other->data->name == c->data->name && other->resolution_mm < c->resolution_mm;
    });
    if (c == all.truth() || c->as_given() || finest) out.push_back(c);
  }
  return out;
}

ChartView case_errors_chart(const ComparedCandidates& all) {
  ChartView view;
  view.linked = true;
  const std::vector<const Candidate*> candidates = drawn_over_cases(all);
  const auto panel = [&](const char* label, const char* unit, const char* key, double factor, bool with_truth) {
    Panel out{label, unit};
    for (const Candidate* c : candidates) {
      const bool truth = c == all.truth();
      if (truth && !with_truth) continue;
      Series series{c->label + (truth ? " (reference)" : ""), {}, {}, Series::Marks::both, truth};
      for (const auto* row : c->rows)
        series.y.push_back(row ? factor * number_in(io::compared_row(*c->data, *row), key) : Candidate::kNone);
      out.series.push_back(std::move(series));
    }
    return out;
  };
  view.panels = {panel("largest pressure", "MPa", "pmax_MPa", 1.0, true),
                 panel("error of p_max", "%", "pmax_error_percent", 1.0, false),
                 panel("normal force", "kN", "fn_N", 1e-3, true),
                 panel("error of the force", "%", "force_error_percent", 1.0, false),
                 panel("error of the position", "mm", "position_error_mm", 1.0, false)};
  return view;
}

Table candidate_table(const ComparedCandidates& all) {
  Table table{"candidates",
              "Representations. Errors are the largest in size over the cases, deviations those of the worse of wheel "
              "and rail, times of search "
              "and distance means per case; build and memory are of wheel and rail together.",
              {{"representation"},
               {"resolution", "mm"},
               {"wheel"},
               {"rail"},
               {"cases"},
               {"ok"},
               {"error of p_max", "%"},
               {"error of p_mean", "%"},
               {"error of area", "%"},
               {"error of force", "%"},
               {"error of position", "mm"},
               {"largest deviation", "µm"},
               {"rms deviation", "µm"},
               {"slope", "mrad"},
               {"curvature", "1/m"},
               {"search", "ms"},
               {"distance", "ms"},
               {"build", "s"},
               {"memory", "MB"},
               {"notes"}}};
  for (const Candidate& c : all.candidates) {
    Table::Row row;
    const io::ComparisonCandidate& data = *c.data;
    row.cells = {data.name + (&c == all.truth() ? " (reference)" : ""),
                 Number{c.resolution_mm},
                 data.wheel.backend,
                 data.rail.backend,
                 Number{static_cast<double>(data.rows.size())},
                 Number{static_cast<double>(ranges::count(data.rows, Status::ok, &io::ComparisonRow::status))}};
    for (const double value :
         {c.pmax_error_percent, c.mean_pressure_error_percent, c.area_error_percent, c.force_error_percent,
          c.position_error_mm, c.height_max_um, c.height_rms_um, c.slope_max_mrad, c.curvature_max_per_m,
          kMilli * c.search_s, kMilli * c.distance_s, c.build_s, c.memory_MB})
      row.cells.emplace_back(Number{value, 3});
    std::string notes = data.failure.empty() ? "" : "failed: " + data.failure;
    for (const auto& [name, body] : {std::pair{"wheel", &data.wheel}, {"rail", &data.rail}})
      if (!body->note.empty()) notes += fmt::format("{}{}: {}", notes.empty() ? "" : "; ", name, body->note);
    row.cells.emplace_back(std::move(notes));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table compared_row_table(const ComparedCandidates& all) {
  struct Quantity {
    const char* key;
    report::Column column;
    int digits = 4;
    double factor = 1.0;
  };
  const std::vector<Quantity> quantities{{"patches", {"patches"}},
                                         {"pmax_MPa", {"p_max", "MPa"}},
                                         {"pmax_error_percent", {"error of p_max", "%"}, 3},
                                         {"mean_pressure_error_percent", {"error of p_mean", "%"}, 3},
                                         {"area_mm2", {"area", "mm²"}},
                                         {"area_error_percent", {"error of area", "%"}, 3},
                                         {"fn_N", {"F_n", "kN"}, 6, 1e-3},
                                         {"fx_N", {"F_x", "kN"}, 6, 1e-3},
                                         {"fs_N", {"F_s", "kN"}, 6, 1e-3},
                                         {"force_error_percent", {"error of force", "%"}, 3},
                                         {"x_tr_mm", {"x", "mm"}},
                                         {"y_tr_mm", {"y", "mm"}},
                                         {"position_error_mm", {"error of position", "mm"}, 3},
                                         {"approach_mm", {"approach", "mm"}},
                                         {"approach_error_percent", {"error of approach", "%"}, 3},
                                         {"ncon", {"elements in contact"}, 6},
                                         {"search_s", {"search", "ms"}, 3, 1e3},
                                         {"distance_s", {"distance", "ms"}, 3, 1e3},
                                         {"height_max_um", {"largest deviation", "µm"}, 3},
                                         {"height_rms_um", {"rms deviation", "µm"}, 3},
                                         {"slope_max_mrad", {"slope", "mrad"}, 3},
                                         {"curvature_max_per_m", {"curvature", "1/m"}, 3},
                                         {"build_s", {"build", "s"}, 3},
                                         {"memory_bytes", {"memory", "MB"}, 3, 1e-6}};
  Table table{"rows",
              "Every case with every representation. Pressure to elements in contact are of the patch that carries "
              "most of the load; x and "
              "y are its "
              "reference in track axes, forces act on the rail. Errors exist where both this representation and the "
              "reference have contact.",
              {{"case"}, {"representation"}, {"wheel"}, {"rail"}, {"status"}}};
  for (const Quantity& q : quantities) table.columns.push_back(q.column);
  for (std::size_t i = 0; i < all.cases.size(); ++i)
    for (const Candidate& c : all.candidates) {
      if (!c.rows[i]) continue;
      Table::Row row{{Number{static_cast<double>(all.cases[i])}, c.label, c.data->wheel.backend, c.data->rail.backend,
                      std::string(to_string(c.rows[i]->status))},
                     static_cast<int>(i)};
      const io::ComparedRow compared = io::compared_row(*c.data, *c.rows[i]);
      for (const Quantity& q : quantities) {
        const bool build = std::string_view(q.key) == "build_s";  // a sum, which files round after their parts
        row.cells.emplace_back(Number{build ? c.build_s : q.factor * number_in(compared, q.key), q.digits});
      }
      table.rows.push_back(std::move(row));
    }
  return table;
}

}  // namespace treadmark::app::pages
