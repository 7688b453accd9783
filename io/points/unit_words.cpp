// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/unit_words.hpp"

#include <string>
#include <vector>

#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io::points {

namespace {

struct Name {
  std::string_view text;
  LengthUnit unit;
};

constexpr Name kSymbols[] = {{"m", LengthUnit::metre},
                             {"mm", LengthUnit::millimetre},
                             {"um", LengthUnit::micrometre},
                             {"\xC2\xB5m", LengthUnit::micrometre},  // micro sign
                             {"\xCE\xBCm", LengthUnit::micrometre},  // Greek mu
                             {"\xB5m", LengthUnit::micrometre},      // in Latin 1
                             {"in", LengthUnit::inch}};

constexpr Name kUnitNames[] = {{"metre", LengthUnit::metre},
                               {"meter", LengthUnit::metre},
                               {"millimetre", LengthUnit::millimetre},
                               {"millimeter", LengthUnit::millimetre},
                               {"micrometre", LengthUnit::micrometre},
                               {"micrometer", LengthUnit::micrometre},
                               {"micron", LengthUnit::micrometre},
                               {"inch", LengthUnit::inch},
                               {"inche", LengthUnit::inch}};

std::optional<LengthUnit> unit_of_name(std::string_view lower_word) {
  if (lower_word.ends_with('s')) lower_word.remove_suffix(1);
  for (const Name& n : kUnitNames)
    if (n.text == lower_word) return n.unit;
  return std::nullopt;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && profiles::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && profiles::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The content of the first brackets, [..] or (..).
std::optional<std::string_view> in_brackets(std::string_view text) {
  const std::size_t open = text.find_first_of("[(");
  if (open == std::string_view::npos) return std::nullopt;
  const std::size_t close = text.find(text[open] == '[' ? ']' : ')', open);
  if (close == std::string_view::npos) return std::nullopt;
  return trimmed(text.substr(open + 1, close - open - 1));
}

}  // namespace

std::optional<LengthUnit> unit_of_word(std::string_view word) {
  const std::string text = profiles::lower(word);
  for (const Name& n : kSymbols)
    if (n.text == text) return n.unit;
  return unit_of_name(text);
}

std::optional<LengthUnit> unit_in_words(std::string_view text) {
  if (const std::optional<std::string_view> inside = in_brackets(text))
    if (const std::optional<LengthUnit> unit = unit_of_word(*inside)) return unit;

  constexpr std::string_view kEndsPhrase = ",;.:|=";
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(kEndsPhrase, start), text.size());
    if (const auto unit = unit_of_name(profiles::lower(trimmed(text.substr(start, end - start))))) return unit;
    start = end + 1;
  }

  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = at;
    while (at < text.size() && is_letter(text[at])) ++at;
    if (at > start) words.push_back(profiles::lower(text.substr(start, at - start)));
    ++at;
  }
  const auto unit_at = [&](std::size_t k) { return k < words.size() ? unit_of_word(words[k]) : std::nullopt; };
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (words[k] == "unit" || words[k] == "units") {
      constexpr std::size_t kNear = 4;
      for (std::size_t near = k + 1; near <= k + kNear; ++near) {
        if (near < words.size() && words[near] == "in" && unit_at(near + 1)) continue;  // the preposition
        if (const std::optional<LengthUnit> unit = unit_at(near)) return unit;
      }
    } else if (words[k] == "in" && k + 1 < words.size() && words[k + 1] != "in") {
      if (const std::optional<LengthUnit> unit = unit_at(k + 1)) return unit;
    }
  }
  return std::nullopt;
}

std::optional<LengthUnit> take_unit(std::string_view& name) {
  if (const std::optional<std::string_view> inside = in_brackets(name)) {
    name = trimmed(name.substr(0, name.find_first_of("[(")));
    if (name.ends_with('_')) name.remove_suffix(1);
    return unit_of_word(*inside);
  }
  const std::size_t last = name.find_last_of(" _/");
  if (last == std::string_view::npos || last == 0) return std::nullopt;
  const std::optional<LengthUnit> unit = unit_of_word(trimmed(name.substr(last + 1)));
  if (unit) name = trimmed(name.substr(0, last));
  return unit;
}

}  // namespace treadmark::io::points
