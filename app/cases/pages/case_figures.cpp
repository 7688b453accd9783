// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/case_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/results/derivative_table.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

constexpr double kKilo = 1e-3;  // N -> kN
constexpr double kSquareMilli = 1e6;
constexpr double kDegrees = 180.0 / std::numbers::pi;

using Case = io::CaseResult;

double total(const Case& result, double io::PatchResult::*member) {
  double sum = 0.0;
  for (const io::PatchResult& patch : result.patches) sum += patch.*member;
  return sum;
}

double contact_area(const Case& result) {
  double sum = 0.0;
  for (const io::PatchResult& patch : result.patches) sum += patch.ncon * patch.fields.grid.cell_area();
  return sum;
}

/// NaN where the case has no result.
template <class Function>
std::vector<double> over_cases(const io::RunResult& run, Function&& value) {
  std::vector<double> out;
  for (const Case& result : run.cases) out.push_back(result.status == Status::failed ? NAN : value(result));
  return out;
}

template <class Function>
Axis make_axis(const io::RunResult& run, const char* label, const char* unit, Function&& value) {
  Axis axis{label, unit};
  for (const Case& result : run.cases) axis.values.push_back(value(result));
  return axis;
}

bool varies(const Axis& axis) {
  const auto [low, high] = ranges::minmax(axis.values);
  return high - low > 1e-9 * std::max(std::fabs(low), std::fabs(high));
}

bool any_wheelset(const io::RunResult& run) { return ranges::any_of(run.cases, &Case::has_wheelset); }

Panel force_panel(const io::RunResult& run) {
  const bool wheelset = any_wheelset(run);
  Panel panel{"force on the rail", ""};
  if (wheelset) {
    panel.series = {{"vertical F_z", over_cases(run, [](const Case& c) { return c.force_tr.z(); })},
                    {"longitudinal F_x", over_cases(run, [](const Case& c) { return c.force_tr.x(); })},
                    {"lateral F_y", over_cases(run, [](const Case& c) { return c.force_tr.y(); })}};
  } else {
    panel.series = {{"normal F_n", over_cases(run, [](const Case& c) { return total(c, &io::PatchResult::fn); })},
                    {"longitudinal F_x", over_cases(run, [](const Case& c) { return total(c, &io::PatchResult::fx); })},
                    {"lateral F_s", over_cases(run, [](const Case& c) { return total(c, &io::PatchResult::fs); })}};
  }
  std::vector<double> all;
  for (const Series& series : panel.series) all.insert(all.end(), series.y.begin(), series.y.end());
  const auto [factor, unit] = force_unit(all);
  panel.unit = unit;
  for (Series& series : panel.series) {
    series.marks = Series::Marks::both;
    for (double& value : series.y) value *= factor;
  }
  return panel;
}

Panel one(const char* label, const char* unit, std::vector<double> values) {
  Panel panel{label, unit};
  panel.series = {{label, std::move(values), {}, Series::Marks::both}};
  return panel;
}

}  // namespace

double largest(const Case& result, double io::PatchResult::*member) {
  double most = NAN;
  for (const io::PatchResult& patch : result.patches)
    most = std::isnan(most) ? patch.*member : std::max(most, patch.*member);
  return most;
}

FrameSet frames_of(const std::shared_ptr<const io::RunResult>& run, std::string name) {
  FrameSet set{std::move(name)};
  const std::vector<std::string> names = step_names(*run);
  for (std::size_t i = 0; i < run->cases.size(); ++i)
    set.frames.push_back({names[i], std::shared_ptr<const io::CaseResult>(run, &run->cases[i])});
  return set;
}

std::vector<Axis> case_axes(const io::RunResult& run) {
  std::vector<Axis> axes;
  if (any_wheelset(run)) {
    const auto consider = [&](Axis axis) {
      if (varies(axis)) axes.push_back(std::move(axis));
    };
    consider(make_axis(run, "pitch angle", "°", [](const Case& c) { return kDegrees * c.pitch; }));
    consider(make_axis(run, "position along the track", "mm", [](const Case& c) { return kMilli * c.s; }));
    consider(make_axis(run, "lateral displacement", "mm", [](const Case& c) { return kMilli * c.y; }));
    consider(make_axis(run, "yaw angle", "°", [](const Case& c) { return kDegrees * c.yaw; }));
    consider(make_axis(run, "roll angle", "°", [](const Case& c) { return kDegrees * c.roll; }));
  }
  axes.push_back(make_axis(run, "case", "", [](const Case& c) { return static_cast<double>(c.number); }));
  return axes;
}

std::vector<std::string> step_names(const io::RunResult& run) {
  const Axis first = case_axes(run).front();  // what tells the cases apart
  const char* word = first.label == "position along the track" ? "s"
                     : first.label == "lateral displacement"   ? "y"
                                                               : first.label.c_str();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    names.push_back(fmt::format("case {}", run.cases[i].number));
    if (!run.cases[i].has_wheelset || first.unit.empty()) continue;
    const double value = first.values[i];
    names.back() += fmt::format(", {} {}{}{}", word, value < 0.0 ? "−" : "", shown({std::fabs(value), 4}),
                                first.unit == "°" ? "°" : " " + first.unit);
  }
  return names;
}

Timeline case_timeline(const io::RunResult& run) {
  Timeline timeline{"case"};
  timeline.axes = case_axes(run);
  timeline.names = step_names(run);
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    timeline.frames.push_back(static_cast<int>(i));
    if (run.cases[i].status != Status::ok || !run.cases[i].remarks.empty()) timeline.notable.push_back(i);
  }
  return timeline;
}

ChartView case_chart(const io::RunResult& run) {
  ChartView view;
  view.linked = true;
  view.panels.push_back(one("largest pressure", "MPa",
                            over_cases(run, [](const Case& c) { return kMega * largest(c, &io::PatchResult::pmax); })));
  view.panels.push_back(force_panel(run));
  view.panels.push_back(
      one("contact area", "mm²", over_cases(run, [](const Case& c) { return kSquareMilli * contact_area(c); })));
  if (any_wheelset(run))
    view.panels.push_back(
        one("vertical position of the wheelset", "mm", over_cases(run, [](const Case& c) { return kMilli * c.z; })));
  else
    view.panels.push_back(one("approach", "mm", over_cases(run, [](const Case& c) {
                                return kMilli * largest(c, &io::PatchResult::approach);
                              })));
  return view;
}

Table case_table(const io::RunResult& run) {
  const bool wheelset = any_wheelset(run);
  Table table{"cases", "Cases. Forces act on the rail.", {}};
  const std::vector<Axis> axes = case_axes(run);
  table.columns = {{"case"}, {"status"}};
  for (std::size_t k = 0; k + 1 < axes.size(); ++k) table.columns.push_back({axes[k].label, axes[k].unit});
  table.columns.insert(table.columns.end(), {{"patches"}, {"p_max", "MPa"}, {"area", "mm²"}});
  for (const char* name : {"x", "y", "z"})
    table.columns.push_back({fmt::format("F_{}", wheelset         ? name
                                                 : name[0] == 'z' ? "n"
                                                 : name[0] == 'y' ? "s"
                                                                  : "x"),
                             "kN"});
  table.columns.push_back({"time", "s"});
  table.columns.push_back({"message"});
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    const Case& c = run.cases[i];
    Table::Row row{{Number{static_cast<double>(c.number)}, std::string(io::status_word(c))}, static_cast<int>(i)};
    for (std::size_t k = 0; k + 1 < axes.size(); ++k) row.cells.emplace_back(Number{axes[k].values[i]});
    row.cells.emplace_back(Number{static_cast<double>(c.patches.size())});
    row.cells.emplace_back(Number{kMega * largest(c, &io::PatchResult::pmax)});
    row.cells.emplace_back(Number{kSquareMilli * contact_area(c)});
    const Vec3 force =
        wheelset ? c.force_tr
                 : Vec3(total(c, &io::PatchResult::fx), total(c, &io::PatchResult::fs), total(c, &io::PatchResult::fn));
    for (int k = 0; k < 3; ++k) row.cells.emplace_back(Number{kKilo * force[k]});
    row.cells.emplace_back(Number{c.seconds, 3});
    row.cells.emplace_back(io::words(c));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table patch_table(const io::RunResult& run) {
  Table table{
      "patches",
      "Contact patches. x, y, z: contact reference in track axes; forces and creepages in contact axes: ξ along "
      "the track, η across, φ spin; Tγ wear number, friction power over speed.",
      {}};
  table.columns = {
      {"case"},           {"patch"},     {"x", "mm"},   {"y", "mm"},      {"z", "mm"},        {"contact angle", "°"},
      {"F_n", "kN"},      {"F_x", "kN"}, {"F_s", "kN"}, {"p_max", "MPa"}, {"approach", "mm"}, {"area", "mm²"},
      {"slip area", "%"}, {"ξ"},         {"η"},         {"φ", "rad/mm"},  {"Tγ", "N"}};
  for (std::size_t i = 0; i < run.cases.size(); ++i)
    for (std::size_t k = 0; k < run.cases[i].patches.size(); ++k) {
      const io::PatchResult& p = run.cases[i].patches[k];
      const double none = p.has_reference ? 1.0 : NAN, rolls = p.shift ? NAN : 1.0;
      Table::Row row{{}, static_cast<int>(i)};
      const double slip = p.ncon > 0 ? 100.0 * p.nslip / p.ncon : NAN;
      for (const double value :
           {static_cast<double>(run.cases[i].number), p.id > 0 ? static_cast<double>(p.id) : static_cast<double>(k + 1),
            none * kMilli * p.x_tr, none * kMilli * p.y_tr, none * kMilli * p.z_tr, none * kDegrees * p.angle,
            kKilo * p.fn, kKilo * p.fx, kKilo * p.fs, kMega * p.pmax, kMilli * p.approach,
            kSquareMilli * p.ncon * p.fields.grid.cell_area(), slip, rolls * p.xi, rolls * p.eta,
            rolls * p.phi / kMilli, p.wear_number()})
        row.cells.emplace_back(Number{value});
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table uncertainty_table(const io::RunResult& run) {
  Table table{
      "uncertainty",
      "How well numbers are known: one standard deviation, with the source of most of it. Sampled: from perturbed "
      "solutions, where derivatives do not tell.",
      {{"case"}, {"number"}, {"value"}, {"±"}, {"largest source"}, {"found"}}};
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    if (!run.cases[i].uncertainty) continue;
    const io::CaseUncertainty& u = *run.cases[i].uncertainty;
    const Number number{static_cast<double>(run.cases[i].number)};
    if (!u.message.empty())
      table.rows.push_back({{number, u.message, Number{NAN}, Number{NAN}, "", ""}, static_cast<int>(i)});
    for (const io::CaseUncertainty::Number& n : u.numbers)
      if (n.sigma > 0.0)
        table.rows.push_back({{number, n.name, Number{n.value, 6}, Number{n.sigma, 2}, io::dominant_source(u, n),
                               n.sampled ? "sampled" : "by derivatives"},
                              static_cast<int>(i)});
  }
  return table;
}

std::vector<Block> body_figures(const std::string& name) {
  return {
      Figure{"section", name + ", cut at the contact", SectionView{0},
             "Across the track through the most loaded patch, to one scale; thick: what is in contact there, with the "
             "normal into the rail and the normal force."},
      Figure{"scene", name + " in space", SceneView{0}}};
}

bool has_fields(const io::RunResult& run) {
  return ranges::any_of(run.cases, [](const Case& c) {
    return ranges::any_of(c.patches, [](const io::PatchResult& p) { return !p.fields.pressure.empty(); });
  });
}

}  // namespace treadmark::app::pages
