// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/usage_faults.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "treadmark/app/cli/shell_words.hpp"
#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/settings/toml_faults.hpp"

namespace treadmark::cli {
namespace {

bool is_verb(const std::string& word) {
  return ranges::any_of(verbs(), [&](const Verb& verb) { return word == verb.name; });
}

/// Where the verb stands: the first word that is no option, nor the value of one.
std::size_t place_of_verb(const std::vector<std::string>& words) {
  std::size_t at = 0;
  while (at < words.size() && words[at].starts_with("-"))
    at += words[at] == "--threads" || words[at] == "--plugin" ? 2 : 1;
  return std::min(at, words.size());
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const OptionWords& words : option_words(app))
    ranges::copy_if(words.names, std::back_inserter(names), [](const auto& name) { return name.starts_with("--"); });
  return names;
}

bool has_option(const CLI::App& app, const std::string& name) { return ranges::count(option_names(app), name) > 0; }

/// "treadmark run [OPTIONS] CASE..."
std::string call_of(const CLI::App& program, const CLI::App* verb) {
  if (verb == nullptr) return "treadmark VERB [OPTIONS] ...";
  std::string call =
      fmt::format("{} {} [OPTIONS]", program.get_name().empty() ? "treadmark" : program.get_name(), verb->get_name());
  for (const CLI::Option* place : verb->get_options()) {
    if (!place->get_positional()) continue;
    const std::string one = place->get_name(true) + (place->get_items_expected_max() > 1 ? "..." : "");
    call += place->get_required() ? ' ' + one : " [" + one + ']';
  }
  return call;
}

struct Said {
  std::string message, advice;
};

Said unknown_option(const CLI::App& program, const CLI::App* verb, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (word.size() > 1 && std::string_view("0123456789.").find(word[1]) != std::string_view::npos)
    return {fmt::format("'{}' is taken for an option", word),
            fmt::format("a negative value stands behind a =: --option={}", word)};
  std::vector<std::string> known = option_names(program);
  if (verb != nullptr) ranges::copy(option_names(*verb), std::back_inserter(known));
  const std::string asked = name.starts_with("--") ? name : '-' + name;
  Said said{fmt::format("there is no option '{}'", name), ""};
  for (const std::string& one : known)
    if (said.advice.empty() && asked.size() > 3 && one.starts_with(asked))
      said.advice = fmt::format("did you mean '{}'?", one);
  const std::string near = nearest_name(asked, known);
  if (said.advice.empty() && !near.empty()) said.advice = fmt::format("did you mean '{}'?", near);
  if (!said.advice.empty()) return said;
  for (const CLI::App* other : verbs_of(program))
    if (has_option(*other, asked)) return {said.message, fmt::format("it belongs to treadmark {}", other->get_name())};
  return said;
}

Said extra_word(const CLI::App* verb, const std::string& word) {
  if (verb == nullptr) return {fmt::format("'{}' is not expected", word), ""};
  std::vector<std::string> places, named;
  for (const CLI::Option* place : verb->get_options())
    if (place->get_positional()) places.push_back(place->get_name(true));
  for (const OptionWords& words : option_words(*verb)) {
    for (const char* name : {"--wheel", "--rail"})
      if (ranges::count(words.names, name) > 0) named.emplace_back(name);
  }
  Said said{fmt::format("'{}' is one word too many: {} takes {}", word, verb->get_name(),
                        places.empty() ? "options only" : fmt::format("{}", fmt::join(places, " and "))),
            ""};
  if (named.size() == 2) said.advice = "name a wheel and a rail with --wheel and --rail";
  if (word.find('=') != std::string::npos && has_option(*verb, "--set"))
    said.advice = fmt::format("write --set {}", word);
  return said;
}

/// "--body: weel not in {wheel,rail}" and the like.
Said wrong_value(const CLI::App* verb, std::string message) {
  const std::size_t colon = message.find(": "), end = message.find(" not in {");
  if (verb != nullptr && end != std::string::npos && colon < end) {
    const std::string name = message.substr(0, colon), value = message.substr(colon + 2, end - colon - 2);
    for (const OptionWords& words : option_words(*verb)) {
      if (words.value != name && ranges::count(words.names, name) == 0) continue;
      const std::string near = nearest_name(value, words.choices);
      return {fmt::format("{} cannot be '{}': choose {}", name, value, fmt::join(words.choices, ", ")),
              near.empty() ? "" : fmt::format("did you mean '{}'?", near)};
    }
  }
  constexpr std::string_view kValue = ": Value ", kRange = " not in range ";
  const std::size_t given = message.find(kValue), range = message.find(kRange);
  if (given != std::string::npos && range != std::string::npos && given < range) {
    const std::string value = message.substr(given + kValue.size(), range - given - kValue.size());
    double low = 0.0, high = 0.0;
    std::istringstream limits(message.substr(range + kRange.size()));
    std::string to;
    limits >> low >> to >> high;
    constexpr double kNoLimit = 1e300;
    return {
        fmt::format("{} must be a number {}, not '{}'", message.substr(0, given),
                    high > kNoLimit ? fmt::format("from {:g} on", low) : fmt::format("from {:g} to {:g}", low, high),
                    value),
        io::number_fault(value).message.empty() ? "" : io::number_fault(value).advice};
  }
  const std::size_t equals = message.find(" = ");
  if (!message.starts_with("Could not convert") || equals == std::string::npos) return {std::move(message), ""};
  const std::size_t begin = message.find(": ") + 2;
  const std::string value = message.substr(equals + 3);
  return {fmt::format("{} takes a number, not '{}'", message.substr(begin, equals - begin), value),
          io::number_fault(value).advice};
}

}  // namespace

std::vector<std::string> with_help(std::vector<std::string> words) {
  const std::size_t at = place_of_verb(words);
  if (at == words.size()) return words;
  if (words[at] == "help") {
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(at));
    words.emplace_back("--help");
  } else if (words.size() == at + 2 && words[at + 1] == "help" && is_verb(words[at])) {
    words[at + 1] = "--help";
  }
  return words;
}

void check_words(const CLI::App& program, const std::vector<std::string>& words) {
  const std::size_t at = place_of_verb(words);
  if (at == words.size()) return;
  const std::string& word = words[at];
  if (!is_verb(word)) {
    std::vector<std::string> known;
    for (const Verb& verb : verbs()) known.emplace_back(verb.name);
    std::error_code ignored;
    const bool file = std::filesystem::path(word).has_extension() || std::filesystem::exists(word, ignored);
    throw Error(ErrorKind::configuration, "there is no verb '" + word + "'", {},
                file ? "the verb stands first: treadmark run " + word
                     : advice_on_name(word, known, "treadmark --help lists all"));
  }
  const CLI::App* verb = program.get_subcommand(word);
  for (std::size_t k = at + 1; k < words.size(); ++k)
    if (words[k].size() > 3 && words[k][1] != '-' && words[k][0] == '-' &&
        has_option(*verb, '-' + words[k].substr(0, words[k].find('='))))
      throw Error(ErrorKind::configuration, "there is no option '" + words[k] + "'", {},
                  "did you mean '-" + words[k] + "'?");
}

std::string usage_fault(const CLI::App& program, const CLI::ParseError& refused) {
  const std::vector<CLI::App*> parsed = program.get_subcommands();
  const CLI::App* verb = parsed.empty() ? nullptr : parsed.front();
  Said said{refused.what(), ""};
  if (dynamic_cast<const CLI::ExtrasError*>(&refused) != nullptr) {
    const std::vector<std::string> extra = program.remaining(true);
    if (!extra.empty())
      said = extra.front().starts_with("-") && extra.front().size() > 1 ? unknown_option(program, verb, extra.front())
                                                                        : extra_word(verb, extra.front());
  } else if (dynamic_cast<const CLI::RequiredError*>(&refused) != nullptr) {
    constexpr std::string_view kEnd = " is required";
    if (said.message.ends_with(kEnd)) {
      std::string name = said.message.substr(0, said.message.size() - kEnd.size());
      if (verb != nullptr)  // a place that has an option too is named as a place
        for (const CLI::Option* place : verb->get_options())
          if (place->get_positional() && place->get_name() == name) name = place->get_name(true);
      said.message = name + " is missing";
    }
  } else {
    said = wrong_value(verb, said.message);
  }
  return fmt::format("treadmark{}: {}{}\nusage: {}; treadmark {}--help shows all\n",
                     verb == nullptr ? "" : ' ' + verb->get_name(), said.message,
                     said.advice.empty() ? "" : " (" + said.advice + ')', call_of(program, verb),
                     verb == nullptr ? "" : verb->get_name() + ' ');
}

}  // namespace treadmark::cli
