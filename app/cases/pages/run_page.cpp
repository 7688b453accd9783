// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/run_page.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/cases/pages/subsurface_figures.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

Cards::Card extreme(const io::RunResult& run, const char* label, const char* unit, double factor,
                    double (*value)(const io::CaseResult&)) {
  double best = NAN;
  int number = 0;
  for (const io::CaseResult& c : run.cases) {
    const double here = value(c);
    if (std::isfinite(here) && !(here <= best)) {
      best = here;
      number = c.number;
    }
  }
  return {label, std::isnan(best) ? "–" : fmt::format("{} {}", shown({factor * best}), unit),
          number > 0 ? fmt::format("case {}", number) : ""};
}

double largest_pressure(const io::CaseResult& c) { return largest(c, &io::PatchResult::pmax); }

/// Of all patches that roll; NaN without any.
double wear_number(const io::CaseResult& c) {
  double sum = NAN;
  for (const io::PatchResult& p : c.patches)
    if (const double one = p.wear_number(); !std::isnan(one)) sum = std::isnan(sum) ? one : sum + one;
  return sum;
}

/// The case with the largest pressure.
std::size_t worst_case(const io::RunResult& run) {
  std::size_t worst = 0;
  double most = -kInfinity;
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    const double pressure = largest_pressure(run.cases[i]);
    if (pressure > most && std::isfinite(pressure)) most = pressure, worst = i;
  }
  return worst;
}

Cards cards_of(const io::RunResult& run) {
  Cards cards;
  std::size_t solved = 0, patches = 0;
  for (const io::CaseResult& c : run.cases) {
    if (c.status == Status::ok) ++solved;
    patches = std::max(patches, c.patches.size());
  }
  cards.cards.push_back(
      {"Cases solved", fmt::format("{} of {}", solved, run.cases_total), run.complete ? "" : "interrupted"});
  cards.cards.push_back(extreme(run, "Largest pressure", "MPa", 1e-6, largest_pressure));
  cards.cards.push_back(extreme(run, "Largest normal force", "kN", 1e-3, [](const io::CaseResult& c) {
    double sum = c.patches.empty() ? NAN : 0.0;
    for (const io::PatchResult& p : c.patches) sum += p.fn;
    return sum;
  }));
  if (Cards::Card wear = extreme(run, "Largest wear number Tγ", "N", 1.0, wear_number); !wear.note.empty())
    cards.cards.push_back(std::move(wear));
  cards.cards.push_back({"Patches at once", fmt::format("{}", patches), "at most"});
  cards.cards.push_back(
      {"Wall-clock time", duration_text(run.seconds), counted(static_cast<std::size_t>(run.threads), "thread")});
  return cards;
}

Section overview(const io::RunResult& run) {
  Section section{"overview", "Overview"};
  add_run_banners(run, section);
  section.blocks.emplace_back(cards_of(run));
  return section;
}

}  // namespace

void add_run_banners(const io::RunResult& run, Section& overview, const std::string& name) {
  const auto add = [&](Banner::Kind kind, const std::string& heading, std::string text) {
    overview.blocks.emplace_back(Banner{kind, name.empty() ? heading : name + ": " + heading, std::move(text)});
  };
  if (!run.complete)
    add(Banner::Kind::failed, "Interrupted.",
        fmt::format("{} of {} cases were finished; the others are missing here.", run.cases.size(), run.cases_total));
  const auto list = [&](Status status) {
    std::string numbers;
    std::size_t count = 0;
    for (const io::CaseResult& c : run.cases)
      if (c.status == status && ++count <= 12) numbers += fmt::format("{}{}", numbers.empty() ? "" : ", ", c.number);
    return std::pair(count, count > 12 ? numbers + " ..." : numbers);
  };
  for (const std::string& doubt : run.doubts) add(Banner::Kind::warning, "Warning about a profile:", doubt);
  if (const auto [count, numbers] = list(Status::failed); count > 0) {
    std::string first;
    for (const io::CaseResult& c : run.cases)
      if (first.empty() && c.status == Status::failed) first = c.message;
    add(Banner::Kind::failed, counted(count, "case") + " failed.",
        fmt::format("Case {}. First message: {}", numbers, first));
  }
  if (const auto [count, numbers] = list(Status::not_converged); count > 0)
    add(Banner::Kind::warning, counted(count, "case") + " did not converge.",
        fmt::format("Judge the results with care: case {}.", numbers));
  if (const auto [count, numbers] = list(Status::no_contact); count > 0)
    add(Banner::Kind::note, counted(count, "case") + " without contact:", numbers);
  for (const RemarkRow& row : kRemarkRows) {
    std::size_t count = 0;
    std::string first;
    for (const io::CaseResult& c : run.cases)
      for (const Remark& r : c.remarks)
        if (r.kind == row.kind && ++count == 1)
          first = fmt::format("case {}, {}{}", c.number, r.patch > 0 ? fmt::format("patch {}: ", r.patch) : "", r.text);
    if (count > 0)
      add(row.grave ? Banner::Kind::warning : Banner::Kind::note, row.grave ? "Warning:" : "Minor warning:",
          count > 1 ? fmt::format("{} (the first of {})", first, count) : first);
  }
}

Page run_page(const std::shared_ptr<const io::RunResult>& run, std::string document) {
  Page page{"run", title_of(run->title, run->input_file), ""};
  page.lead = fmt::format(
      "{} {}", counted(run->cases.size(), "case"),
      ranges::any_of(run->cases, &io::CaseResult::has_wheelset) ? "of a wheel on a rail" : "of a contact patch");
  page.document = std::move(document);
  page.full_data = "fields.h5";
  page.sections.push_back(overview(*run));
  if (run->cases.empty()) return page;

  page.timeline = case_timeline(*run);
  page.timeline->start = worst_case(*run);
  page.sets.push_back(frames_of(run, "result"));
  page.surfaces = run->sampled;
  Section contact{"contact", "Contact"};
  if (has_fields(*run)) contact.blocks.emplace_back(Figure{"patches-view", "Contact patches", ContactView{{0}}});
  if (has_fields(*run) && !run->sampled.empty())
    contact.blocks.emplace_back(Figure{"positions", "Contact in the track", TrackView{0}, kTrackNote});
  if (!run->sampled.empty()) append(contact.blocks, body_figures("Wheel and rail"));
  if (run->cases.size() > 1) contact.blocks.emplace_back(Figure{"forces", "Forces and pressures", case_chart(*run)});
  if (!contact.blocks.empty()) page.sections.push_back(std::move(contact));
  if (std::optional<Section> below = subsurface_section(*run)) page.sections.push_back(std::move(*below));
  page.sections.push_back({"cases", "Cases", {case_table(*run), patch_table(*run)}});
  if (ranges::any_of(run->cases, [](const io::CaseResult& c) { return c.uncertainty.has_value(); }))
    page.sections.back().blocks.emplace_back(uncertainty_table(*run));
  add_origin(page, *run);
  return page;
}

}  // namespace treadmark::app::pages
