// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/assessment/pages/assessment_page.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/app/simulation/pages/history_panels.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/histories/channels.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using measures::Assessed;

constexpr std::size_t kMostPointsOfRun = 4000;

/// Forces in kN.
std::pair<double, std::string> shown_quantity(const measures::QuantityInfo& info) {
  const std::string unit = info.unit;
  return unit == "N" ? std::pair<double, std::string>{1e-3, "kN"} : std::pair{1.0, unit == "1" ? std::string() : unit};
}

Number number_cell(double value) { return {in_file(value), 4}; }

/// The worst wheel of each quantity, a column a run.
Table side_by_side(std::span<const AssessedRun> runs) {
  Table table{
      "assessment-worst", "Worst wheel, wheelset or point of each section", {{"section"}, {"quantity"}, {"unit"}}};
  for (const AssessedRun& run : runs) {
    const std::string of = runs.size() > 1 ? ", " + run.name : "";
    for (const char* column : {"value", "place", "share of limit"}) table.columns.push_back({column + of});
  }
  std::vector<std::string> sections;
  for (const AssessedRun& run : runs)
    for (const AssessmentSection& s : run.request.sections)
      if (ranges::find(sections, s.name) == sections.end()) sections.push_back(s.name);
  for (const std::string& section : sections)
    for (const measures::QuantityInfo& info : measures::assessed_quantities()) {
      const auto [factor, unit] = shown_quantity(info);
      Table::Row row{{section, std::string(info.meaning), unit}};
      bool any = false;
      for (const AssessedRun& run : runs) {
        const Assessed* worst = worst_of(run, section, info.key);
        any = any || worst != nullptr;
        row.cells.emplace_back(number_cell(worst ? factor * worst->value : NAN));
        row.cells.emplace_back(worst ? worst->place : std::string());
        row.cells.emplace_back(number_cell(worst ? worst->share() : NAN));
      }
      if (any) table.rows.push_back(std::move(row));
    }
  return table;
}

Table every_number(std::span<const AssessedRun> runs) {
  Table table{"assessment-all", "Every wheel, wheelset and point", {{"run"}, {"unit"}}};
  for (const auto& column : columns<Assessed>()) table.columns.push_back({std::string(column.label)});
  for (const AssessedRun& run : runs)
    for (const Assessed& a : run.quantities) {
      const auto [factor, unit] = shown_quantity(measures::quantity_info(a.quantity));
      Table::Row row{{run.name, unit}};
      for (const auto& column : columns<Assessed>())
        if (column.access.word != nullptr)
          row.cells.emplace_back(column.access.word(a));
        else
          row.cells.emplace_back(number_cell((column.unit.name.empty() ? factor : 1.0) * column.access.get(a)));
      table.rows.push_back(std::move(row));
    }
  return table;
}

Section spectra_section(std::span<const AssessedRun> runs) {
  Section section{"spectra", "Spectra"};
  ChartView bands, densities;
  for (ChartView* chart : {&bands, &densities}) {
    chart->x = Axis{"frequency", "Hz", true};
    const bool levels = chart == &bands;
    for (const AssessedRun& run : runs)
      for (const ChannelSpectrum& s : run.spectra) {
        const bool decibel = levels && has_level(s.unit);
        const std::string unit = decibel ? "dB re 1e-6 m/s²" : levels ? s.unit : fmt::format("({})²/Hz", s.unit);
        auto panel = ranges::find(chart->panels, unit, &Panel::unit);
        if (panel == chart->panels.end())
          panel = chart->panels.insert(panel, {levels ? "one-third octave" : "density", unit, !decibel});
        Series series{runs.size() > 1 ? run.name + ", " + s.channel : s.channel, {}};
        if (levels) {
          series.marks = Series::Marks::both;
          for (const measures::FrequencyBand& band : s.bands) {
            series.x.push_back(band.nominal);
            series.y.push_back(decibel ? acceleration_level(band.rms) : band.rms);
          }
        } else {
          for (std::size_t k = 1; k < s.density.density.size(); ++k) {
            const double frequency = s.density.line * static_cast<double>(k);
            if (frequency > s.density.highest) break;
            series.x.push_back(frequency);
            series.y.push_back(s.density.density[k]);
          }
        }
        if (!series.x.empty()) panel->series.push_back(std::move(series));
      }
    std::erase_if(chart->panels, [](const Panel& panel) { return panel.series.empty(); });
  }
  if (!bands.panels.empty())
    section.blocks.emplace_back(Figure{"third-octaves", "One-third octaves", std::move(bands),
                                       "Root mean squares in bands of IEC 61260, base ten."});
  if (!densities.panels.empty())
    section.blocks.emplace_back(Figure{"densities", "Power spectral densities", std::move(densities)});
  return section;
}

}  // namespace

std::vector<Section> assessment_sections(std::span<const AssessedRun> runs) {
  Section section{"assessment", "Assessment"};
  for (const AssessedRun& run : runs)
    for (const std::string& doubt : run.doubts)
      section.blocks.emplace_back(Banner{Banner::Kind::warning, run.name + ":", doubt});
  section.blocks.emplace_back(Paragraph{fmt::format(
      "Filters and percentiles are those that the literature quotes from EN 14363; they were not verified against the "
      "text of the standard. Limits: {}.",
      limits_text(runs.front().limits()))});
  section.blocks.emplace_back(side_by_side(runs));
  section.blocks.emplace_back(every_number(runs));
  std::vector<Section> sections{std::move(section)};
  if (Section spectra = spectra_section(runs); !spectra.blocks.empty()) sections.push_back(std::move(spectra));
  return sections;
}

Page assessment_page(std::span<const AssessedRun> runs, std::span<const std::string> channels) {
  Page page{"assessment", runs.size() == 1 ? runs.front().name : fmt::format("{} runs", runs.size()), ""};
  page.lead = "Simulations against limits";
  Section overview{"overview", "Runs"};
  Table list{"runs", "Runs", {{"run"}, {"title"}, {"status"}, {"input"}, {"SHA-256 of the input"}, {"settings"}}};
  for (const AssessedRun& run : runs) {
    const io::SimulationResult& r = *run.result;
    list.rows.push_back(
        {{run.name, r.title, r.status, r.input_file, r.input_sha256, fmt::format("{}", fmt::join(r.settings, ", "))}});
  }
  overview.blocks.emplace_back(std::move(list));
  ChartView chart;
  chart.x = Axis{"distance travelled", "m"};
  for (const AssessedRun& run : runs) {
    const io::SimulationResult& result = *run.result;
    const std::size_t x = io::column_index(result, "x_m");
    for (const std::size_t column : io::fitting_columns(result.columns, channels)) {
      if (column == x) continue;
      const std::string name = io::channel_name(result.columns[column]);
      const ShownUnit unit = shown_unit(name);
      auto panel = ranges::find(chart.panels, name, &Panel::label);
      if (panel == chart.panels.end())
        panel = chart.panels.insert(panel, {name, unit.name.empty() ? result.columns[column].unit : unit.name});
      Series series{run.name, {}};
      for (const std::size_t row : thinned_rows(result, {result.columns[column].name}, kMostPointsOfRun)) {
        series.x.push_back(result.values[row * result.columns.size() + x]);
        series.y.push_back(unit.factor * result.values[row * result.columns.size() + column]);
      }
      panel->series.push_back(std::move(series));
    }
  }
  if (!chart.panels.empty())
    overview.blocks.emplace_back(Figure{"channels", "Channels over the distance", std::move(chart)});
  page.sections.push_back(std::move(overview));
  for (Section& section : assessment_sections(runs)) page.sections.push_back(std::move(section));
  page.document = assessment_json(runs);
  if (runs.size() == 1) add_origin(page, *runs.front().result);
  return page;
}

}  // namespace treadmark::app::pages
