// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"

namespace treadmark::io {

namespace {

struct Said {
  const KeyInfo* key;
  std::string value;
  friend bool operator==(const Said&, const Said&) = default;
};

std::string value_of(const CaseKey& key, const Case& c, const std::filesystem::path& folder) {
  return key.written ? key.written(c, folder) : key.text ? key.text(c) : std::string();
}

/// What differs from a case without keys, in the order of the keys; of two units the shorter number.
std::vector<Said> said_of(const Case& c, const std::filesystem::path& folder) {
  const bool patch = std::holds_alternative<BasicCase>(c.content);
  const Case fresh = case_without_keys(patch);
  const KeyScope scope = patch ? KeyScope::patch : KeyScope::wheel_rail;
  std::vector<Said> all;
  for (const CaseKey& key : case_keys()) {
    const KeyInfo& info = key.info;
    if ((info.scope != KeyScope::any && info.scope != scope) || info.path == "case.steps" ||
        info.path == "case.time_step_s")
      continue;  // the last two make cases, which are made
    std::string value = value_of(key, c, folder);
    if (value.empty() || value == value_of(key, fresh, folder)) continue;
    const auto other = std::ranges::find_if(all, [&](const Said& s) {
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
    return std::ranges::all_of(bundles, [&](const Bundles& b) { return list(b) == list(bundles.front()); });
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

}  // namespace treadmark::io
