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

/// Section and depth of a body at the chosen generation.
ChartView section_by_generation(const io::EvolutionResult& result, std::size_t body) {
  ChartView view;
  view.x = Axis{"y", "mm"};
  view.panels = {{"height z of the section", "mm", false, {Series{"section", {}}}},
                 {"depth removed, mean along", "mm", false, {Series{"depth", {}}}},
                 {"largest pressure up to here", "MPa", false, {Series{"pressure", {}}}}};
  for (const io::Generation& g : result.generations) {
    const io::EvolvedBody& b = g.bodies[body];
    ChartView::Curves curves;
    curves.y.assign(3, std::vector<std::vector<double>>(1));
    for (int j = 0; j < b.cells.ny; ++j) {
      const double z = b.z[static_cast<std::size_t>(j)];
      double volume = 0.0, pressure = 0.0;
      for (int i = 0; i < b.cells.nu; ++i) {
        volume += b.record.volume.at(i, j);
        pressure = std::max(pressure, b.record.pressure.at(i, j));
      }
      const double area = b.cells.area(j) * b.cells.nu;
      curves.x.push_back(in_file(kMilli * b.cells.y(j)));
      curves.y[0][0].push_back(in_file(kMilli * z));
      curves.y[1][0].push_back(in_file(kMilli * volume / area));
      curves.y[2][0].push_back(in_file(1e-6 * pressure));
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
  page.sections.push_back(std::move(summary));
  page.sections.push_back({"numbers",
                           "Over the generations",
                           {Figure{"numbers", "Numbers over the generations", numbers_over_generations(result)}}});
  for (std::size_t b = 0; b < last.bodies.size(); ++b) {
    const io::EvolvedBody& body = last.bodies[b];
    const std::string word = body_name(body.body);
    Section section{word, body.body == Body::wheel ? "Wheel" : "Rail"};
    section.blocks.emplace_back(
        Figure{word + "-section", "Section at the chosen generation", section_by_generation(result, b)});
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
