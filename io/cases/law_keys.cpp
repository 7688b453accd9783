// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/law_keys.hpp"

#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace treadmark::io {

namespace {

constexpr const char* kSourceDoc = "where the numbers come from; results repeat it";

/// Which law of a registry, and the source of its numbers.
template <class Law, class Rows>
void add_law(KeyRows<Law>& list, const Rows& rows) {
  std::vector<std::pair<std::string, decltype(Law::theory)>> words;
  for (const auto& row : rows) words.emplace_back(row.word, row.theory);
  list.choice("theory", std::move(words), "see `treadmark list laws`", &Law::theory, kNeeded);
  list.text("source", kSourceDoc, &Law::source, kNeeded);
}

}  // namespace

const KeyTable<WearLaw>& wear_law_keys() {
  using L = WearLaw;
  static const auto keys = key_table<L>([](auto& list) {
    add_law(list, kWearTheories);
    for (const WearNumber& n : kWearNumbers)
      std::visit(
          [&](auto value) {
            const KeyLimits limits = n.may_be_zero ? kNotNegative : kPositive;
            if constexpr (std::is_same_v<decltype(value), double L::*>)
              list.number(std::string(n.key), limits, std::string(n.meaning), value,
                          may_lack(n, value) ? 0 : kNoDefault);
            else
              list.number_list(std::string(n.key), limits, std::string(n.meaning), value);
          },
          n.value);
  });
  return keys;
}

const KeyTable<FatigueSettings>& fatigue_keys() {
  using F = FatigueSettings;
  static const auto keys = key_table<F>([](auto& list) {
    std::string words;
    for (const FatigueMeasureRow& row : fatigue_measures())
      words += fmt::format("{}`\"{}\"`", words.empty() ? "" : ", ", row.word);
    list.value(key_info("measures", KeyType::text_list, words + ": see `treadmark list laws`"), &F::measures, kNeeded,
               "name some, or leave the table out");
    list.text("source", kSourceDoc, &F::source, kNeeded);
    for (const FatigueNumber& number : kFatigueNumbers)
      list.number(std::string(number.key), kPositive, std::string(number.meaning), number.value, kNoDefault);
    list.number_list("depths_mm", kPositive,
                     "subsurface, dang_van: below the surface, increasing, from the size of an element on", &F::depths);
    list.number_list("t_gamma_N", kNotNegative,
                     "whole_life: points of a broken line, which goes on straight behind the last", &F::t_gamma);
    list.number_list("damage_per_passage", kAnyNumber,
                     "whole_life: at these points; 1: failure, negative: wear takes more than fatigue adds",
                     &F::passage_damage);
  });
  return keys;
}

const KeyTable<FlowLaw>& flow_law_keys() {
  using L = FlowLaw;
  static const auto keys = key_table<L>([](auto& list) {
    add_law(list, kFlowTheories);
    list.number("shear_yield_MPa", kPositive, "k of the fresh material, in cyclic shear", &L::shear_yield, kNoDefault);
    list.number("strain_per_cycle", kPositive,
                "C: shear strain of a passage with twice the shear stress at which the material yields",
                &L::strain_per_cycle, kNoDefault);
    list.number_list("depths_mm", kPositive,
                     "of the layers, increasing, at least two: from the size of an element down to where nothing flows",
                     &L::depths);
    list.number("hardening_factor", kPositive,
                "beta: yield after much strain over k; without it the material does not harden", &L::hardening_factor,
                kNoDefault);
    list.number("hardening_rate", kPositive, "alpha: yield is k max(1, beta sqrt(1 - exp(-alpha strain)))",
                &L::hardening_rate, kNoDefault);
  });
  return keys;
}

std::string numbers_of(const NamedLaw& law) {
  std::string text;
  const auto add = [&](const auto& keys, const auto& numbers, const auto& none) {
    for (const auto& key : keys.rows)
      if (key.info.type == KeyType::number || key.info.type == KeyType::number_list)
        if (const std::string line = written_line(key, numbers); line != written_line(key, none))
          text += (text.empty() ? "" : "; ") + line;
  };
  if (const auto* wear = std::get_if<WearLaw>(&law.numbers)) add(wear_law_keys(), *wear, WearLaw{});
  if (const auto* fatigue = std::get_if<FatigueSettings>(&law.numbers))
    add(fatigue_keys(), *fatigue, FatigueSettings{});
  return text;
}

}  // namespace treadmark::io
