// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/setting_options.hpp"

#include <cctype>
#include <cstdint>
#include <string>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::cli {
namespace {

/// "--gauge-mm MM" for gauge_mm; without a unit and where it is no list the name alone.
std::string words_of(const io::KeyInfo& key) {
  if (!key.option.empty()) return key.option;
  std::string words = "--" + key.path;
  ranges::replace(words, '_', '-');
  std::string value(key.type == io::KeyType::value_list ? "_list" : io::unit_at_end(key.path).ending);
  if (value.empty()) return words;
  value.front() = ' ';
  ranges::transform(value, value.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return words + value;
}

/// The default as people write it; empty where there is none, and where it stands for none.
std::string shown_default(const io::KeyInfo& key) {
  std::string text = key.default_text;
  std::erase(text, '"');
  return key.above == 0.0 && text == "0" ? std::string() : text;
}

void add_setting(CLI::App& verb, const io::KeyInfo& key, std::vector<io::CaseOverride>& given) {
  const std::string words = words_of(key), name = words.substr(0, words.find(' '));
  const auto take = [&given, &key](const auto& value) { given.push_back({key.path, {{}, value}, {}}); };
  CLI::Option* option = nullptr;
  if (key.type == io::KeyType::flag) {
    verb.add_flag_callback(
        name, [take] { take(true); }, key.doc);
    return;
  }
  if (key.type == io::KeyType::number)
    option = verb.add_option_function<double>(name, take, key.doc);
  else if (key.type == io::KeyType::integer)
    option = verb.add_option_function<std::int64_t>(name, take, key.doc);
  else
    option = verb.add_option_function<std::string>(name, take, key.doc);
  if (key.above == 0.0) option->check(CLI::PositiveNumber);
  if (key.at_least && key.type == io::KeyType::integer)
    option->check(CLI::Range(to_whole<int>(*key.at_least), to_whole<int>(*key.at_most)));
  else if (key.at_least)
    option->check(CLI::Range(*key.at_least, *key.at_most));
  if (!key.choices.empty()) option->check(CLI::IsMember(key.choices));
  if (name.size() < words.size()) option->type_name(words.substr(name.size() + 1));
  if (const std::string text = shown_default(key); !text.empty()) option->default_str(text);
}

}  // namespace

void add_settings(CLI::App& verb, const io::TableKeys& keys, std::vector<io::CaseOverride>& given) {
  for (const io::KeyInfo& key : keys) add_setting(verb, key, given);
}

}  // namespace treadmark::cli
