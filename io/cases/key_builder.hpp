// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/model/backend_name.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::io {

/// Words and enumerators of the theories that cases of this kind may use.
template <class Content, class Id, std::size_t count>
std::vector<std::pair<std::string, Id>> words_of(const Theory<Id> (&table)[count]) {
  std::vector<std::pair<std::string, Id>> words;
  for (const Theory<Id>& row : table)
    if (scope_of<Content, Case>() != KeyScope::wheel_rail || !row.limits.patch_only)
      words.emplace_back(row.word, row.id);
  return words;
}

template <class Id, std::size_t count>
std::string names_of(const Theory<Id> (&table)[count]) {
  std::string names;
  for (const Theory<Id>& row : table) names.append(names.empty() ? "" : "; ").append(row.name);
  return names;
}

/// tangential_model and the fastsim_... keys under prefix.
template <class Content>
void add_simplified_theory(KeyList& list, const std::string& prefix) {
  list.choice<Content>(prefix + "tangential_model", words_of<Content>(kTangentialTheories),
                       "tractions: " + names_of(kTangentialTheories),
                       [](Content& c) -> TangentialModel& { return c.tangential_model; });
  list.number<Content>(prefix + "fastsim_k0", kPositive, "FASTSIM: initial slope reduction",
                       [](Content& c) -> double& { return c.fastsim.k0; });
  list.number<Content>(prefix + "fastsim_alpha", kNotNegative, "FASTSIM: slope at large creepage over the initial one",
                       [](Content& c) -> double& { return c.fastsim.alpha; });
  list.number<Content>(prefix + "fastsim_beta", kNotNegative, "FASTSIM: rate of the slope reduction",
                       [](Content& c) -> double& { return c.fastsim.beta; });
  list.number<Content>(prefix + "fastsim_flexibility_mm_per_MPa", kPositive,
                       "flexibility of \"fastsim_one_flexibility\"",
                       [](Content& c) -> double& { return c.fastsim.flexibility; });
  using FirstStep = FastsimSettings::FirstStep;
  list.choice<Content, FirstStep>(prefix + "fastsim_first_step",
                                  {{"half", FirstStep::half}, {"whole", FirstStep::whole}},
                                  "FASTSIM: from the leading edge to the middle of the first element: half an element, "
                                  "or a whole one as CONTACT (and .inp) has it, of first order",
                                  [](Content& c) -> FirstStep& { return c.fastsim.first_step; });
}

/// The number of a part that a case need not have, and that asking for the number would make: without the part the key
/// says nothing.
inline void say_only_where(CaseKey& key, KeyFunction<bool(const Case&)> has) {
  key.get = [has, get = key.get](const Case& c) { return has(c) ? get(c) : kNaN; };
  key.written = [has, written = key.written](const Case& c, const std::filesystem::path& folder) {
    return has(c) ? written(c, folder) : std::string();
  };
}

/// Keys by subject; see the .cpp of the same name.
void add_general_keys(KeyList& list);
void add_material_keys(KeyList& list);
void add_friction_keys(KeyList& list);
void add_shape_keys(KeyList& list);
void add_part_keys(KeyList& list);
void add_defect_keys(KeyList& list);
void add_wheel_rail_keys(KeyList& list);
void add_balance_keys(KeyList& list);
void add_patch_keys(KeyList& list);
void add_patch_geometry_keys(KeyList& list);
void add_heat_keys(KeyList& list);
void add_subsurface_keys(KeyList& list);

}  // namespace treadmark::io
