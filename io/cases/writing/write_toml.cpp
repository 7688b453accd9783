// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iterator>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"

namespace treadmark::io {

namespace {

struct Said {
  const KeyInfo* key;
  std::string value;
  friend bool operator==(const Said&, const Said&) = default;
};

/// Whether a file says something of cases of this kind by the key.
bool says(const KeyInfo& key, bool patch) {
  const KeyScope scope = patch ? KeyScope::patch : KeyScope::wheel_rail;
  return (key.scope == KeyScope::any || key.scope == scope) && key.path != "case.steps" &&
         key.path != "case.time_step_s";  // they make cases, which are made
}

/// What differs from a case without keys, in the order of the keys; of two units the shorter number.
std::vector<Said> said_of(const Case& c, const std::filesystem::path& folder) {
  const bool patch = std::holds_alternative<BasicCase>(c.content);
  const Case fresh = case_without_keys(patch);
  std::vector<Said> all;
  for (const CaseKey& key : case_keys()) {
    const KeyInfo& info = key.info;
    if (!says(info, patch)) continue;
    std::string value = value_of(key, c, folder);
    if (value.empty() || value == value_of(key, fresh, folder)) continue;
    const auto other = ranges::find_if(all, [&](const Said& s) {
      return !info.group.empty() && s.key->group == info.group && s.key->alternative != info.alternative;
    });
    if (other == all.end())
      all.push_back({&info, std::move(value)});
    else if (value.size() < other->value.size())
      *other = {&info, std::move(value)};
  }
  return all;
}

std::string section_of(const KeyInfo& key) { return key.path.substr(0, key.path.find('.')); }

/// Sections that stand or fall together: what a key of one makes of another depends on their order.
std::string bundle_of(const KeyInfo& key) { return key.path == "case.reference_ways" ? "heat" : section_of(key); }

using Bundles = std::map<std::string, std::vector<Said>>;

Bundles bundles_of(const std::vector<Said>& said) {
  Bundles bundles;
  for (const Said& one : said) bundles[bundle_of(*one.key)].push_back(one);
  return bundles;
}

}  // namespace

std::string case_file_text(const CaseFile& file, const std::filesystem::path& folder) {
  const bool patch = !file.cases.empty() && std::holds_alternative<BasicCase>(file.cases.front().content);
  std::vector<std::vector<Said>> said;
  std::vector<Bundles> bundles;
  for (const Case& c : file.cases) {
    if (std::holds_alternative<BasicCase>(c.content) != patch)
      throw Error(
          ErrorKind::configuration,
          fmt::format("case {}: a case file holds either wheels on rails or single patches, not both", c.number),
          c.where, "write each kind into a file of its own");
    said.push_back(said_of(c, folder));
    bundles.push_back(bundles_of(said.back()));
  }
  const auto shared = [&](const std::string& bundle) {
    const auto list = [&](const Bundles& b) {
      const auto found = b.find(bundle);
      return found == b.end() ? std::vector<Said>() : found->second;
    };
    return ranges::all_of(bundles, [&](const Bundles& b) { return list(b) == list(bundles.front()); });
  };

  std::string out = fmt::format("title = {}\n", toml_text(file.title)), section;
  if (said.empty()) return out;
  std::map<std::string, std::vector<Said>> at_top;
  std::vector<std::string> order;
  for (const Said& one : said.front()) {
    if (!shared(bundle_of(*one.key))) continue;
    auto& list = at_top[section_of(*one.key)];
    if (list.empty()) order.push_back(section_of(*one.key));
    list.push_back(one);
  }
  if (patch && !at_top.contains("patch")) out += "\n[patch]\n";
  for (const std::string& name : order) {
    out += fmt::format("\n[{}]\n", name);
    for (const Said& one : at_top.at(name))
      out += fmt::format("{} = {}\n", one.key->path.substr(name.size() + 1), one.value);
  }
  if (said.size() == 1) return out;
  for (const std::vector<Said>& one : said) {
    out += "\n[[cases]]\n";
    for (const Said& key : one)
      if (!shared(bundle_of(*key.key))) out += fmt::format("{} = {}\n", key.key->path, key.value);
  }
  return out;
}

Inputs inputs_of(std::span<const Case> cases, const std::filesystem::path& folder) {
  // Said even where they are as without their keys.
  constexpr std::string_view kAlways[] = {"case.side",
                                          "case.regime",
                                          "friction.law",
                                          "friction.coefficient",
                                          "solver.normal_model",
                                          "solver.tangential_model",
                                          "track.gauge_mm",
                                          "track.cant_deg",
                                          "wheelset.nominal_radius_mm",
                                          "wheelset.y_mm",
                                          "wheelset.velocity_km_h",
                                          "discretisation.dx_mm",
                                          "discretisation.ds_mm"};
  InputList inputs;
  if (cases.empty()) return {};
  const std::size_t kind = cases.front().content.index();
  const bool patch = std::holds_alternative<BasicCase>(cases.front().content);
  const Case fresh = case_without_keys(patch);
  for (const CaseKey& key : case_keys()) {
    if (!says(key.info, patch)) continue;
    const bool always = ranges::find(kAlways, key.info.path) != std::end(kAlways);
    // A number that its text says alone need not be written to be compared.
    const bool plain = key.get && key.info.group.empty() && key.info.choices.empty();
    const auto unusual = [&](const Case& c) { return c.content.index() == kind && key.get(c) != key.get(fresh); };
    if (plain && !always && ranges::none_of(cases, unusual)) continue;
    std::vector<std::string> values;
    double last = kNaN;
    for (const Case& c : cases) {
      if (c.content.index() != kind) continue;
      const double number = plain ? key.get(c) : kNaN;
      if (number == last) continue;
      values.push_back(value_of(key, c, folder));
      last = number;
    }
    const std::string usual = value_of(key, fresh, folder);
    if (always || ranges::any_of(values, [&](const std::string& value) { return value != usual; }))
      inputs.add(key.info, key.info.path, values);
  }
  return inputs.words();
}

}  // namespace treadmark::io
