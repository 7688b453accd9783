// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/run_overlay_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/cases/pages/run_page.hpp"
#include "treadmark/app/compare/result_difference.hpp"
#include "treadmark/app/pages/overlay_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using Run = io::RunResult;
using Case = io::CaseResult;
using Runs = std::vector<NamedRun>;

/// The cases of all runs by their numbers: of each number a case a run, nullptr where the run has none.
using Matched = std::map<int, std::vector<const Case*>>;

Matched match(const Runs& runs) {
  Matched out;
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const Case& one : runs[k].result->cases) {
      auto& row = out[one.number];
      row.resize(runs.size());
      row[k] = &one;
    }
  return out;
}

bool in_all(const std::vector<const Case*>& row) {
  return ranges::none_of(row, [](const Case* one) { return one == nullptr; });
}

// -------------------------------------------------------------------------------------------------- steps and curves

struct PoseRow {
  double Case::*member;
  const char* name;
  double factor;
  const char* unit;
};
constexpr PoseRow kPose[] = {{&Case::pitch, "pitch angle", 180.0 / kPi, "°"},
                             {&Case::s, "position along the track", kMilli, "mm"},
                             {&Case::y, "lateral displacement", kMilli, "mm"},
                             {&Case::yaw, "yaw angle", 180.0 / kPi, "°"},
                             {&Case::roll, "roll angle", 180.0 / kPi, "°"}};

bool same(double a, double b) { return std::fabs(a - b) <= 1e-9 * std::max({1e-3, std::fabs(a), std::fabs(b)}); }

bool same_pose(const Matched& matched, double Case::*member) {
  return ranges::all_of(matched, [&](const auto& entry) {
    const Case* first = nullptr;
    for (const Case* one : entry.second) {
      if (one == nullptr) continue;
      if (first != nullptr && !same(first->*member, one->*member)) return false;
      if (first == nullptr) first = one;
    }
    return true;
  });
}

/// A case a number, with what all runs agree in of its pose: charts of all runs can be drawn over that, and only that.
Run common_cases(const Matched& matched) {
  Run out;
  out.cases.reserve(matched.size());
  std::vector<PoseRow> agreed;
  ranges::copy_if(kPose, std::back_inserter(agreed),
                  [&](const PoseRow& pose) { return same_pose(matched, pose.member); });
  for (const auto& [number, row] : matched) {
    const Case& one = **ranges::find_if(row, [](const Case* c) { return c != nullptr; });
    Case common;
    common.number = number;
    common.has_wheelset = one.has_wheelset;
    for (const PoseRow& pose : agreed) common.*pose.member = one.*pose.member;
    out.cases.push_back(std::move(common));
  }
  return out;
}

/// A quantity of all cases of all runs.
struct Curve {
  std::string label, unit;
  std::vector<std::vector<double>> values;  ///< of each run at each number; NaN = none
};

/// The curves of the pages of single runs.
std::vector<Curve> curves_of(const Runs& runs, const Matched& matched) {
  std::vector<Curve> curves;
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const Panel& panel : case_chart(*runs[k].result).panels)
      for (const Series& series : panel.series) {
        const std::string label = panel.series.size() > 1 ? series.name : panel.label;
        auto found = ranges::find(curves, label, &Curve::label);
        if (found == curves.end()) {
          curves.push_back({label, panel.unit, {}});
          curves.back().values.assign(runs.size(), std::vector<double>(matched.size(), kNaN));
          found = curves.end() - 1;
        }
        // Small forces are in N, large ones in kN.
        if (found->unit != panel.unit && panel.unit == "kN") {
          for (std::vector<double>& of_run : found->values)
            for (double& value : of_run) value *= 1e-3;
          found->unit = "kN";
        }
        const double factor = found->unit == panel.unit ? 1.0 : 1e-3;
        for (std::size_t i = 0; i < series.y.size(); ++i) {
          const auto at = matched.find(runs[k].result->cases[i].number);
          found->values[k][static_cast<std::size_t>(std::distance(matched.begin(), at))] = factor * series.y[i];
        }
      }
  return curves;
}

ChartView chart_of(const std::vector<Curve>& curves, const std::vector<std::string>& names) {
  ChartView view{true};
  for (const Curve& curve : curves) {
    Panel panel{curve.label, curve.unit};
    for (std::size_t k = 0; k < names.size(); ++k)
      panel.series.push_back({names[k], curve.values[k], {}, Series::Marks::both, k > 0});
    view.panels.push_back(std::move(panel));
  }
  return view;
}

double largest_size(const Curve& curve) {
  double most = 0.0;
  for (const std::vector<double>& of_run : curve.values)
    for (const double value : of_run)
      if (std::isfinite(value)) most = std::max(most, std::fabs(value));
  return most;
}

/// The step at which a curve differs most from the first run's.
struct Worst {
  std::size_t step = 0, run = 0;
  Change change{0.0, kNaN};
};
Worst worst_of(const Curve& curve) {
  Worst worst;
  const double scale = largest_size(curve);
  for (std::size_t k = 1; k < curve.values.size(); ++k)
    for (std::size_t i = 0; i < curve.values[k].size(); ++i) {
      const Change here = change(curve.values[0][i], curve.values[k][i], scale);
      if (std::fabs(here.difference) > std::fabs(worst.change.difference)) worst = {i, k, here};
    }
  return worst;
}

std::vector<FrameSet> sets_of(const Runs& runs, const Matched& matched, const std::vector<std::string>& steps) {
  std::vector<FrameSet> sets;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    FrameSet set{runs[k].name};
    for (const auto& [number, row] : matched) {
      std::shared_ptr<const Case> shown(runs[k].result, row[k]);
      if (row[k] == nullptr) {
        auto none = std::make_shared<Case>();
        none->number = number;
        none->status = Status::failed;
        none->message = "There is none of that number in this result.";
        shown = std::move(none);
      }
      set.frames.push_back({steps[set.frames.size()], std::move(shown)});
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

// ------------------------------------------------------------------------------------------------------ what differs

/// "0.3", "0.3 to 0.4", "–" of nothing.
class Extent {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  std::string text(const std::string& unit) const {
    if (low_ > high_) return "–";
    const std::string low = fmt::format("{:.6g}", low_ + 0.0), high = fmt::format("{:.6g}", high_ + 0.0);
    return (low == high ? low : low + " to " + high) + (unit.empty() ? "" : " " + unit);
  }

 private:
  double low_ = kInfinity, high_ = -kInfinity;
};

std::string surfaces_text(const Run& run, const std::string& body) {
  std::set<std::string> used;
  for (const io::SurfaceUse& use : run.surfaces)
    if (use.body == body)
      used.insert(use.resolution > 0.0
                      ? fmt::format("{} of samples {} mm apart", use.backend, shown({kMilli * use.resolution}))
                      : use.backend);
  return used.empty() ? "–" : fmt::format("{}", fmt::join(used, ", "));
}

std::vector<SaidByAll> lines_of(const Runs& runs, const Matched& matched, const std::vector<Origin>& origins) {
  std::vector<SaidByAll> lines;
  const auto say = [&](const std::string& what, const std::function<std::string(const Run&)>& text) {
    SaidByAll line{what};
    for (const auto& one : runs) line.texts.push_back(text(*one.result));
    lines.push_back(std::move(line));
  };
  say("title", [](const Run& run) { return run.title.empty() ? "–" : run.title; });
  for (SaidByAll& line : origins_of(origins, false)) lines.push_back(std::move(line));
  say("cases", [](const Run& run) { return fmt::format("{}", run.cases_total); });
  for (const char* body : {"wheel", "rail"})
    say(fmt::format("surface of the {}", body), [body](const Run& run) { return surfaces_text(run, body); });
  for (const PoseRow& pose : kPose)
    if (!same_pose(matched, pose.member))
      say(fmt::format("{} of cases of the same number", pose.name), [&](const Run& run) {
        Extent extent;
        for (const Case& one : run.cases) extent.add(pose.factor * one.*pose.member);
        return extent.text(pose.unit);
      });
  return lines;
}

void add_unmatched(const Runs& runs, const Matched& matched, Section& overview) {
  for (const PoseRow& pose : kPose) {
    std::vector<int> apart;
    for (const auto& entry : matched)
      if (!same_pose({entry}, pose.member)) apart.push_back(entry.first);
    if (!apart.empty())
      overview.blocks.emplace_back(
          Banner{Banner::Kind::warning, fmt::format("Cases of the same number with another {}:", pose.name),
                 stretches(apart) + ". Charts are not drawn over it; judge differences there with care."});
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::vector<int> lacking;
    for (const auto& [number, row] : matched)
      if (row[k] == nullptr) lacking.push_back(number);
    if (!lacking.empty())
      overview.blocks.emplace_back(Banner{
          Banner::Kind::warning, fmt::format("{} has not got {}:", runs[k].name, counted(lacking.size(), "case")),
          stretches(lacking) + ". There is nothing to compare them with."});
  }
  for (std::size_t k = 1; k < runs.size(); ++k) {
    std::string ended, patches;
    for (const auto& [number, row] : matched) {
      if (row[0] == nullptr || row[k] == nullptr) continue;
      const auto add = [number = number](std::string& to, const auto& a, const auto& b) {
        to += fmt::format("{}case {}: {} and {}", to.empty() ? "" : "; ", number, a, b);
      };
      if (row[0]->status != row[k]->status)
        add(ended, to_string(row[0]->status), to_string(row[k]->status));
      else if (row[0]->patches.size() != row[k]->patches.size())
        add(patches, row[0]->patches.size(), row[k]->patches.size());
    }
    const std::string both = runs[0].name + " and " + runs[k].name;
    if (!ended.empty())
      overview.blocks.emplace_back(Banner{Banner::Kind::warning, "Cases that ended differently in " + both + ":",
                                          ended + ". Their numbers are not in the table of all quantities."});
    if (!patches.empty())
      overview.blocks.emplace_back(
          Banner{Banner::Kind::note, "Numbers of patches that differ in " + both + ":", patches + "."});
  }
}

// ------------------------------------------------------------------------------------------------------------ tables

/// As pages name units.
std::pair<double, std::string> page_unit(const io::Unit& unit, double largest) {
  if (unit.shown == "N") return force_unit({largest});
  constexpr std::pair<std::string_view, const char*> kNames[] = {
      {"-", ""}, {"deg", "°"}, {"mm2", "mm²"}, {"degC", "°C"}, {"N mm", "N·mm"}};
  for (const auto& [shown, name] : kNames)
    if (unit.shown == shown) return {1.0, name};
  return {1.0, std::string(unit.shown)};
}

/// All quantities of files of results, each where it differs most.
Table quantity_table(const std::vector<std::string>& names, const ResultDifference& difference, std::size_t which) {
  Table table{which == 1 ? "quantities" : fmt::format("quantities-{}", which),
              fmt::format("All quantities of {} and {}, each where it differs most, the largest change first; keys are "
                          "those of result.json.",
                          names[0], names[which]),
              {{"quantity"}, {"meaning"}, {"case"}, {"patch"}, {"unit"}}};
  add_columns(table, {names[0], names[which]}, "", "");
  for (const QuantityDifference& one : difference.quantities) {
    const double a = one.unit.to_shown(one.si_a), b = one.unit.to_shown(one.si_b);
    const double largest = std::max(std::fabs(a), std::fabs(b));
    const auto [factor, unit] = page_unit(one.unit, largest);
    Table::Row row{{one.key, std::string(one.meaning), Number{static_cast<double>(one.case_number)},
                    one.patch > 0 ? Cell(Number{static_cast<double>(one.patch)}) : Cell(std::string()), unit}};
    const std::array<double, 2> both{factor * a, factor * b};
    add_cells(row, both, factor * largest);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table case_table_of(const std::vector<Curve>& curves, const std::vector<std::string>& names, const Matched& matched,
                    const std::vector<Axis>& axes) {
  Table table{
      "cases",
      fmt::format("Cases. Differences are to {}; changes are of its size and left out below a thousandth of the "
                  "largest size of the quantity. Forces act on the rail.",
                  names[0]),
      {{"case"}, {"status"}}};
  for (std::size_t a = 0; a + 1 < axes.size(); ++a) table.columns.push_back({axes[a].label, axes[a].unit});
  for (const Curve& curve : curves) add_columns(table, names, curve.label, curve.unit);
  std::size_t i = 0;
  for (const auto& [number, row] : matched) {
    std::vector<std::string> ends;
    for (const Case* one : row) ends.emplace_back(one == nullptr ? "none" : to_string(one->status));
    const bool alike = ranges::all_of(ends, [&](const std::string& end) { return end == ends.front(); });
    Table::Row line{
        {Number{static_cast<double>(number)}, alike ? ends.front() : fmt::format("{}", fmt::join(ends, " / "))},
        static_cast<int>(i)};
    for (std::size_t a = 0; a + 1 < axes.size(); ++a) line.cells.emplace_back(Number{axes[a].values[i]});
    for (const Curve& curve : curves) {
      std::vector<double> values;
      for (const std::vector<double>& of_run : curve.values) values.push_back(of_run[i]);
      add_cells(line, values, largest_size(curve));
    }
    table.rows.push_back(std::move(line));
    ++i;
  }
  return table;
}

// ------------------------------------------------------------------------------------------------------------- grids

/// Whether the elements of one patch lie on those of another.
bool grids_agree(const io::PatchResult& a, const io::PatchResult& b) {
  constexpr double kOfElement = 0.01, kTurn = 1e-6;
  const Grid2 &ga = a.fields.grid, &gb = b.fields.grid;
  const Pose &Xa = a.fields.X_TC, &Xb = b.fields.X_TC;
  if (!same(ga.dx, gb.dx) || !same(ga.dy, gb.dy) || (Xa.rotation - Xb.rotation).norm() > kTurn) return false;
  const Vec3 between = Xa.rotation.transpose() * (Xb.origin - Xa.origin);
  const auto whole = [](double elements) { return std::fabs(elements - std::round(elements)) <= kOfElement; };
  return whole((between.x() + gb.x0 - ga.x0) / ga.dx) && whole((between.y() + gb.y0 - ga.y0) / ga.dy);
}

std::string grids_text(const Matched& matched) {
  std::size_t compared = 0, agreeing = 0;
  for (const auto& [number, row] : matched)
    for (std::size_t k = 1; k < row.size(); ++k) {
      if (row[0] == nullptr || row[k] == nullptr || row[0]->patches.empty() || row[k]->patches.empty()) continue;
      ++compared;
      const auto &a = row[0]->patches, &b = row[k]->patches;
      if (a.size() == b.size() && ranges::equal(a, b, grids_agree)) ++agreeing;
    }
  if (agreeing == compared) return "Grids lie on each other: differences are those of the same elements.";
  return fmt::format(
      "Grids lie on each other in {} of {} comparisons of a case; elsewhere a difference is that to the "
      "nearest element at the same place in the track: there judge by outlines and sections.",
      agreeing, compared);
}

/// Changes below this share of a quantity's largest size are no headline: solvers reach forces within a tolerance.
constexpr double kLeastHeadline = 1e-4;

Cards cards_of(const std::vector<Curve>& curves, const std::vector<std::string>& names, const Matched& matched) {
  Cards cards;
  const auto both = ranges::count_if(matched, [](const auto& entry) { return in_all(entry.second); });
  cards.cards.push_back({"Cases in all", fmt::format("{} of {}", both, matched.size()), ""});
  for (const Curve& curve : curves) {
    const Worst worst = worst_of(curve);
    if (std::fabs(worst.change.difference) < kLeastHeadline * largest_size(curve) || worst.change.difference == 0.0)
      continue;
    const int number = std::next(matched.begin(), static_cast<std::ptrdiff_t>(worst.step))->first;
    cards.cards.push_back(change_card(
        curve.label, worst.change, curve.unit,
        fmt::format("case {}{}{}", number, names.size() > 2 ? ", " : "", names.size() > 2 ? names[worst.run] : "")));
  }
  return cards;
}

}  // namespace

void take_surfaces(Run& run, const std::string& prefix, std::vector<io::SampledSurface>& all) {
  for (io::SampledSurface& surface : run.sampled) {
    surface.name = prefix + surface.name;
    all.push_back(std::move(surface));
  }
  run.sampled.clear();
  for (Case& one : run.cases)
    for (std::string* name : {&one.wheel_surface, &one.rail_surface})
      if (!name->empty()) *name = prefix + *name;
}

void add_overlaid_contact(Page& page, Section& section, const std::vector<NamedRun>& runs,
                          const std::vector<std::string>& steps, std::vector<io::SampledSurface> surfaces) {
  const Matched matched = match(runs);
  page.sets = sets_of(runs, matched, steps);
  page.surfaces = std::move(surfaces);
  if (ranges::any_of(runs, [](const auto& one) { return has_fields(*one.result); })) {
    ContactView view;
    for (std::size_t k = 0; k < runs.size(); ++k) view.sets.push_back(static_cast<int>(k));
    section.blocks.emplace_back(Figure{"patches-view", "Contact patches", std::move(view), grids_text(matched)});
  }
  if (page.surfaces.empty()) return;
  constexpr const char* kLines[] = {"dashes", "dots", "dashes and dots"};  // as the scripts draw them
  SectionView cut{0};
  std::string note = fmt::format("Across the track through the most loaded patch of {}, to one scale.", runs[0].name);
  for (std::size_t k = 1; k < runs.size(); ++k) {
    cut.over.push_back(static_cast<int>(k));
    note += fmt::format(" {}: {}.", runs[k].name, kLines[(k - 1) % std::size(kLines)]);
  }
  section.blocks.emplace_back(Figure{"section", "Wheel and rail, cut at the contact", std::move(cut), std::move(note)});
}

Page run_overlay_page(std::vector<Overlaid<Run>>&& given) {
  if (given.size() < 2) throw Error(ErrorKind::configuration, "one run alone cannot be overlaid");
  Runs runs;
  std::vector<std::string> names;
  std::vector<Origin> origins;
  std::vector<io::SampledSurface> surfaces;
  for (auto& [name, run] : given) {
    take_surfaces(run, fmt::format("r{}_", runs.size() + 1), surfaces);
    origins.push_back(run);
    names.push_back(name);
    runs.push_back({name, std::make_shared<const Run>(std::move(run))});
  }
  const Matched matched = match(runs);

  Page page{"overlay", joined(names), ""};
  const Run& first = *runs[0].result;
  page.lead = fmt::format("{} overlaid: {}", counted(runs.size(), "run"), title_of(first.title, first.input_file));
  page.full_data = "fields.h5";
  Section overview{"overview", "Overview"};
  for (const auto& one : runs) add_run_banners(*one.result, overview, one.name);
  add_unmatched(runs, matched, overview);
  add_version_note(origins, overview);

  std::vector<Table> quantities;
  bool equal = true;
  for (std::size_t k = 1; k < runs.size(); ++k) {
    const ResultDifference difference = compare_results(first, *runs[k].result);
    equal = equal && agree(difference, 0.0);
    quantities.push_back(quantity_table(names, difference, k));
  }
  if (equal)
    overview.blocks.emplace_back(
        Banner{Banner::Kind::note, "No difference:", "all numbers of cases and patches are the same."});

  const std::vector<Curve> curves = curves_of(runs, matched);
  if (!matched.empty() && !equal) overview.blocks.emplace_back(cards_of(curves, names, matched));
  overview.blocks.emplace_back(difference_table(names, lines_of(runs, matched, origins)));
  page.sections.push_back(std::move(overview));

  if (!matched.empty()) {
    const Run common = common_cases(matched);
    page.timeline = case_timeline(common);
    page.timeline->start = worst_of(curves.front()).step;
    Section contact{"contact", "Contact"};
    add_overlaid_contact(page, contact, runs, page.timeline->names, std::move(surfaces));
    if (matched.size() > 1)
      contact.blocks.emplace_back(Figure{"forces", "Forces and pressures", chart_of(curves, names)});
    if (!contact.blocks.empty()) page.sections.push_back(std::move(contact));
    Section tables{"cases-section", "Cases", {case_table_of(curves, names, matched, page.timeline->axes)}};
    page.sections.push_back(std::move(tables));
    Section all{"quantities-section", "All quantities"};
    for (Table& table : quantities) all.blocks.emplace_back(std::move(table));
    page.sections.push_back(std::move(all));
  }
  page.sections.push_back(origins_section(names, origins));
  return page;
}

}  // namespace treadmark::app::pages
