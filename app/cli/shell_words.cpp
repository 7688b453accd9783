// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/shell_words.hpp"

#include <sstream>

#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/core/parts.hpp"

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

}  // namespace

std::vector<OptionWords> option_words(const CLI::App& app) {
  std::vector<OptionWords> all;
  for (const CLI::Option* option : app.get_options()) {
    OptionWords words;
    for (const std::string& name : option->get_snames()) words.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) words.names.push_back("--" + name);
    if (option->get_items_expected_max() > 0) take_type(option->get_type_name(), words);
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
