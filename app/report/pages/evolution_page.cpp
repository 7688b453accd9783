// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/evolution_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/report/html_text.hpp"
#include "treadmark/app/report/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/model/body_name.hpp"

namespace treadmark::app::report {
namespace {

namespace fs = std::filesystem;

/// Units as people read them.
std::string unit_shown(const std::string& unit) { return unit == "1" ? "" : unit == "mm3" ? "mm³" : unit; }

bool drawn(const std::string& name) {
  return name != "distance_km" && name != "passages" && name != "limits_kept" && name != "refused_steps" &&
         name.find("balance") == std::string::npos && name != "doubts";
}

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
    if (!drawn(first[k].name)) continue;
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
  return row == sheet.rows().end() ? 0.0 : *std::ranges::max_element(row->second);
}

/// What points have endured, as far as it was asked for.
std::vector<SectionLine> endured(const io::EvolvedBody& b) {
  using Record = const SurfaceRecord&;
  std::vector<SectionLine> out{{"largest pressure up to here", "MPa", "pressure", 1e-6,
                                [](Record r, std::size_t) -> const CellSheet& { return r.pressure; }},
                               {"largest T gamma up to here", "N", "T gamma", 1.0,
                                [](Record r, std::size_t) -> const CellSheet& { return r.t_gamma; }}};
  if (b.fatigue.has(FatigueMeasure::fi_surf))
    out.push_back({"largest surface fatigue index above 0 up to here", "", "index", 1.0,
                   [](Record r, std::size_t) -> const CellSheet& { return r.fi_surf; }});
  if (b.fatigue.has(FatigueMeasure::whole_life))
    out.push_back(
        {"damage of passages", "", "damage", 1.0, [](Record r, std::size_t) -> const CellSheet& { return r.damage; }});
  if (b.fatigue.has(FatigueMeasure::martensite))
    out.push_back({"largest temperature up to here", "°C", "temperature", 1.0,
                   [](Record r, std::size_t) -> const CellSheet& { return r.temperature; }});
  const auto at_depths = [&](const std::string& panel, const std::string& unit, double scale, auto sheet) {
    for (std::size_t k = 0; k < b.fatigue.depths.size(); ++k)
      out.push_back({panel, unit, fmt::format("{:.3g} mm deep", kMilli * b.fatigue.depths[k]), scale, sheet, k});
  };
  if (b.fatigue.has(FatigueMeasure::subsurface)) {
    at_depths("largest von Mises stress up to here", "MPa", 1e-6,
              [](Record r, std::size_t k) -> const CellSheet& { return r.stresses[k].von_mises; });
    at_depths("largest shear amplitude up to here", "MPa", 1e-6,
              [](Record r, std::size_t k) -> const CellSheet& { return r.stresses[k].shear; });
    at_depths("shear yield that shakedown needs over that of the material", "", 1.0 / b.fatigue.shear_yield,
              [](Record r, std::size_t k) -> const CellSheet& { return r.stresses[k].shakedown; });
  }
  if (b.fatigue.has(FatigueMeasure::dang_van))
    at_depths("Dang Van's stress over its limit", "", 1.0 / b.fatigue.dang_van_limit,
              [](Record r, std::size_t k) -> const CellSheet& { return r.stresses[k].dang_van; });
  return out;
}

/// Section, depth and what points have endured, of a body at the chosen generation.
ChartView section_by_generation(const io::EvolutionResult& result, const fs::path& folder, std::size_t body) {
  const std::vector<SectionLine> lines = endured(result.generations.front().bodies[body]);
  ChartView view;
  view.x = Axis{"y", "mm"};
  view.panels = {{"height z of the section", "mm", false, {Series{"section", {}}}},
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
      curves.y[0][0].push_back(in_file(kMilli * b.z[static_cast<std::size_t>(j)]));
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

/// Depth over the surface of a body that differs along, as the last generation has it.
MapView depth_map(const io::EvolvedBody& b) {
  MapView map;
  const bool wheel = b.body == Body::wheel;
  map.x = Axis{wheel ? "theta" : "x", wheel ? "°" : "mm"};
  map.y = Axis{"y", "mm"};
  map.label = "depth removed";
  map.unit = "mm";
  const double along = wheel ? 180.0 / kPi : kMilli;
  const int every = std::max(1, b.cells.nu / 1000);
  map.nx = (b.cells.nu + every - 1) / every;
  map.x0 = along * b.cells.u0, map.dx = along * b.cells.du * every;
  const auto& rows = b.record.volume.rows();
  const int first = rows.begin()->first, last = rows.rbegin()->first;
  map.ny = last - first + 1;
  map.y0 = kMilli * b.cells.y(first), map.dy = kMilli * b.cells.dy;
  for (int j = first; j <= last; ++j)
    for (int i = 0; i < b.cells.nu; i += every)
      map.values.push_back(in_file(kMilli * b.record.volume.at(i, j) / b.cells.area(j)));
  return map;
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
  const auto hardest = std::ranges::max_element(cases, {}, &io::EvolvedCase::pmax) - cases.begin();
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
  page.sections.push_back({"contact",
                           "Contact",
                           {Figure{"contact", "Contact of the position with the largest pressure", ContactView{{0}}}}});
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
    if (q.name == "distance_km" || q.name == "passages" || q.name == "pmax_MPa" || q.name.ends_with("_depth_mm"))
      if (q.value > 0.0)
        cards.cards.push_back({q.meaning, fmt::format("{} {}", shown({q.value, 4}), unit_shown(q.unit))});
  summary.blocks.emplace_back(std::move(cards));
  for (const io::EvolvedBody& b : last.bodies)
    summary.blocks.emplace_back(
        Paragraph{fmt::format("Law of the {}: {}. Its numbers: {}.", body_name(b.body), b.law, b.source)});
  for (const io::EvolvedBody& b : last.bodies)
    if (!b.fatigue.measures.empty())
      summary.blocks.emplace_back(Paragraph{fmt::format("Fatigue of the {}: {}. Its numbers: {}.", body_name(b.body),
                                                        b.fatigue.measures, b.fatigue.source)});
  page.sections.push_back(std::move(summary));
  page.sections.push_back({"numbers",
                           "Over the generations",
                           {Figure{"numbers", "Numbers over the generations", numbers_over_generations(result)}}});
  for (std::size_t b = 0; b < last.bodies.size(); ++b) {
    const io::EvolvedBody& body = last.bodies[b];
    const std::string word = body_name(body.body);
    Section section{word, body.body == Body::wheel ? "Wheel" : "Rail"};
    section.blocks.emplace_back(
        Figure{word + "-section", "Section at the chosen generation", section_by_generation(result, folder, b)});
    if (!body.cells.uniform() && !body.record.volume.rows().empty())
      section.blocks.emplace_back(Figure{word + "-depth", "Depth of the last generation", depth_map(body)});
    page.sections.push_back(std::move(section));
  }
  add_contacts(page, result, folder);
  page.sections.push_back({"generations", "Generations", {generation_table(result)}});
  page.sections.push_back(origin_section(
      origin_facts({result.version, result.git, result.input_file, result.input_sha256, {}, result.settings})));
  return page;
}

}  // namespace treadmark::app::report
