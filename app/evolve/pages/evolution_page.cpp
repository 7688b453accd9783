// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/evolve/pages/evolution_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

namespace fs = std::filesystem;

/// Units as people read them.
std::string unit_shown(const std::string& unit) { return unit == "1" ? "" : unit == "mm3" ? "mm³" : unit; }

/// Distance, or passages where no wheel evolves.
Axis axis_of(const io::EvolutionResult& result) {
  const bool wheel = result.generations.back().distance > 0.0;
  Axis axis{wheel ? "distance" : "passages", wheel ? "km" : ""};
  axis.values.reserve(result.generations.size());
  for (const io::Generation& g : result.generations)
    axis.values.push_back(in_file(wheel ? 1e-3 * g.distance : g.passages));
  return axis;
}

ChartView numbers_over_generations(const io::EvolutionResult& result) {
  ChartView view;
  view.linked = true;
  const auto first = io::quantities_of(result.generations.front());
  for (std::size_t k = 0; k < first.size(); ++k) {
    if (!(first[k].shown & kInChart)) continue;
    Series series{first[k].name, {}};
    series.marks = Series::Marks::both;
    series.y.reserve(result.generations.size());
    for (const io::Generation& g : result.generations) series.y.push_back(in_file(io::quantities_of(g)[k].value));
    view.panels.push_back({first[k].meaning, unit_shown(first[k].unit), false, {std::move(series)}});
  }
  return view;
}

/// A line over the section: what a row has of a sheet.
struct SectionLine {
  std::string panel, unit, name;
  double scale = 1.0;
  const CellSheet& (*sheet)(const SurfaceRecord& record, std::size_t depth) = nullptr;
  std::size_t depth = 0;  ///< number of the depth below the surface
};

double largest_in_row(const CellSheet& sheet, int j) {
  const auto row = sheet.rows().find(j);
  return row == sheet.rows().end() ? 0.0 : *ranges::max_element(row->second);
}

template <class Use>
void for_each_endured(const io::EvolvedBody& b, Use&& use) {
  for (const FatigueMeasureRow& row : fatigue_measures())
    if (b.fatigue.known.has(row.measure))
      for (const EnduredSheet& sheet : row.endured) use(sheet);
}

/// What points have endured, as far as it was asked for.
std::vector<SectionLine> endured(const io::EvolvedBody& b) {
  using Record = const SurfaceRecord&;
  std::vector<SectionLine> out{{"largest pressure up to here", "MPa", "pressure", 1e-6,
                                [](Record r, std::size_t) -> const CellSheet& { return r.pressure; }},
                               {"largest T gamma up to here", "N", "T gamma", 1.0,
                                [](Record r, std::size_t) -> const CellSheet& { return r.t_gamma; }}};
  const auto add = [&](const EnduredSheet& s, const std::string& name, std::size_t depth) {
    out.push_back({std::string(s.label), std::string(s.unit), name, s.scale(b.fatigue.known), s.sheet, depth});
  };
  const auto deep = [](double depth) { return fmt::format("{:.3g} mm deep", kMilli * depth); };
  for_each_endured(b, [&](const EnduredSheet& s) {
    if (!s.at_depths) add(s, std::string(s.name), 0);
  });
  if (!b.flow.theory.empty())
    for (std::size_t k = 0; k < b.flow.depths.size(); ++k)
      out.push_back({"shear strain that passages have added up", "", deep(b.flow.depths[k]), 1.0,
                     [](Record r, std::size_t depth) -> const CellSheet& { return r.flow[depth].strain; }, k});
  for_each_endured(b, [&](const EnduredSheet& s) {
    for (std::size_t k = 0; s.at_depths && k < b.fatigue.known.depths.size(); ++k)
      add(s, deep(b.fatigue.known.depths[k]), k);
  });
  return out;
}

/// Section, depth and what points have endured, of a body at the chosen generation.
ChartView section_by_generation(const io::EvolutionResult& result, const fs::path& folder, std::size_t body) {
  const std::vector<SectionLine> lines = endured(result.generations.front().bodies[body]);
  ChartView view;
  view.x = Axis{"y", "mm"};
  view.panels = {{"height of the section, -z", "mm", false, {Series{"section", {}}}},
                 {"depth removed, mean along", "mm", false, {Series{"depth", {}}}}};
  for (const SectionLine& line : lines) {
    if (view.panels.back().label != line.panel) view.panels.push_back({line.panel, line.unit, false, {}});
    view.panels.back().series.push_back(Series{line.name, {}});
  }
  for (const io::Generation& summary : result.generations) {
    const io::Generation g = io::read_generation(folder / io::generation_file(summary.number));
    const io::EvolvedBody& b = g.bodies[body];
    ChartView::Curves curves;
    curves.y.resize(view.panels.size());
    for (std::size_t p = 0; p < view.panels.size(); ++p) curves.y[p].resize(view.panels[p].series.size());
    for (int j = 0; j < b.cells.ny; ++j) {
      double volume = 0.0;
      for (int i = 0; i < b.cells.nu; ++i) volume += b.record.volume.at(i, j);
      curves.x.push_back(in_file(kMilli * b.cells.y(j)));
      curves.y[0][0].push_back(in_file(-kMilli * b.z[static_cast<std::size_t>(j)]));
      curves.y[1][0].push_back(in_file(kMilli * volume / (b.cells.area(j) * b.cells.nu)));
      std::size_t panel = 1, series = 0;
      for (const SectionLine& line : lines) {
        if (view.panels[panel].label != line.panel) ++panel, series = 0;
        curves.y[panel][series++].push_back(in_file(line.scale * largest_in_row(line.sheet(b.record, line.depth), j)));
      }
    }
    view.by_step.push_back(std::move(curves));
  }
  return view;
}

/// What is shown over the surface of a body that differs along.
struct SurfaceSheet {
  std::string id, title, label, unit;
  double scale = 1.0;
  bool by_area = false;                                                                 ///< volumes that become depths
  const CellSheet& (*sheet)(const SurfaceRecord& record, std::size_t depth) = nullptr;  ///< shown at the first depth
};

std::vector<SurfaceSheet> surface_sheets(const io::EvolvedBody& b) {
  using Record = const SurfaceRecord&;
  std::vector<SurfaceSheet> out{{"depth", "Depth", "depth removed", "mm", kMilli, true,
                                 [](Record r, std::size_t) -> const CellSheet& { return r.volume; }},
                                {"pressure", "Largest pressure", "largest pressure up to here", "MPa", 1e-6, false,
                                 [](Record r, std::size_t) -> const CellSheet& { return r.pressure; }}};
  for_each_endured(b, [&](const EnduredSheet& s) {
    if (!s.id.empty())
      out.push_back({std::string(s.id), std::string(s.title), std::string(s.on_surface), std::string(s.unit),
                     s.scale(b.fatigue.known), false, s.sheet});
  });
  if (!b.flow.theory.empty())
    out.push_back({"strain", "Shear strain", "added up at the first depth", "", 1.0, false,
                   [](Record r, std::size_t) -> const CellSheet& { return r.flow.front().strain; }});
  return out;
}

/// Value of some cells beside each other, the one that is farthest from zero, in the unit that is shown.
double shown_value(const SurfaceSheet& what, const io::EvolvedBody& b, int i, int count, int j) {
  double value = 0.0;
  for (int k = i; k < i + count; ++k)
    if (const double one = what.sheet(b.record, 0).at(b.cells.wrapped(k), j); std::fabs(one) > std::fabs(value))
      value = one;
  return in_file(what.scale * (what.by_area ? value / b.cells.area(j) : value));
}

Axis along_axis(Body body) { return body == Body::wheel ? Axis{"theta", "°"} : Axis{"x", "mm"}; }
double along_scale(Body body) { return body == Body::wheel ? 180.0 / kPi : kMilli; }

/// Rows of the last generation that contacts have reached.
std::pair<int, int> touched_rows(const io::EvolvedBody& last) {
  const auto& rows = last.record.volume.rows();
  return {rows.begin()->first, rows.rbegin()->first};
}

/// The row that has changed most.
int changed_row(const io::EvolvedBody& last) {
  int row = 0;
  double most = -1.0;
  for (const auto& [j, values] : last.record.volume.rows()) {
    double sum = 0.0;
    for (const double value : values) sum += std::fabs(value);
    if (sum > most) most = sum, row = j;
  }
  return row;
}

/// First and last column where depth is more than some of the largest, and as much again to both sides; of a wheel
/// counted from -180 degrees on, where defects of files begin at 0.
std::pair<int, int> changed_columns(const io::EvolvedBody& last) {
  constexpr double kShare = 0.02;
  const SurfaceCells& c = last.cells;
  const int low = c.closed() ? -c.nu / 2 : 0, high = low + c.nu - 1;
  std::vector<double> depth(static_cast<std::size_t>(c.nu), 0.0);
  for (const auto& [j, row] : last.record.volume.rows())
    for (int i = low; i <= high; ++i) {
      double& most = depth[static_cast<std::size_t>(i - low)];
      most = std::max(most, std::fabs(row[static_cast<std::size_t>(c.wrapped(i))]));
    }
  const double enough = kShare * *ranges::max_element(depth);
  int first = high, end = low;
  for (int i = low; i <= high; ++i)
    if (depth[static_cast<std::size_t>(i - low)] > enough) first = std::min(first, i), end = std::max(end, i);
  if (first > end) return {low, high};
  const int more = (end - first + 1) / 4 + 1;
  return {std::max(low, first - more), std::min(high, end + more)};
}

/// Over the unrolled surface and along the row that has changed most, at the chosen generation.
void add_surface_figures(Section& section, const io::EvolutionResult& result, const fs::path& folder,
                         std::size_t body) {
  constexpr double kMostNumbers = 1.5e6;  // of a map over all generations
  const io::EvolvedBody& last = result.generations.back().bodies[body];
  const std::string word = body_name(last.body);
  const auto [first_row, last_row] = touched_rows(last);
  const auto [first, last_column] = changed_columns(last);
  const int ny = last_row - first_row + 1, nu = last_column - first + 1, middle = changed_row(last);
  const double cells = static_cast<double>(nu) * ny * static_cast<double>(result.generations.size());
  const int every = std::max({1, nu / 1000, to_whole<int>(std::ceil(cells / kMostNumbers))});
  const std::vector<SurfaceSheet> sheets = surface_sheets(last);
  ChartView lines;
  lines.x = along_axis(last.body);
  std::vector<MapView> maps;
  for (const SurfaceSheet& what : sheets) {
    lines.panels.push_back({what.label, what.unit, false, {Series{what.id, {}}}});
    MapView& map = maps.emplace_back();
    map.x = along_axis(last.body);
    map.y = Axis{"y", "mm"};
    map.label = what.label, map.unit = what.unit;
    map.nx = (nu + every - 1) / every, map.ny = ny;
    map.diverging = what.by_area && !last.flow.theory.empty();
    map.x0 = along_scale(last.body) * last.cells.u(first), map.dx = along_scale(last.body) * last.cells.du * every;
    map.y0 = kMilli * last.cells.y(first_row), map.dy = kMilli * last.cells.dy;
  }
  for (const io::Generation& summary : result.generations) {
    const io::Generation g = io::read_generation(folder / io::generation_file(summary.number));
    const io::EvolvedBody& b = g.bodies[body];
    ChartView::Curves curves;
    for (int i = first; i <= last_column; i += every) curves.x.push_back(in_file(along_scale(b.body) * b.cells.u(i)));
    for (std::size_t k = 0; k < sheets.size(); ++k) {
      std::vector<double>& values = maps[k].by_step.emplace_back();
      values.reserve(static_cast<std::size_t>(maps[k].nx) * static_cast<std::size_t>(ny));
      for (int j = first_row; j <= last_row; ++j)
        for (int i = first; i <= last_column; i += every) values.push_back(shown_value(sheets[k], b, i, every, j));
      std::vector<double>& line = curves.y.emplace_back(1).front();
      for (int i = first; i <= last_column; i += every) line.push_back(shown_value(sheets[k], b, i, every, middle));
    }
    lines.by_step.push_back(std::move(curves));
  }
  section.blocks.emplace_back(Figure{
      word + "-along", fmt::format("Along y = {:.4g} mm at the chosen generation", kMilli * last.cells.y(middle)),
      std::move(lines)});
  for (std::size_t k = 0; k < sheets.size(); ++k)
    section.blocks.emplace_back(Figure{
        word + "-" + sheets[k].id, sheets[k].title + " over the surface at the chosen generation", std::move(maps[k])});
}

Table generation_table(const io::EvolutionResult& result) {
  Table table{"generations", "Generations", {{"generation"}}};
  for (const io::EvolutionQuantity& q : io::quantities_of(result.generations.front()))
    table.columns.push_back({q.name, unit_shown(q.unit)});
  for (const io::Generation& g : result.generations) {
    Table::Row row{{Number{static_cast<double>(g.number)}}, g.number};
    for (const io::EvolutionQuantity& q : io::quantities_of(g)) row.cells.emplace_back(Number{in_file(q.value)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The contacts of the case that has the largest pressure at first, of the generations that kept them.
void add_contacts(Page& page, const io::EvolutionResult& result, const fs::path& folder) {
  const auto& cases = result.generations.front().cases;
  const auto hardest = ranges::max_element(cases, {}, &io::EvolvedCase::pmax) - cases.begin();
  FrameSet set{fmt::format("position {}", cases[static_cast<std::size_t>(hardest)].label)};
  std::vector<int> frames(result.generations.size(), -1);
  for (const io::Generation& g : result.generations) {
    const fs::path file = folder / io::contacts_file(g.number);
    if (!fs::exists(file)) continue;
    io::RunResult run = io::read_hdf5(file);
    if (static_cast<std::size_t>(hardest) >= run.cases.size()) continue;
    frames[static_cast<std::size_t>(g.number)] = static_cast<int>(set.frames.size());
    set.frames.push_back({fmt::format("generation {}", g.number), std::make_shared<const io::CaseResult>(std::move(
                                                                      run.cases[static_cast<std::size_t>(hardest)]))});
  }
  if (set.frames.empty()) return;
  page.timeline->frames = std::move(frames);
  page.sets.push_back(std::move(set));
  page.sections.push_back(
      {"contact",
       "Contact",
       {Figure{"hardest-contact", "Contact of the position with the largest pressure", ContactView{{0}}}}});
}

}  // namespace

Page evolution_page(const fs::path& folder) {
  const io::EvolutionResult result = io::read_evolution_folder(folder);
  if (result.generations.empty())
    throw Error(ErrorKind::input_data, "the evolution has no generation yet", {folder.string()}, "let it go on");
  const io::Generation& last = result.generations.back();
  OptionalFiles files(folder);
  Page page;
  page.kind = "evolution";
  page.title = title_of(result.title, result.input_file);
  page.lead =
      fmt::format("{}, {:.0f} % of the whole", counted(result.generations.size(), "generation"), 100.0 * last.progress);
  page.document = files.text("evolution.json", "the results as JSON");
  page.full_data = "evolution.h5";
  Axis axis = axis_of(result);
  Timeline timeline{"generation"};
  timeline.names.reserve(result.generations.size());
  for (const io::Generation& g : result.generations) timeline.names.push_back(fmt::format("generation {}", g.number));
  timeline.axes = {std::move(axis)};
  timeline.start = result.generations.size() - 1;
  page.timeline = std::move(timeline);

  Section summary{"summary", "Summary"};
  if (result.status != "complete")
    summary.blocks.emplace_back(Banner{Banner::Kind::warning, result.status, result.message});
  Cards cards;
  for (const io::EvolutionQuantity& q : io::quantities_of(last))
    if ((q.shown & kInCards) && q.value > 0.0)
      cards.cards.push_back({q.meaning, fmt::format("{} {}", shown({q.value, 4}), unit_shown(q.unit))});
  summary.blocks.emplace_back(std::move(cards));
  for (const io::EvolvedBody& b : last.bodies)
    summary.blocks.emplace_back(
        Paragraph{fmt::format("Law of the {}: {}. Its numbers: {}.", body_name(b.body), b.law, b.source)});
  for (const io::EvolvedBody& b : last.bodies)
    if (!b.flow.theory.empty())
      summary.blocks.emplace_back(Paragraph{
          fmt::format("Flow of the {}: {}. Its numbers: {}.", body_name(b.body), b.flow.theory, b.flow.source)});
  for (const io::EvolvedBody& b : last.bodies)
    if (const FatigueSettings& known = b.fatigue.known; !known.measures.empty())
      summary.blocks.emplace_back(Paragraph{fmt::format("Fatigue of the {}: {}. Its numbers: {}.", body_name(b.body),
                                                        words_of(known.measures), known.source)});
  page.sections.push_back(std::move(summary));
  page.sections.push_back(
      {"numbers",
       "Over the generations",
       {Figure{"over-generations", "Numbers over the generations", numbers_over_generations(result)}}});
  for (std::size_t b = 0; b < last.bodies.size(); ++b) {
    const io::EvolvedBody& body = last.bodies[b];
    const std::string word = body_name(body.body);
    Section section{word, body.body == Body::wheel ? "Wheel" : "Rail"};
    section.blocks.emplace_back(
        Figure{word + "-section", "Section at the chosen generation", section_by_generation(result, folder, b)});
    if (!body.cells.uniform() && !body.record.volume.rows().empty()) add_surface_figures(section, result, folder, b);
    page.sections.push_back(std::move(section));
  }
  add_contacts(page, result, folder);
  page.sections.push_back({"generations", "Generations", {generation_table(result)}});
  add_origin(page, result);
  return page;
}

}  // namespace treadmark::app::pages
