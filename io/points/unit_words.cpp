// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/unit_words.hpp"

#include <algorithm>
#include <span>
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

/// Units of length that are named but not converted, with their millimetres; 0: nobody knows.
struct ForeignUnit {
  std::string_view text;
  double millimetres;
};
constexpr ForeignUnit kForeignUnits[] = {
    {"nm", 1e-6},    {"cm", 10.0},     {"centimetre", 10.0}, {"centimeter", 10.0}, {"dm", 100.0},   {"km", 1e6},
    {"mil", 0.0254}, {"thou", 0.0254}, {"zoll", 25.4},       {"ft", 304.8},        {"foot", 304.8}, {"feet", 304.8},
    {"yd", 914.4},   {"yard", 914.4},  {"px", 0.0},          {"pixel", 0.0},       {"count", 0.0},  {"digit", 0.0}};

/// What may be "in" a unit of length; without one of these words the unit is that of something else.
constexpr std::string_view kLengths[] = {
    "unit",       "units",    "coordinate", "coordinates", "koordinaten", "length",    "lengths",    "dimension",
    "dimensions", "distance", "value",      "values",      "werte",       "angaben",   "number",     "numbers",
    "point",      "points",   "position",   "height",      "heights",     "deviation", "deviations", "profile",
    "section",    "data",     "scan",       "positions",   "distances",   "measured",  "cloud",      "mesh",
    "file",       "all",      "alle",       "x",           "y",           "z",         "exported",   "export",
    "saved",      "written",  "stored",     "given",       "everything"};
/// What has units of its own.
constexpr std::string_view kOthers[] = {"speed", "velocity", "time", "mass", "force", "load", "angle", "temperature"};

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

struct TextWord {
  std::string text;    ///< small letters
  std::string number;  ///< before it: "0.01" of "0.01 mm"
  bool whole = true;   ///< false: of "m/s", "mm2"
  bool begins = true;  ///< the first of its phrase
  bool ends = true;    ///< the last one
};

std::vector<TextWord> words_of(std::string_view text) {
  constexpr std::string_view kEndsPhrase = ",;.|", kJoins = "/^*", kDigits = "0123456789", kFollows = "/^*0123456789",
                             kNumber = "0123456789./", kBlanks = " \t\v\f";
  const auto is_one_of = [&](std::string_view signs, std::size_t at) {
    return at < text.size() && signs.find(text[at]) != std::string_view::npos;
  };
  std::vector<TextWord> words;
  bool begins = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = at;
    while (at < text.size() && is_letter(text[at])) ++at;
    if (at > start) {
      const bool whole = !is_one_of(kFollows, at) && !(start > 0 && is_one_of(kJoins, start - 1));
      const std::size_t next = text.find_first_not_of(kBlanks, at);
      std::string_view number = trimmed(text.substr(0, start));
      number.remove_prefix(number.find_last_not_of(kNumber) + 1);
      if (number.find_first_of(kDigits) == std::string_view::npos) number = {};
      words.push_back({profiles::lower(text.substr(start, at - start)), std::string(number), whole, begins,
                       next == std::string_view::npos || is_one_of(kEndsPhrase, next)});
      begins = false;
    } else {
      begins = begins || is_one_of(kEndsPhrase, at);
      ++at;
    }
  }
  return words;
}

bool is_among(std::span<const std::string_view> list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Whether the preposition stands behind something that has lengths, or begins its phrase.
bool is_of_lengths(const std::vector<TextWord>& words, std::size_t in) {
  for (std::size_t k = in; !words[k].begins; --k)
    if (is_among(kLengths, words[k - 1].text)) return true;
  return words[in].begins;
}

bool is_unit_word(const TextWord& word) { return word.text == "unit" || word.text == "units"; }

/// The content of the first brackets, [..] or (..).
std::optional<std::string_view> in_brackets(std::string_view text) {
  const std::size_t open = text.find_first_of("[(");
  if (open == std::string_view::npos) return std::nullopt;
  const std::size_t close = text.find(text[open] == '[' ? ']' : ')', open);
  if (close == std::string_view::npos) return std::nullopt;
  return trimmed(text.substr(open + 1, close - open - 1));
}

/// "1", "1.0"
bool is_one(std::string_view number) {
  if (number.find('.') != std::string_view::npos)
    while (number.ends_with('0')) number.remove_suffix(1);
  return number == "1" || number == "1.";
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

  const std::vector<TextWord> words = words_of(text);
  const auto unit_at = [&](std::size_t k) {
    return k < words.size() && words[k].whole && words[k].number.empty() ? unit_of_word(words[k].text) : std::nullopt;
  };
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (is_unit_word(words[k])) {
      constexpr std::size_t kNear = 4;
      if (k > 0 && is_among(kOthers, words[k - 1].text)) continue;
      if (k + 1 < words.size() && words[k + 1].whole && is_one(words[k + 1].number))
        if (const std::optional<LengthUnit> unit = unit_of_word(words[k + 1].text)) return unit;
      for (std::size_t near = k + 1; near <= k + kNear; ++near) {
        if (near < words.size() && is_among(kOthers, words[near].text)) break;
        if (near < words.size() && words[near].text == "in" && unit_at(near + 1)) continue;  // the preposition
        if (const std::optional<LengthUnit> unit = unit_at(near)) return unit;
      }
    } else if (words[k].text == "in" && k + 1 < words.size() && words[k + 1].text != "in" && is_of_lengths(words, k)) {
      if (const std::optional<LengthUnit> unit = unit_at(k + 1)) return unit;
    }
  }
  return std::nullopt;
}

std::optional<UnknownUnit> unknown_unit_of_word(std::string_view word) {
  if (word.empty() || unit_of_word(word)) return std::nullopt;
  const std::string text = profiles::lower(word);
  std::string_view plain = text;
  for (const ForeignUnit& foreign : kForeignUnits)
    if (foreign.text == plain || (plain.ends_with('s') && foreign.text == plain.substr(0, plain.size() - 1)))
      return UnknownUnit{std::string(word), true, foreign.millimetres};
  // "0.01 mm", "1/100mm"
  const std::size_t letters = plain.find_last_of("0123456789. /*") + 1;
  const bool part = letters > 0 && letters < plain.size() && plain.find_first_of("0123456789") < letters &&
                    unit_of_word(plain.substr(letters)).has_value();
  return UnknownUnit{std::string(word), part, 0.0};
}

std::optional<UnknownUnit> unknown_unit_in_words(std::string_view text) {
  if (unit_in_words(text)) return std::nullopt;
  constexpr std::string_view kBetween[] = {"is", "are", "in", "length", "lengths", "coordinates", "the", "all"};
  const std::vector<TextWord> words = words_of(text);
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (!is_unit_word(words[k])) continue;
    if (k > 0 && is_among(kOthers, words[k - 1].text)) continue;
    std::size_t next = k + 1;
    while (next < words.size() && is_among(kBetween, words[next].text)) ++next;
    // prose goes on: "unit tests", "a unit of measuring"
    if (next == words.size() || !words[next].whole || !words[next].ends) continue;
    const std::string& number = words[next].number;
    return unknown_unit_of_word(number.empty() ? words[next].text : number + " " + words[next].text);
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

std::optional<UnknownUnit> unknown_unit_of_name(std::string_view name) {
  std::optional<std::string_view> word = in_brackets(name);
  if (const std::size_t last = name.find_last_of(" _/"); !word && last != std::string_view::npos)
    word = trimmed(name.substr(last + 1));
  std::optional<UnknownUnit> unknown = word ? unknown_unit_of_word(*word) : std::nullopt;
  return unknown && unknown->of_length ? unknown : std::nullopt;
}

}  // namespace treadmark::io::points
