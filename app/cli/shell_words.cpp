// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/shell_words.hpp"

#include <iterator>
#include <sstream>

#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::cli {
namespace {

/// "TEXT:{wheel,rail}" as its word and its choices.
void take_type(const std::string& type, OptionWords& words) {
  const std::size_t colon = type.find(':');
  words.value = type.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string rule = type.substr(colon + 1);
  if (rule.size() < 2 || rule.front() != '{' || rule.back() != '}') return;
  std::istringstream list(rule.substr(1, rule.size() - 2));
  for (std::string choice; std::getline(list, choice, ',');) words.choices.push_back(choice);
}

/// Keys of the files of some verbs; the last row: of all others.
struct KeysOf {
  const char *list, *verbs, *part;
  std::string (*schema)();
};
constexpr KeysOf kKeysOf[] = {{"import_keys", " import ", "scans", import_schema},
                              {"simulation_keys", " simulate stability response sweep ", "vehicle", simulation_schema},
                              {"evolution_keys", " evolve ", "vehicle", evolve_schema},
                              {"design_keys", " design ", "vehicle", design_schema},
                              {"track_keys", " track ", "vehicle", track_schema},
                              {"case_keys", "", nullptr, io::case_file_schema}};

std::string list_of(const std::string& verb, const std::string& value) {
  if (value != kSettingWord) return value == kProfileName ? "profiles" : value == kBackendName ? "backends" : "";
  for (const KeysOf& row : kKeysOf)
    if (std::string(row.verbs).find(' ' + verb + ' ') != std::string::npos) return row.list;
  return std::rbegin(kKeysOf)->list;
}

void add_keys(const io::Json& schema, const std::string& path, std::vector<std::string>& keys) {
  if (!schema.contains("properties")) return keys.push_back(path + '=');
  for (const auto& [name, inner] : schema.at("properties").items())
    add_keys(inner, path.empty() ? name : path + '.' + name, keys);
}

}  // namespace

std::vector<NameList> name_lists() {
  std::vector<NameList> lists{{"profiles", {}}, {"backends", {}}};
  for (const LibraryProfile& profile : profile_library())
    if (profile.name.find_first_of(" :") == std::string::npos) lists[0].names.push_back(profile.name);
  for (const auto name : backend_names()) lists[1].names.emplace_back(name);
  for (const KeysOf& row : kKeysOf)
    if (row.part == nullptr || has_part(row.part))
      add_keys(io::Json::parse(row.schema()), "", lists.emplace_back(NameList{row.list, {}}).names);
  return lists;
}

std::vector<OptionWords> option_words(const CLI::App& app) {
  std::vector<OptionWords> all;
  for (const CLI::Option* option : app.get_options()) {
    OptionWords words;
    for (const std::string& name : option->get_snames()) words.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) words.names.push_back("--" + name);
    if (option->get_items_expected_max() > 0) take_type(option->get_type_name(), words);
    words.list = list_of(app.get_name(), words.value);
    if (words.names.empty()) words.value = option->get_name(true);
    words.description = option->get_description();
    words.required = option->get_required();
    words.repeated = words.names.empty() && option->get_items_expected_max() > 1;
    all.push_back(std::move(words));
  }
  return all;
}

std::vector<const CLI::App*> verbs_of(const CLI::App& program) {
  std::vector<const CLI::App*> all;
  for (const Verb& verb : verbs())
    if (verb.part == nullptr || has_part(verb.part)) all.push_back(program.get_subcommand(verb.name));
  return all;
}

}  // namespace treadmark::cli
