// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/pages/check_page.hpp"

#include <fmt/format.h>

#include "treadmark/app/pages/page_parts.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

void add_banners(const std::vector<CheckedInput>& inputs, Section& overview) {
  for (const CheckedInput& input : inputs) {
    for (const std::string& doubt : input.doubts)
      overview.blocks.emplace_back(Banner{Banner::Kind::warning, "Warning:", doubt});
    for (const auto& [name, judgement] : input.profiles)
      for (const io::ProfileRemark& remark : judgement.remarks)
        overview.blocks.emplace_back(
            Banner{Banner::Kind::warning, "Warning:", fmt::format("{}: {}: {}", name, remark.name, remark.text)});
  }
}

Section section_of(const CheckedInput& input, std::size_t number) {
  Section section{fmt::format("input-{}", number), input.file};
  if (!input.outcome.empty()) section.blocks.emplace_back(Paragraph{input.outcome});
  for (const std::string& note : input.notes) section.blocks.emplace_back(Banner{Banner::Kind::note, "Note:", note});
  if (!input.inputs.empty()) section.blocks.emplace_back(Facts{input.inputs});
  for (const auto& [name, judgement] : input.profiles) {
    Facts facts{{{"profile", name}}};
    facts.entries.insert(facts.entries.end(), judgement.facts.begin(), judgement.facts.end());
    for (const std::string& note : judgement.notes) facts.entries.emplace_back("note", note);
    section.blocks.emplace_back(std::move(facts));
  }
  for (std::size_t k = 0; k < input.positions.size(); ++k)
    section.blocks.emplace_back(Figure{fmt::format("position-{}-{}", number, k + 1), input.positions[k].first,
                                       PictureView{input.positions[k].second}});
  return section;
}

}  // namespace

Page check_page(const std::vector<CheckedInput>& inputs) {
  Page page{"check", inputs.size() == 1 ? title_of(inputs.front().title, inputs.front().file) : "Check",
            fmt::format("What was understood of {}", counted(inputs.size(), "file"))};
  Section overview{"overview", "Overview"};
  add_banners(inputs, overview);
  if (overview.blocks.empty()) overview.blocks.emplace_back(Paragraph{"No warnings about profiles."});
  page.sections.push_back(std::move(overview));
  for (std::size_t k = 0; k < inputs.size(); ++k) page.sections.push_back(section_of(inputs[k], k + 1));
  return page;
}

}  // namespace treadmark::app::pages
