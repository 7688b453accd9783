// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/contact/theories.hpp"

#include <fmt/format.h>

namespace treadmark {

namespace {

std::string limits_in_words(const TheoryLimits& limits) {
  std::string words;
  const auto add = [&](bool holds, std::string_view what) {
    if (holds) words += fmt::format("; {}", what);
  };
  add(limits.patch_only, "[patch] only");
  add(limits.hertzian, "Hertzian geometry");
  add(limits.given_approach, "a [patch] needs a given approach");
  add(limits.steady_only, "steady rolling only");
  add(limits.rolling_only, "rolling only");
  add(limits.full_normal, "full normal problem only");
  return words;
}

template <class Id, std::size_t count>
std::string section(std::string_view title, const Theory<Id> (&table)[count]) {
  std::string text = fmt::format("{}\n", title);
  for (const Theory<Id>& row : table)
    text += fmt::format("  {:<24}{}{}\n", row.word, row.name, limits_in_words(row.limits));
  return text;
}

}  // namespace

std::string theory_list() {
  return section("normal problem (solver.normal_model, patch.normal_model)", kNormalTheories) +
         section("tangential problem (solver.tangential_model, patch.tangential_model)", kTangentialTheories) +
         section("what moves (case.regime)", kRegimes) +
         section("influence coefficients (influence.kind)", kInfluenceKinds);
}

}  // namespace treadmark
