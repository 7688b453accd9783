// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/recording_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/points/fields.hpp"

namespace treadmark::io {

namespace {

enum class Word {
  distance,
  kilometres,
  miles,
  metres,
  level,
  cross_level,
  cant,
  alignment,
  gauge,
  left,
  right,
  filler
};

/// One meaning a row; small letters without accents, names separated by commas.
struct WordRow {
  Word word;
  std::string_view title;  ///< in the documentation
  std::string_view names;
};
constexpr WordRow kWordRows[] = {
    {Word::distance, "distance",
     "distance, dist, track distance, distance along track, chainage, station, stationing, stationierung, position, "
     "pos, location, pk, kp, punto kilometrico, point kilometrique, progressiva, abscisse, abscissa, "
     "staniceni, afstand, weg, s, x, расстояние, дистанция"},
    {Word::kilometres, "distance in km where no unit is given",
     "km, kilometre, kilometer, kilometres, kilometers, kilometrage, kilometrierung, kilometrering, mileage, "
     "streckenkilometer, bahnkilometer, kilometraz, километр, км, 里程"},
    {Word::miles, "distance in miles where no unit is given", "mile, miles, milepost, mp"},
    {Word::metres, "metres behind a column of whole kilometres", "m, metre, meter, metres, meters, mtr, метр"},
    {Word::level, "longitudinal level",
     "longitudinal level, level, ll, long level, long lev, lev, longitudinal height, vertical level, vertical profile, "
     "vertical "
     "alignment, vertical irregularity, vertical, vert, profile, prof, surface, unevenness, un, top, laengshoehe, "
     "laengshoehenlage, hoehenlage, nivellement longitudinal, nivellement, niveau longitudinal, nl, nivelacion "
     "longitudinal, nivelacion, livello longitudinale, hoogteligging, hoejdlaege, podelna vyska koleje, podelna vyska, "
     "vyska koleje, nierownosci pionowe, просадка, 高低"},
    {Word::cross_level, "cross level",
     "cross level, cross lvl, cl, xl, x level, x lvl, querhoehe, querhoehenlage, gegenseitige hoehenlage, nivellement "
     "transversal, ecart de devers, nivelacion transversal, livello trasversale, уровень, 水平"},
    {Word::cant, "cross level, where no other column holds it",
     "superelevation, super elevation, cant, se, ueberhoehung, devers, peralte, sopraelevazione, verkanting, "
     "raelsfoerhoejning, prevyseni koleje, prevyseni, przechylka, возвышение, 超高"},
    {Word::alignment, "alignment",
     "alignment, align, algn, aln, al, lateral alignment, horizontal alignment, horizontal align, horiz align, lat "
     "align, lateral irregularity, lateral, lining, "
     "ausrichtung, richtung, richtungslage, seitenlage, dressage, alineacion, allineamento, schift, sidolaege, smer "
     "koleje, smer, nierownosci poziome, рихтовка, 轨向"},
    {Word::gauge, "gauge",
     "gauge, gage, track gauge, tg, ga, g, spurweite, spur, ecartement, ancho de via, ancho, scartamento, spoorwijdte, "
     "sparvidd, rozchod koleje, rozchod, szerokosc toru, шаблон, ширина колеи, 轨距"},
    {Word::left, "left rail",
     "left, l, lh, lhs, lt, li, links, linke, linker, linkes, gauche, izquierdo, izquierda, izq, sinistra, sinistro, "
     "sx, levy, leva, levego, lewy, lewa, vaenster, левая, левый, левой, 左"},
    {Word::right, "right rail",
     "right, r, rh, rhs, rt, re, rechts, rechte, rechter, rechtes, droite, droit, derecho, derecha, der, destra, "
     "destro, dx, pravy, prava, praveho, prawy, prawa, hoeger, правая, правый, правой, 右"},
    {Word::filler, "without a meaning of their own",
     "rail, rails, track, of, the, in, and, along, mean, average, centre, center, both, value, measured, signal, "
     "filtered, raw, sc, space curve, deviation, dev, irregularity, rel, abs, absolute, nominal, from, schiene, gleis, "
     "via, voie, tor, koleje, binario"}};

struct Known {
  Word word;
  std::string key;  ///< the name without blanks
};
const std::vector<Known>& known_words() {
  static const std::vector<Known> all = [] {
    std::vector<Known> list;
    for (const WordRow& row : kWordRows)
      for (std::size_t at = 0; at < row.names.size();) {
        const std::size_t end = std::min(row.names.find(", ", at), row.names.size());
        std::string key(row.names.substr(at, end - at));
        std::erase(key, ' ');
        list.push_back({row.word, std::move(key)});
        at = end + 2;
      }
    return list;
  }();
  return all;
}

std::optional<Word> word_of(std::string_view key) {
  for (const Known& known : known_words())
    if (known.key == key) return known.word;
  return std::nullopt;
}

bool is_side(Word w) { return w == Word::left || w == Word::right; }

/// Two words written as one: "laengshoehelinks", "topl", "左高低".
std::optional<std::pair<Word, Word>> two_words_of(std::string_view key) {
  constexpr std::size_t kLeast = 3;
  for (std::size_t cut = 1; cut < key.size(); ++cut) {
    const std::optional<Word> a = word_of(key.substr(0, cut)), b = word_of(key.substr(cut));
    if (!a || !b || is_side(*a) == is_side(*b)) continue;
    const std::size_t side = is_side(*a) ? cut : key.size() - cut, other = key.size() - side;
    if ((side == 1 && other >= 2) || (side >= kLeast && other >= kLeast)) return std::pair{*a, *b};
  }
  return std::nullopt;
}

/// Letters with accents, from U+00E0 and U+0100 (small ones), as letters without.
std::string_view plain_letter(std::uint32_t c) {
  struct Row {
    std::uint32_t code;
    std::string_view text;
  };
  static constexpr Row kRows[] = {
      {0xDF, "ss"}, {0xE0, "a"},  {0xE1, "a"},  {0xE2, "a"},  {0xE3, "a"},  {0xE4, "ae"}, {0xE5, "a"},  {0xE6, "ae"},
      {0xE7, "c"},  {0xE8, "e"},  {0xE9, "e"},  {0xEA, "e"},  {0xEB, "e"},  {0xEC, "i"},  {0xED, "i"},  {0xEE, "i"},
      {0xEF, "i"},  {0xF1, "n"},  {0xF2, "o"},  {0xF3, "o"},  {0xF4, "o"},  {0xF5, "o"},  {0xF6, "oe"}, {0xF8, "oe"},
      {0xF9, "u"},  {0xFA, "u"},  {0xFB, "u"},  {0xFC, "ue"}, {0xFD, "y"},  {0x103, "a"}, {0x105, "a"}, {0x107, "c"},
      {0x10D, "c"}, {0x10F, "d"}, {0x119, "e"}, {0x11B, "e"}, {0x13A, "l"}, {0x13E, "l"}, {0x142, "l"}, {0x144, "n"},
      {0x148, "n"}, {0x151, "o"}, {0x155, "r"}, {0x159, "r"}, {0x15B, "s"}, {0x161, "s"}, {0x165, "t"}, {0x16F, "u"},
      {0x171, "u"}, {0x17A, "z"}, {0x17C, "z"}, {0x17E, "z"}};
  const auto* const row = ranges::lower_bound(kRows, c, {}, &Row::code);
  return row != std::end(kRows) && row->code == c ? row->text : std::string_view();
}

struct Letter {
  enum class Kind { upper, lower, digit, other } kind = Kind::other;
  std::string text;  ///< small, without accents
};

/// The first character of a text that is not empty; its bytes go from the text.
Letter take_letter(std::string_view& text) {
  const std::size_t length = std::max<std::size_t>(1, utf8_length(text));
  const std::string_view bytes = text.substr(0, length);
  text.remove_prefix(length);
  const char first = bytes.front();
  if (length == 1) {
    if (first >= 'A' && first <= 'Z') return {Letter::Kind::upper, profiles::lower(bytes)};
    if (first >= 'a' && first <= 'z') return {Letter::Kind::lower, std::string(bytes)};
    if (first >= '0' && first <= '9') return {Letter::Kind::digit, std::string(bytes)};
    return {};
  }
  if (length != 2)  // signs and dashes begin with E2, other scripts do not
    return {length == 3 && first != '\xE2' ? Letter::Kind::lower : Letter::Kind::other, std::string(bytes)};
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])); };
  std::uint32_t code = (byte(0) & 0x1Fu) << 6 | (byte(1) & 0x3Fu);
  constexpr std::uint32_t kMicro1 = 0xB5, kMicro2 = 0x3BC;
  if (code == kMicro1 || code == kMicro2) return {Letter::Kind::lower, "u"};
  bool upper = true;
  const bool latin = code >= 0xC0 && code <= 0xDE && code != 0xD7, cyrillic = code >= 0x410 && code <= 0x42F;
  if (latin || cyrillic)
    code += 0x20;
  else if ((code >= 0x139 && code <= 0x148) || (code >= 0x179 && code <= 0x17E))
    upper = code % 2 == 1, code += upper ? 1 : 0;
  else if (code >= 0x100 && code <= 0x177)
    upper = code % 2 == 0, code += upper ? 1 : 0;
  else
    upper = false;
  const Letter::Kind kind = upper ? Letter::Kind::upper : Letter::Kind::lower;
  if (const std::string_view plain = plain_letter(code); !plain.empty()) return {kind, std::string(plain)};
  if (code >= 0x430 && code <= 0x45F)
    return {kind, {static_cast<char>(0xC0u | code >> 6), static_cast<char>(0x80u | (code & 0x3Fu))}};
  return {};
}

/// Pieces of a name: at signs, before capitals ("CrossLevel", "LLLeft") and between letters and digits.
std::vector<std::string> pieces_of(std::string_view name) {
  std::vector<std::string> pieces;
  std::string piece, last;  // last: the latest letter, which begins a word where a small one follows capitals
  Letter::Kind before = Letter::Kind::other;
  int capitals = 0;
  const auto close = [&] {
    if (!piece.empty()) pieces.push_back(std::move(piece));
    piece.clear();
  };
  while (!name.empty()) {
    const Letter letter = take_letter(name);
    using Kind = Letter::Kind;
    if (letter.kind == Kind::other || (letter.kind == Kind::digit) != (before == Kind::digit) ||
        (letter.kind == Kind::upper && before == Kind::lower)) {
      close();
    } else if (letter.kind == Kind::lower && before == Kind::upper && capitals > 1) {
      piece.resize(piece.size() - last.size());
      close();
      piece = last;
    }
    capitals = letter.kind == Kind::upper ? capitals + 1 : 0;
    if (letter.kind != Kind::other) piece += letter.text;
    last = letter.text;
    before = letter.kind;
  }
  close();
  return pieces;
}

double small_unit(std::string_view text) {
  struct Row {
    std::string_view name;
    double si;
  };
  static constexpr Row kRows[] = {{"um", 1e-6},         {"\xC2\xB5m", 1e-6},   {"\xCE\xBCm", 1e-6},
                                  {"mm", kMillimetre},  {"cm", 1e-2},          {"dm", 1e-1},
                                  {"m", 1.0},           {"km", 1e3},           {"in", 25.4e-3},
                                  {"inch", 25.4e-3},    {"inches", 25.4e-3},   {"ft", 0.3048},
                                  {"feet", 0.3048},     {"mi", 1609.344},      {"mile", 1609.344},
                                  {"miles", 1609.344},  {"metre", 1.0},        {"meter", 1.0},
                                  {"metres", 1.0},      {"meters", 1.0},       {"millimetre", kMillimetre},
                                  {"millimeter", 1e-3}, {"millimetres", 1e-3}, {"millimeters", 1e-3},
                                  {"micrometre", 1e-6}, {"micrometer", 1e-6},  {"kilometre", 1e3},
                                  {"kilometer", 1e3},   {"kilometres", 1e3},   {"kilometers", 1e3}};
  const std::string lower = profiles::lower(text);
  for (const Row& row : kRows)
    if (row.name == lower) return row.si;
  return 0.0;
}

struct Fraction {
  std::string_view text;
  double value;
};
constexpr Fraction kFractions[] = {{"1/1000", 1e-3}, {"1/100", 1e-2}, {"1/10", 1e-1}, {"0.001", 1e-3}, {"0,001", 1e-3},
                                   {"0.01", 1e-2},   {"0,01", 1e-2},  {"0.1", 1e-1},  {"0,1", 1e-1}};

std::string_view without_blanks_around(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t\"'");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\"'") - from + 1);
}

/// Takes brackets, units and fractions out of a name.
struct NameParts {
  std::string rest;
  double unit = 0.0;
};
NameParts parts_of(std::string_view name) {
  NameParts parts;
  name = without_blanks_around(name);
  for (std::size_t at = 0; at < name.size(); ++at) {
    const std::size_t kind = std::string_view("[({").find(name[at]);
    const std::size_t close = kind == std::string_view::npos ? kind : name.find("])}"[kind], at);
    if (close == std::string_view::npos) {
      parts.rest += name[at];
      continue;
    }
    const std::string_view inside = name.substr(at + 1, close - at - 1);
    if (const double unit = recorded_unit(inside); unit != 0.0)
      parts.unit = unit;
    else
      parts.rest.append(" ").append(inside);
    parts.rest += ' ';
    at = close;
  }
  for (const Fraction& fraction : kFractions) {
    const std::size_t at = parts.rest.find(fraction.text);
    if (at == std::string::npos) continue;
    const double unit = recorded_unit(std::string_view(parts.rest).substr(at));
    if (unit == 0.0) continue;
    parts.unit = unit;
    parts.rest.resize(at);
    break;
  }
  return parts;
}

bool is_number(std::string_view piece) { return !piece.empty() && piece.front() >= '0' && piece.front() <= '9'; }

int number_of_piece(std::string_view piece) {
  constexpr std::size_t kDigits = 6;
  int value = 0;
  for (const char digit : piece.substr(0, kDigits)) value = 10 * value + (digit - '0');
  return value;
}

Recorded recorded(Word word) {
  switch (word) {
    case Word::level:
      return Recorded::level;
    case Word::cross_level:
      return Recorded::cross_level;
    case Word::cant:
      return Recorded::cant;
    case Word::alignment:
      return Recorded::alignment;
    case Word::gauge:
      return Recorded::gauge;
    case Word::metres:
      return Recorded::metres;
    default:
      return Recorded::distance;
  }
}

/// Collects the words of a name. False where they say two things, or nothing.
class Meaning {
 public:
  bool add(Word word) {
    if (word == Word::filler) return true;
    if (is_side(word)) {
      const int rail = word == Word::left ? -1 : 1;
      if (column_.rail == -rail) return false;
      column_.rail = rail;
      return true;
    }
    const Recorded what = recorded(word);
    const bool nearer = what_ && *what_ == Recorded::distance && what == Recorded::distance;  // "distance km"
    if (what_ && !nearer) return false;
    what_ = what;
    if (word == Word::kilometres) implied_ = 1e3;
    if (word == Word::miles) implied_ = 1609.344;
    if (word == Word::metres) implied_ = 1.0;
    return true;
  }
  void add_number(int number) { numbers_.push_back(number); }
  bool add_band(int band) {
    if (column_.band != 0 || band > 3) return false;
    column_.band = band == 0 ? 9 : band;
    return true;
  }
  std::optional<RecordedColumn> column(double unit) {
    if (!what_) return std::nullopt;
    const bool of_rails = *what_ == Recorded::level || *what_ == Recorded::alignment;
    if (column_.rail != 0 && !of_rails) return std::nullopt;
    if (!numbers_.empty() && !understand_numbers(of_rails)) return std::nullopt;
    column_.what = *what_;
    column_.unit = unit != 0.0 ? unit : implied_;
    return column_;
  }

 private:
  /// A nominal gauge, the longest wavelength, or a band of wavelengths.
  bool understand_numbers(bool of_rails) {
    constexpr int kLeastGauge = 500, kMostGauge = 1800, kMostLength = 200;
    const int first = numbers_.front();
    if (numbers_.size() == 1 && what_ == Recorded::gauge && first >= kLeastGauge && first <= kMostGauge) {
      column_.nominal = first;
      return true;
    }
    if (!of_rails || numbers_.size() > 2 || column_.band != 0) return false;
    if (numbers_.size() == 1) {
      const bool chord_in_feet = first == 31 || first == 62 || first == 124;
      column_.longest = first;
      return first >= 25 && first <= kMostLength && !chord_in_feet;
    }
    constexpr int kEnds[] = {3, 25, 70, kMostLength};  // D1 to D3 of EN 13848-1 [m]
    for (int band = 1; band <= 3; ++band)
      if (first == kEnds[band - 1] && (numbers_[1] == kEnds[band] || (band == 3 && numbers_[1] == 150)))
        column_.band = band;
    return column_.band != 0;
  }

  std::optional<Recorded> what_;
  RecordedColumn column_;
  std::vector<int> numbers_;
  double implied_ = 0.0;
};

/// How many pieces from here on are one word, as many as possible.
std::size_t longest_word(const std::vector<std::string>& pieces, std::size_t at, std::optional<Word>& word) {
  constexpr std::size_t kMost = 4;
  for (std::size_t count = std::min(kMost, pieces.size() - at); count > 0; --count) {
    std::string key;
    for (std::size_t k = 0; k < count; ++k) key += pieces[at + k];
    if (count > 1 && key.size() < 3) continue;  // two single letters
    if ((word = word_of(key))) return count;
  }
  return 0;
}

}  // namespace

double recorded_unit(std::string_view text) {
  text = without_blanks_around(text);
  while (text.size() >= 2 && std::string_view("[({").find(text.front()) != std::string_view::npos)
    text = without_blanks_around(text.substr(1, text.size() - 2));
  for (const Fraction& fraction : kFractions)
    if (text.starts_with(fraction.text)) {
      text.remove_prefix(fraction.text.size());
      while (!text.empty() && std::string_view(" \t*_").find(text.front()) != std::string_view::npos)
        text.remove_prefix(1);
      return fraction.value * small_unit(text);
    }
  return small_unit(text);
}

std::optional<RecordedColumn> recorded_column(std::string_view name) {
  constexpr std::size_t kLongestName = 200;
  if (name.size() > kLongestName) return std::nullopt;
  NameParts parts = parts_of(name);
  std::vector<std::string> pieces = pieces_of(parts.rest);
  const bool after_number = pieces.size() > 1 && pieces.back() == "m" && is_number(pieces[pieces.size() - 2]);
  if (pieces.size() > 1 && parts.unit == 0.0 && !after_number)
    if (const double unit = small_unit(pieces.back()); unit != 0.0) {
      parts.unit = unit;
      pieces.pop_back();
    }
  Meaning meaning;
  for (std::size_t at = 0; at < pieces.size();) {
    const std::string& piece = pieces[at];
    if (is_number(piece)) {
      meaning.add_number(number_of_piece(piece));
      at += at + 1 < pieces.size() && (pieces[at + 1] == "m" || pieces[at + 1] == "mm") ? 2 : 1;
      continue;
    }
    if (piece == "d" && at + 1 < pieces.size() && pieces[at + 1].size() == 1 && is_number(pieces[at + 1])) {
      if (!meaning.add_band(number_of_piece(pieces[at + 1]))) return std::nullopt;
      at += 2;
      continue;
    }
    std::optional<Word> word;
    if (const std::size_t count = longest_word(pieces, at, word); count > 0) {
      if (!meaning.add(*word)) return std::nullopt;
      at += count;
      continue;
    }
    const auto two = two_words_of(piece);
    if (!two || !meaning.add(two->first) || !meaning.add(two->second)) return std::nullopt;
    ++at;
  }
  std::optional<RecordedColumn> column = meaning.column(parts.unit);
  const bool letters = ranges::all_of(pieces, [](const std::string& piece) { return piece.size() == 1; });
  if (column && column->what == Recorded::distance && column->unit == 0.0 && letters) return std::nullopt;  // "s [s]"
  return column;
}

bool names_something_recorded(std::string_view name) {
  const std::vector<std::string> pieces = pieces_of(parts_of(name).rest);
  for (std::size_t at = 0; at < pieces.size(); ++at) {
    std::optional<Word> word;
    if (longest_word(pieces, at, word) > 0 && *word != Word::filler && !is_side(*word)) return true;
  }
  return false;
}

double stated_gauge(std::string_view line) {
  const std::vector<std::string> pieces = pieces_of(line);
  bool gauge = false;
  for (std::size_t at = 0; at < pieces.size() && !gauge; ++at) {
    std::optional<Word> word;
    const std::size_t count = longest_word(pieces, at, word);
    gauge = word == Word::gauge && pieces[at].size() > 2 && count > 0;
  }
  if (!gauge) return 0.0;
  for (std::size_t at = line.find_first_of("0123456789"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_not_of("0123456789.,", at), line.size());
    std::string_view text = line.substr(at, end - at);
    while (text.ends_with('.') || text.ends_with(',')) text.remove_suffix(1);
    double value = 0.0;
    constexpr double kLeast = 0.5, kMost = 1.8;
    if (points::parse_number(text, true, value))
      for (const double unit : {1.0, kMillimetre})
        if (value * unit >= kLeast && value * unit <= kMost) return value * unit;
    at = line.find_first_of("0123456789", end);
  }
  return 0.0;
}

std::string recording_names_table() {
  std::string text = "| words | meaning |\n|---|---|\n";
  for (const WordRow& row : kWordRows) text += fmt::format("| {} | {} |\n", row.names, row.title);
  return text;
}

}  // namespace treadmark::io
