// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Completions for shells, from what --help is made of.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/shell_words.hpp"

namespace treadmark::cli {
namespace {

/// Within single quotes of any shell; what else a shell would see there is left out.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text)
    if (c != '\'' && c != '\\') out += c;
  return out + "'";
}

std::string names_of(const std::vector<OptionWords>& options) {
  std::string all;
  for (const OptionWords& option : options)
    for (const std::string& name : option.names) all += (all.empty() ? "" : " ") + name;
  return all;
}

std::string verb_names(const CLI::App& program, const char* between) {
  std::string all;
  for (const CLI::App* verb : verbs_of(program)) all += (all.empty() ? "" : between) + verb->get_name();
  return all;
}

std::string bash(const CLI::App& program) {
  std::string lists, rows, choices;
  for (const NameList& list : name_lists())
    lists += fmt::format("  local {}={}\n", list.list, quoted(fmt::format("{}", fmt::join(list.names, " "))));
  for (const CLI::App* verb : verbs_of(program)) {
    const std::vector<OptionWords> options = option_words(*verb);
    rows += fmt::format("    {}) options+={} ;;\n", verb->get_name(), quoted(" " + names_of(options)));
    for (const OptionWords& option : options)
      if (!option.list.empty())
        choices += fmt::format("    {}\\ {}) words=${}{} ;;\n", verb->get_name(),
                               option.names.empty() ? "[!-]*" : option.names.back(), option.list,
                               option.list == "profiles"        ? "' '$(compgen -f -- \"$word\")"
                               : option.list.ends_with("_keys") ? "; compopt -o nospace 2>/dev/null"
                                                                : "");
      else if (!option.choices.empty())
        choices += option.names.empty()
                       ? fmt::format("    {0}\\ {0}) words={1} ;;\n", verb->get_name(),
                                     quoted(fmt::format("{}", fmt::join(option.choices, " "))))
                       : fmt::format("    {}\\ {}) words={} ;;\n", verb->get_name(), option.names.back(),
                                     quoted(fmt::format("{}", fmt::join(option.choices, " "))));
  }
  return fmt::format(R"(# bash completion of treadmark; made by: treadmark completion bash
_treadmark() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb= words= i
  local options={}
{}  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in {}) verb=${{COMP_WORDS[i]}}; break ;; esac
  done
  case "$verb" in
    '') words={} ;;
{}  esac
  case "$verb $before" in
{}  esac
  [[ $word != -* ]] || words=$options
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _treadmark treadmark
)",
                     quoted(names_of(option_words(program))), lists, verb_names(program, "|"),
                     quoted(verb_names(program, " ")), rows, choices);
}

/// Of _arguments: '(-o --output)'{-o,--output}'[text]:FILE:_files'.
std::string zsh_row(const OptionWords& option) {
  std::string text = quoted(option.description), what = ":_files";
  text = text.substr(1, text.size() - 2);
  std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == ':'; });
  if (!option.list.empty())
    what = fmt::format(":{{compadd {}-a {}; _files}}", option.list.ends_with("_keys") ? "-S \"\" " : "", option.list);
  if (!option.choices.empty()) what = fmt::format(":({})", fmt::join(option.choices, " "));
  if (option.names.empty())
    return fmt::format("'{}:{}{}'", option.repeated ? "*" : "", option.value.empty() ? "value" : option.value, what);
  std::string all;
  for (const std::string& name : option.names)
    all +=
        fmt::format(" '*{}[{}]{}'", name, text, option.value.empty() ? "" : fmt::format(":{}{}", option.value, what));
  return all.substr(1);
}

std::string zsh(const CLI::App& program) {
  const auto rows_of = [](const CLI::App& app) {
    std::string rows;
    for (const OptionWords& option : option_words(app)) rows += " \\\n      " + zsh_row(option);
    return rows;
  };
  std::string lists, verbs, rows;
  for (const NameList& list : name_lists())
    lists += fmt::format("  local -a {}=({})\n", list.list, fmt::join(list.names, " "));
  for (const CLI::App* verb : verbs_of(program)) {
    std::string text = verb->get_description();
    std::erase(text, ':');
    verbs += "\n    " + quoted(verb->get_name() + ":" + text);
    rows += fmt::format("    {}) _arguments{} ;;\n", verb->get_name(), rows_of(*verb));
  }
  return fmt::format(R"(#compdef treadmark
# zsh completion of treadmark; made by: treadmark completion zsh
_treadmark() {{
{}  local -a verbs=({}
  )
  local verb=${{words[(r)({})]}}
  case $verb in
    '') _arguments{} '*: :->verb' && return
      [[ -z $state ]] || _describe verb verbs ;;
{}  esac
}}
_treadmark "$@"
)",
                     lists, verbs, verb_names(program, "|"), rows_of(program), rows);
}

std::string fish(const CLI::App& program) {
  std::string out = "# fish completion of treadmark; made by: treadmark completion fish\n";
  for (const NameList& list : name_lists()) out += fmt::format("set -l {} {}\n", list.list, fmt::join(list.names, " "));
  const auto add = [&](const CLI::App& app, const std::string& where) {
    for (const OptionWords& option : option_words(app)) {
      std::string row = "complete -c treadmark" + where;
      for (const std::string& name : option.names)
        row += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty() && !option.names.empty()) row += option.choices.empty() ? " -r" : " -x";
      if (!option.choices.empty()) row += " -a " + quoted(fmt::format("{}", fmt::join(option.choices, " ")));
      if (!option.list.empty()) row += fmt::format(" -a \"${}\"", option.list);
      if (!option.names.empty() || !option.choices.empty() || !option.list.empty())
        out += row + " -d " + quoted(option.description) + '\n';
    }
  };
  add(program, "");
  for (const CLI::App* verb : verbs_of(program)) {
    out += fmt::format("complete -c treadmark -n __fish_use_subcommand -f -a {} -d {}\n", verb->get_name(),
                       quoted(verb->get_description()));
    add(*verb, fmt::format(" -n '__fish_seen_subcommand_from {}'", verb->get_name()));
  }
  return out;
}

struct Shell {
  const char* name;
  std::string (*script)(const CLI::App& program);
};
constexpr Shell kShells[] = {{"bash", bash}, {"zsh", zsh}, {"fish", fish}};

}  // namespace

Command add_completion(CLI::App& verb) {
  auto name = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const Shell& shell : kShells) names.emplace_back(shell.name);
  verb.add_option("SHELL", *name, "bash, zsh or fish")->required()->check(CLI::IsMember(names));
  return [name, program = verb.get_parent()](const CommonOptions&) -> int {
    for (const Shell& shell : kShells)
      if (*name == shell.name) std::cout << shell.script(*program);
    return kOk;
  };
}

}  // namespace treadmark::cli
