// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/plot.hpp"

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/field_catalogue.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/static_figure.hpp"

namespace treadmark::report {
namespace {

constexpr const char* kSection = "section";

bool has_field(const Page& page, const FieldInfo& field) {
  for (const FrameSet& set : page.sets)
    for (const Frame& frame : set.frames)
      for (const io::PatchResult& patch : frame.result->patches)
        if (field.kind == FieldInfo::Kind::state ? !patch.fields.state.empty() : !field.values(patch).empty())
          return true;
  return false;
}

template <class Function>
void each_figure(const Page& page, Function&& use) {
  for (const Section& section : page.sections)
    for (const Block& block : section.blocks)
      if (const auto* figure = std::get_if<Figure>(&block)) use(*figure);
}

bool is_chart_like(const Figure& figure) {
  return !std::holds_alternative<ContactView>(figure.view) && !std::holds_alternative<SceneView>(figure.view) &&
         !std::holds_alternative<SectionView>(figure.view) && !std::holds_alternative<TrackView>(figure.view);
}

/// Whether a figure shows another picture at another step.
bool has_steps(const Figure& figure) {
  const auto* map = std::get_if<MapView>(&figure.view);
  const auto* chart = std::get_if<ChartView>(&figure.view);
  return (map != nullptr && !map->by_step.empty()) || (chart != nullptr && !chart->by_step.empty());
}

/// The step of a page's only set that shows this case.
std::size_t step_of(const Page& page, int number) {
  const std::vector<Frame>& frames = page.sets.front().frames;
  const auto found = ranges::find(frames, number, [](const Frame& frame) { return frame.result->number; });
  return static_cast<std::size_t>(found - frames.begin());
}

std::vector<Frame> chosen(const Page& page, const std::vector<int>& cases) {
  std::vector<Frame> frames;
  std::string known;
  for (const FrameSet& set : page.sets) {
    for (const Frame& frame : set.frames) {
      const int number = frame.result->number;
      if (&set == &page.sets.front()) known += fmt::format("{}{}", known.empty() ? "" : ", ", number);
      if (!cases.empty() && ranges::find(cases, number) == cases.end()) continue;
      frames.push_back(frame);
      if (page.sets.size() > 1) frames.back().name = fmt::format("{}: {}", set.name, frame.name);
    }
  }
  for (const int wanted : cases)
    if (ranges::none_of(frames, [&](const Frame& frame) { return frame.result->number == wanted; }))
      throw Error(ErrorKind::configuration, fmt::format("there is no case {}", wanted), {}, "there are " + known);
  return frames;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plots_of(const Page& page) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const FieldInfo& field : field_catalogue())
    if (has_field(page, field)) out.emplace_back(field.name, fmt::format("{} in the contact patches", field.label));
  if (!page.surfaces.empty()) out.emplace_back(kSection, "wheel and rail cut across the track at the contact");
  each_figure(page, [&](const Figure& figure) {
    if (is_chart_like(figure)) out.emplace_back(html_id(figure.id), figure.title);
  });
  return out;
}

std::string plot(const Page& page, const std::string& what, const std::vector<int>& cases) {
  if (const FieldInfo* field = find_field(what); field && has_field(page, *field))
    return field_svg(chosen(page, cases), *field, page.title);
  if (what == kSection && !page.surfaces.empty()) {
    if (cases.size() > 1)
      throw Error(ErrorKind::configuration, "a section is that of one case", {}, "give one number after --case");
    if (!cases.empty()) return section_svg({"", {}, chosen(page, cases)}, page.surfaces);
  }
  const Figure* figure = nullptr;
  each_figure(page, [&](const Figure& one) {
    if (figure == nullptr && is_chart_like(one) && html_id(one.id) == what) figure = &one;
  });
  if (figure != nullptr && has_steps(*figure) && cases.size() == 1 && page.kind == "run") {
    chosen(page, cases);  // refuses what is not there
    return static_figure(*figure, page, step_of(page, cases.front())).front();
  }
  if (!cases.empty())
    throw Error(ErrorKind::configuration, fmt::format("cases cannot be chosen for {}", what), {}, "leave --case out");
  if (what == kSection && !page.surfaces.empty()) return static_figure({kSection, "", SectionView{0}}, page).front();
  if (figure != nullptr) return static_figure(*figure, page).front();
  std::vector<std::string> known;
  for (const auto& [name, meaning] : plots_of(page)) known.push_back(name);
  throw Error(ErrorKind::configuration, fmt::format("these results have no plot \"{}\"", what), {},
              known.empty() ? "there is nothing to draw" : advice_on_name(what, known));
}

}  // namespace treadmark::report
