// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/compare/pages/compare_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/compare/pages/compare_figures.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/pictures/comparison_cases.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using Candidate = ComparedCandidate;

/// "case 1, 2, 3 ...".
std::string listed(const std::vector<int>& cases) {
  constexpr std::size_t kMost = 12;
  std::string out = "case ";
  for (std::size_t i = 0; i < std::min(cases.size(), kMost); ++i)
    out += fmt::format("{}{}", i == 0 ? "" : ", ", cases[i]);
  return cases.size() > kMost ? out + " ..." : out;
}

/// Cases of a candidate that ended with this status, or that it lacks.
std::vector<int> cases_with(const ComparedCandidates& all, const Candidate& candidate, std::optional<Status> status) {
  std::vector<int> out;
  for (std::size_t i = 0; i < all.cases.size(); ++i) {
    const io::ComparisonRow* row = candidate.rows[i];
    if (status ? row != nullptr && row->status == *status : row == nullptr) out.push_back(all.cases[i]);
  }
  return out;
}

void add_status(const ComparedCandidates& all, std::optional<Status> status, Banner::Kind kind, const char* heading,
                Section& overview) {
  std::string text;
  for (const Candidate& candidate : all.candidates) {
    if (!candidate.data->failure.empty()) continue;
    const std::vector<int> cases = cases_with(all, candidate, status);
    if (!cases.empty()) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", candidate.label, listed(cases));
  }
  if (!text.empty()) overview.blocks.emplace_back(Banner{kind, heading, text + "."});
}

void add_banners(const io::Comparison& comparison, const ComparedCandidates& all, Section& overview) {
  if (!comparison.complete)
    overview.blocks.emplace_back(Banner{Banner::Kind::failed, "Interrupted.",
                                        fmt::format("{} finished; representations or cases are missing here.",
                                                    counted(all.candidates.size(), "representation") +
                                                        (all.candidates.size() == 1 ? " was" : " were"))});
  for (const Candidate& candidate : all.candidates)
    if (!candidate.data->failure.empty())
      overview.blocks.emplace_back(Banner{Banner::Kind::failed, candidate.label + " failed.", candidate.data->failure});
  add_status(all, Status::failed, Banner::Kind::failed, "Cases that failed:", overview);
  add_status(all, std::nullopt, Banner::Kind::failed, "Cases that are missing:", overview);
  add_status(all, Status::not_converged, Banner::Kind::warning,
             "Cases that did not converge; judge them with care:", overview);
  if (const std::vector<int> cases = io::cases_without_limit(comparison); !cases.empty())
    overview.blocks.emplace_back(
        Banner{Banner::Kind::note, "The largest pressure has no limit (edge_pressure):",
               listed(cases) + ". It tells nothing of representations there; force, mean pressure and area do."});
  add_status(all, Status::no_contact, Banner::Kind::note, "Cases without contact:", overview);
}

/// The candidates whose errors are known.
std::vector<const Candidate*> judged_candidates(const ComparedCandidates& all) {
  std::vector<const Candidate*> out;
  for (const Candidate& c : all.candidates)
    if (&c != all.truth() && std::isfinite(c.judged_error_percent)) out.push_back(&c);
  return out;
}

Cards cards_of(const io::Comparison& comparison, const ComparedCandidates& all) {
  std::size_t failed = 0;
  const Candidate* fastest = nullptr;
  for (const Candidate& c : all.candidates) {
    if (!c.data->failure.empty()) ++failed;
    if (std::isfinite(c.mean_seconds()) && (fastest == nullptr || c.mean_seconds() < fastest->mean_seconds()))
      fastest = &c;
  }
  Cards cards;
  cards.cards = {{"Representations", fmt::format("{}", all.candidates.size()),
                  failed > 0 ? fmt::format("{} failed", failed) : "the reference included"},
                 {"Cases", fmt::format("{}", all.cases.size()), ""}};
  const std::vector<const Candidate*> judged = judged_candidates(all);
  if (!judged.empty()) {
    const auto [best, worst] =
        ranges::minmax_element(judged, {}, [](const Candidate* c) { return c->judged_error_percent; });
    const auto error = [](const Candidate* c) { return fmt::format("{} %", shown({c->judged_error_percent, 3})); };
    const std::string of = all.pressure.error == &io::CandidateDigest::pmax_error ? "pressure" : all.pressure.words;
    cards.cards.push_back({"Least error of " + of, error(*best), (*best)->label});
    if (judged.size() > 1) cards.cards.push_back({"Greatest error of " + of, error(*worst), (*worst)->label});
  }
  if (fastest != nullptr)
    cards.cards.push_back({"Fastest detection", fmt::format("{} ms", shown({1e3 * fastest->mean_seconds(), 3})),
                           fastest->label + ", a case"});
  cards.cards.push_back({"Wall-clock time", duration_text(in_file(comparison.seconds)),
                         counted(static_cast<std::size_t>(comparison.threads), "thread")});
  return cards;
}

Facts comparison_facts(const io::Comparison& comparison) {
  Facts facts = origin_facts(comparison);
  facts.entries.insert(facts.entries.begin() + 1, {"Reference", comparison.truth});
  return facts;
}

/// Without fields the number of the case is all that is known of it.
Timeline numbered(const std::vector<int>& cases) {
  Timeline timeline{"case"};
  Axis axis{"case", ""};
  for (const int number : cases) {
    timeline.names.push_back(fmt::format("case {}", number));
    axis.values.push_back(static_cast<double>(number));
  }
  timeline.axes.push_back(std::move(axis));
  return timeline;
}

io::CaseResult result_of(const io::ComparisonCandidate& candidate, int number) {
  if (const io::CaseResult* found = pictures::find_result(candidate, number)) return *found;
  io::CaseResult result;
  result.number = number;
  result.status = Status::failed;
  result.message = "This representation has no result of this case.";
  return result;
}

/// A set a candidate that was solved, the truth first, with a frame for every case of the comparison.
std::vector<FrameSet> sets_of(const std::shared_ptr<const io::Comparison>& comparison, const ComparedCandidates& all,
                              const std::vector<std::string>& names) {
  std::vector<FrameSet> sets;
  for (const Candidate& candidate : all.candidates) {
    if (!candidate.solved()) continue;
    FrameSet set{candidate.label + (&candidate == all.truth() ? " (reference)" : "")};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const io::CaseResult* found = pictures::find_result(*candidate.data, all.cases[i]);
      set.frames.push_back(
          {names[i], found ? std::shared_ptr<const io::CaseResult>(comparison, found)
                           : std::make_shared<io::CaseResult>(result_of(*candidate.data, all.cases[i]))});
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

Section accuracy_section(const ComparedCandidates& all) {
  Section section{"accuracy", "Accuracy against cost"};
  const auto add = [&](const char* id, const char* title, ChartView view, const char* note) {
    std::erase_if(view.panels, [](const Panel& panel) { return panel.series.empty(); });
    if (!view.panels.empty()) section.blocks.emplace_back(Figure{id, title, std::move(view), note});
  };
  add("accuracy-chart", "Accuracy over resolution", accuracy_chart(all),
      "Largest error of pressure and largest deviation of wheel and rail, over all cases. Values below "
      "0.001, zero included, "
      "are shown at 0.001. Levels belong to data as given, which is not sampled.");
  add("trade-chart", "Accuracy against time", trade_chart(all),
      "Largest error of pressure over the cases. Towards the lower left it is faster and more "
      "accurate. Errors below "
      "0.001 % are shown there.");
  add("cost-chart", "Cost over resolution", cost_chart(all),
      "Detection: contact search and undeformed distance, mean over the cases. Memory and time to build: wheel and "
      "rail together.");
  return section;
}

bool has_results(const io::Comparison& comparison) {
  return !comparison.candidates.empty() && !comparison.candidates.front().results.empty();
}

/// picture, note: in place of fields, and what the folder lacks.
Page page_of(const std::shared_ptr<const io::Comparison>& data, std::string document, std::vector<Block> picture,
             std::vector<Block> note) {
  const io::Comparison& comparison = *data;
  const ComparedCandidates all = compared(comparison);
  Page page{"compare", title_of(comparison.title, comparison.input_file),
            fmt::format("{} on {}, measured against {}", counted(all.candidates.size(), "representation"),
                        counted(all.cases.size(), "case"), comparison.truth)};
  page.document = std::move(document);
  page.full_data = "fields.h5";

  Section contact{"contact", "Contact"};
  if (has_results(comparison)) {
    io::RunResult truth;
    for (const int number : all.cases) truth.cases.push_back(result_of(comparison.candidates.front(), number));
    page.timeline = case_timeline(truth);
    page.sets = sets_of(data, all, page.timeline->names);
    ContactView view;
    for (std::size_t i = 0; i < page.sets.size(); ++i) view.sets.push_back(static_cast<int>(i));
    contact.blocks.emplace_back(Figure{"contact-view", "Contact patches", std::move(view)});
    page.surfaces = comparison.candidates.front().surfaces;
    if (!page.surfaces.empty()) append(contact.blocks, body_figures("Wheel and rail, the reference"));
  } else {
    if (!all.cases.empty()) page.timeline = numbered(all.cases);
    append(contact.blocks, std::move(picture));
  }
  if (all.cases.size() > 1) {
    const std::vector<const Candidate*> drawn = drawn_over_cases(all);
    const auto solved = ranges::count_if(all.candidates, &Candidate::solved);
    contact.blocks.emplace_back(
        Figure{"cases-chart", "Results over the cases", case_errors_chart(all),
               static_cast<std::size_t>(solved) > drawn.size()
                   ? "Of every representation the finest resolution; the others are in the table below."
                   : "Of the patch that carries most of the load."});
  }

  Section overview{"overview", "Overview"};
  add_banners(comparison, all, overview);
  append(overview.blocks, std::move(note));
  overview.blocks.emplace_back(cards_of(comparison, all));
  page.sections.push_back(std::move(overview));
  for (Section section : {accuracy_section(all), std::move(contact)})
    if (!section.blocks.empty()) page.sections.push_back(std::move(section));
  Section tables{"tables", "Figures", {candidate_table(all)}};
  if (!all.cases.empty()) tables.blocks.emplace_back(compared_row_table(all));
  page.sections.push_back(std::move(tables));
  add_origin(page, comparison, comparison_facts(comparison));
  return page;
}

}  // namespace

Page compare_page(const std::shared_ptr<const io::Comparison>& comparison, std::string document) {
  return page_of(comparison, std::move(document), {}, {});
}

Page compare_page(const std::filesystem::path& folder) {
  const auto comparison = std::make_shared<const io::Comparison>(io::read_comparison(folder));
  OptionalFiles files(folder);
  std::vector<Block> picture;
  if (!has_results(*comparison)) {
    if (!compared(*comparison).cases.empty()) files.has("fields.h5", "contact fields");
    picture = files.picture("pressures.svg", "pressures", "Contact pressures",
                            "The first case, and those in which the errors of the largest pressure differ most.");
  }
  return page_of(comparison, io::profiles::read_text(folder / "compare.json", "result", {}), std::move(picture),
                 files.note());
}

}  // namespace treadmark::app::pages
