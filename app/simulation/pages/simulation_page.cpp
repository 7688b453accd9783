// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/pages/simulation_page.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/assessment/pages/assessment_page.hpp"
#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/app/simulation/pages/history_panels.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/row_blocks.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

constexpr std::size_t kMostRows = 20'000;

using Result = io::SimulationResult;
using Rows = std::vector<std::size_t>;

double summary_of(const Result& result, const std::string& name) {
  const auto at = ranges::find(result.summary, name, &io::NamedValue::name);
  return at == result.summary.end() ? NAN : at->value;
}

std::string value_text(double value, const std::string& name) {
  const ShownUnit unit = shown_unit(name);
  return shown({unit.factor * value}) + (unit.name.empty() ? "" : " " + unit.name);
}

Cards cards_of(const Result& result) {
  Cards cards;
  const auto card = [&](const char* label, const char* name, std::string note) {
    if (const double value = summary_of(result, name); std::isfinite(value))
      cards.cards.push_back({label, value_text(value, name), std::move(note)});
  };
  const double at = summary_of(result, "q_max_x_m");
  card("Largest vertical force", "q_max_N", std::isfinite(at) ? fmt::format("at x = {} m", shown({at})) : "");
  card("Over the static force", "q_max_over_static",
       fmt::format("static {}", value_text(summary_of(result, "q_static_N"), "q_static_N")));
  card("Least vertical force", "q_min_N", "");
  card("Largest pressure", "pmax_Pa", "");
  card("Loss of contact", "contact_lost", "times");
  return cards;
}

Table named_table(const char* id, const char* caption, const std::vector<io::NamedValue>& values) {
  Table table{id, caption, {{"quantity"}, {"meaning"}, {"value"}, {"unit"}}};
  for (const io::NamedValue& one : values) {
    const ShownUnit unit = shown_unit(one.name);
    table.rows.push_back({{shown_name(one.name), one.description, Number{unit.factor * one.value, 6},
                           !unit.name.empty() ? unit.name
                           : one.unit == "1"  ? ""
                                              : one.unit}});
  }
  return table;
}

/// The frame that a step shows: the last snapshot taken until then.
std::vector<int> frames_at(const Result& result, const std::vector<double>& times) {
  std::vector<int> frames;
  for (const double time : times) {
    int frame = -1;
    for (std::size_t k = 0; k < result.snapshot_times.size(); ++k)
      if (result.snapshot_times[k] <= time + 1e-9) frame = static_cast<int>(k);
    frames.push_back(frame);
  }
  return frames;
}

std::vector<NamedColumn> of_all_wheels(const Result& result, const std::string& quantity, const std::string& watched) {
  std::vector<NamedColumn> list{{quantity, watched}};
  for (const io::HistoryColumn& column : result.columns)
    if (const auto dot = column.name.rfind('.'); dot != std::string::npos && column.name.substr(dot + 1) == quantity)
      list.push_back({column.name, column.name.substr(0, dot)});
  return list;
}

/// "vertical force on the rail (ws1_right)" says whose columns have no prefix.
std::string watched_wheel(const Result& result) {
  for (const io::HistoryColumn& column : result.columns)
    if (const auto open = column.description.rfind('('); column.name == "Q_N" && open != std::string::npos)
      return column.description.substr(open + 1, column.description.size() - open - 2);
  return "wheel";
}

/// Where the largest pressure is, or without any the largest vertical force.
std::size_t worst_row(const Result& result, const Rows& rows) {
  for (const char* column : {"pmax_Pa", "Q_N"})
    if (const auto values = column_at(result, column, rows))
      return static_cast<std::size_t>(
          ranges::max_element(*values, {}, [](double v) { return std::isnan(v) ? -kInfinity : v; }) - values->begin());
  return 0;
}

void add(ChartView& chart, std::optional<Panel> panel) {
  if (panel) chart.panels.push_back(std::move(*panel));
}

Section histories(const Result& result, const Rows& rows) {
  Section section{"histories", "Histories"};
  const std::string watched = watched_wheel(result);
  ChartView forces{true};
  add(forces, history_panel(result, "vertical force Q", {{"Q_N", "Q"}}, rows));
  const bool has_q = ranges::find(result.columns, "Q_N", &io::HistoryColumn::name) != result.columns.end();
  if (has_q && !forces.panels.empty() && !result.values.empty())
    forces.panels.front().levels.push_back({forces.panels.front().series.front().y.front(), "at the start"});
  add(forces,
      history_panel(result, "lateral force", {{"Ty_N", "lateral creep force T_y"}, {"Y_N", "lateral force Y"}}, rows));
  add(forces, history_panel(result, "longitudinal creep force", {{"Tx_N", "T_x"}}, rows));
  add(forces, history_panel(result, "largest pressure", {{"pmax_Pa", "p_max"}}, rows));
  if (!forces.panels.empty())
    section.blocks.emplace_back(
        Figure{"forces", fmt::format("Forces of {}", watched), std::move(forces), "Forces act on the rail."});

  ChartView contact{true};
  add(contact, history_panel(result, "contact area", {{"area_m2", "area"}}, rows));
  add(contact, history_panel(result, "least distance", {{"gap_m", "gap"}}, rows));
  add(contact, history_panel(result, "contact ahead of the axle", {{"x_cp_m", "x"}}, rows));
  add(contact, history_panel(result, "vertical displacement of the rail", {{"rail_z_m", "rail"}}, rows));
  if (!contact.panels.empty())
    section.blocks.emplace_back(Figure{"contact-history", fmt::format("Contact of {}", watched), std::move(contact)});

  ChartView all{true};
  add(all, history_panel(result, "vertical force Q", of_all_wheels(result, "Q_N", watched), rows));
  add(all, history_panel(result, "lateral creep force T_y", of_all_wheels(result, "Ty_N", watched), rows));
  add(all, history_panel(result, "lateral force Y", of_all_wheels(result, "Y_N", watched), rows));
  add(all, history_panel(result, "wear number", of_all_wheels(result, "Tgamma_N", watched), rows));
  if (!all.panels.empty() && all.panels.front().series.size() > 1)
    section.blocks.emplace_back(Figure{"wheels", "All wheels", std::move(all)});

  ChartView energy{true};
  add(energy,
      history_panel(result, "dissipated", {{"energy.friction_J", "friction"}, {"energy.dampers_J", "dampers"}}, rows));
  add(energy,
      history_panel(result, "energy that does not add up",
                    {{"energy.integration_error_J", "time integration"}, {"energy.contact_error_J", "contact"}}, rows));
  if (!energy.panels.empty()) section.blocks.emplace_back(Figure{"energy", "Energy", std::move(energy)});
  return section;
}

Section tables(const Result& result) {
  Section section{"tables", "Tables"};
  section.blocks.emplace_back(named_table("summary", "Summary", result.summary));
  section.blocks.emplace_back(named_table("static", "Static equilibrium at the start", result.statics));
  if (!result.events.empty())
    section.blocks.emplace_back(
        report::table_of("events", "Contacts: lost and regained, full and from tables", result.events, 6));
  if (!result.modes.empty())
    section.blocks.emplace_back(
        report::table_of("modes", "Modes of the vehicle on the track about its equilibrium", result.modes));
  return section;
}

}  // namespace

void add_simulation_banners(const Result& result, Section& overview, const std::string& name) {
  const auto add = [&](Banner::Kind kind, const std::string& heading, std::string text) {
    overview.blocks.emplace_back(Banner{kind, name.empty() ? heading : name + ": " + heading, std::move(text)});
  };
  if (result.status == "interrupted")
    add(Banner::Kind::failed, "Interrupted.",
        fmt::format("{}{}The history ends before the end of the track; the same command goes on.", result.message,
                    result.message.empty() ? "" : ". "));
  if (result.status == "derailed") add(Banner::Kind::failed, "Derailed.", result.message);
  if (result.status == "failed") add(Banner::Kind::failed, "Failed.", result.message);
  const auto lost = ranges::count_if(result.events, [](const auto& e) { return e.kind.starts_with("contact "); });
  if (lost > 0)
    add(Banner::Kind::note, "Loss of contact.",
        counted(static_cast<std::size_t>(lost), "event") + " in the table below.");
}

Page simulation_page(const std::shared_ptr<const Result>& result, std::string document, const AssessedRun* assessed) {
  Page page{"simulation", title_of(result->title, result->input_file), ""};
  page.document = std::move(document);
  page.full_data = "simulation.h5";
  page.lead =
      fmt::format("Simulation in time, {}, {} written down", result->status, counted(result->rows(), "instant"));
  Section overview{"overview", "Overview"};
  add_simulation_banners(*result, overview);
  overview.blocks.emplace_back(cards_of(*result));
  page.sections.push_back(std::move(overview));

  const std::shared_ptr<const io::RunResult> snapshots(result, &result->snapshots);
  const bool fields = has_fields(*snapshots);
  if (result->rows() > 1) {
    const Rows rows = thinned_rows(*result, {"Q_N", "Ty_N", "pmax_Pa", "gap_m"}, kMostRows);
    Timeline timeline{"instant"};
    const std::vector<double> times = column_at(*result, "t_s", rows).value_or(std::vector<double>());
    if (auto x = column_at(*result, "x_m", rows))
      timeline.axes.push_back({"distance travelled", "m", false, std::move(*x)});
    timeline.axes.push_back({"time", "s", false, times});
    if (auto pitch = column_at(*result, "pitch_rad", rows))
      timeline.axes.push_back({"pitch angle", "°", false, std::move(*pitch)});
    if (fields && !result->snapshot_times.empty()) timeline.frames = frames_at(*result, times);
    timeline.start = worst_row(*result, rows);
    page.timeline = std::move(timeline);
    page.sections.push_back(histories(*result, rows));
  }
  if (fields) {
    FrameSet set = frames_of(snapshots, "snapshots");
    for (std::size_t k = 0; k < set.frames.size(); ++k) {
      if (k < result->snapshot_times.size())
        set.frames[k].name = fmt::format("t = {} s", shown({result->snapshot_times[k], 5}));
      if (k < result->snapshot_scenes.size() && result->snapshot_scenes[k].nominal && !set.nominal)
        set.nominal = static_cast<int>(k);
    }
    page.sets.push_back(std::move(set));
    page.surfaces = snapshots->sampled;
    if (!page.timeline || page.timeline->frames.empty()) page.timeline = case_timeline(*snapshots);
    Section contact{"contact", "Contact at the snapshots"};
    contact.blocks.emplace_back(Figure{"patches-view", "Contact patches", ContactView{{0}},
                                       "The last snapshot taken until the chosen instant."});
    if (!page.surfaces.empty()) {
      contact.blocks.emplace_back(Figure{"positions", "Contact in the track", TrackView{0}, kTrackNote});
      append(contact.blocks, body_figures("Wheel and rail"));
    }
    page.sections.insert(page.sections.begin() + 1, std::move(contact));
  }
  if (assessed)
    for (Section& section : assessment_sections(std::span(assessed, 1))) page.sections.push_back(std::move(section));
  page.sections.push_back(tables(*result));
  add_origin(page, *result);
  return page;
}

}  // namespace treadmark::app::pages
