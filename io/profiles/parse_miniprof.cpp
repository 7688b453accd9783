// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "treadmark/io/points/text_lines.hpp"
#include "treadmark/io/profiles/column_table.hpp"
#include "treadmark/io/profiles/parse_points.hpp"

namespace treadmark::io::profiles {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Keys that say something about the profile which its points do not show: what to set for them.
struct TellingKey {
  std::string_view key;  ///< in small letters
  std::string_view advice;
};

constexpr TellingKey kTellingKeys[] = {
    {"gauge", "set track.gauge_mm"},
    {"side", "profiles are given for the right side: mirror one of the left"},
    {"rail", ""},
    {"railgaugepoint", ""},
    {"railaligntype", ""},
    {"railangle", "roll the rail by it, if it is not in the points"},
    {"superelevation", ""},
    {"tilt", "roll the rail by it, if it is not in the points"},
    {"basetilt", ""},
    {"baseoffset", ""},
    {"flat", ""},
    {"diameterflange", ""},
    {"transformstate", ""},
    {"transformation", ""},
    {"sd", ""},
    {"sh", ""},
    {"qr", ""},
    {"aligndx", ""},
    {"aligndy", ""},
    {"alignda", ""},
};

bool is_nothing(std::string_view value) {
  double number = 1.0;
  return value.empty() || (points::parse_number(value, true, number) && number == 0.0);
}

/// One profile of a file and what its header says.
struct MiniprofSection {
  explicit MiniprofSection(const std::string& file) : table(file) {}
  int number = 0;
  bool drawn = false;  ///< by a drawing program, not measured
  std::string program;
  ColumnTable table;
  std::optional<ColumnRoles> roles;
  double offset_y = 0.0, offset_z = 0.0;
  std::optional<double> promised_points;
  ProfileSource source;
};

class MiniprofParser {
 public:
  MiniprofParser(std::string_view text, const std::string& file, Body body)
      : scanner_(text, file), file_(file), body_(body), section_(file) {}

  std::vector<MiniprofSection> parse() {
    while (scanner_.next_line()) {
      const std::string_view bare = trimmed(scanner_.line());
      if (state_ == State::start && !bare.empty()) begin(bare);
      if (bare.empty()) {
        if (state_ == State::text || (state_ == State::keys && header_seen_ && !in_sections_)) state_ = State::points;
        continue;
      }
      if (in_sections_ && bare.front() == '[') {
        open_section(bare);
        continue;
      }
      if (state_ == State::text)
        text_line(bare);
      else
        line();
    }
    if (state_ == State::text)
      scanner_.fail("the header does not end: an empty line must follow it", 0, "is the file truncated?");
    close_section();
    return std::move(sections_);
  }

 private:
  enum class State { start, text, keys, points };

  /// The first line tells the style of the header.
  void begin(std::string_view bare) {
    const std::string first = lower(bare);
    const bool names_body = first.starts_with("#mini");
    if (names_body || first.starts_with("miniprof")) {
      state_ = State::text;
      const bool wheel = first.find("wheel") != std::string::npos, rail = first.find("rail") != std::string::npos;
      if (names_body && wheel != rail && wheel != (body_ == Body::wheel))
        scanner_.fail(fmt::format("this is a {} profile, a {} profile is expected", wheel ? "wheel" : "rail",
                                  wheel ? "rail" : "wheel"),
                      1, "exchange the files");
      section_.source.kind = "MiniProf, header of text";
      return;
    }
    state_ = State::keys;
    in_sections_ = bare.front() == '[';
    section_.source.kind = in_sections_ ? "MiniProf, sections" : "MiniProf, lines Key=value";
  }

  void text_line(std::string_view bare) {
    if (lower(bare).starts_with("miniprof")) section_.source.kind = "MiniProf, header of text: " + std::string(bare);
    // the instrument's own measures of a flange
    const std::size_t measures = bare.find("(Sd/Sh/qR)");
    if (measures != std::string_view::npos) {
      std::string_view numbers = trimmed(bare.substr(0, measures));
      if (numbers.empty()) numbers = last_text_;
      if (!numbers.empty()) section_.source.said.emplace_back("Sd Sh qR", std::string(numbers));
    }
    last_text_ = bare;
  }

  void line() {
    const std::string plain = plain_line(scanner_.line());
    const points::LineKind kind = points::kind_of_line(plain);
    if (kind == points::LineKind::empty || kind == points::LineKind::comment) return;
    if (kind == points::LineKind::numbers) {
      if (in_sections_ && state_ != State::points)
        scanner_.fail("numbers before a section [Profile1Points]", 1, "is it a file of MiniProf?");
      state_ = State::points;
      section_.table.add(scanner_.number(), plain);
      return;
    }
    const std::size_t start = plain.find_first_not_of(" \t\v\f");
    const auto column = static_cast<int>(start + 1);
    const std::size_t sign = scanner_.line().find('=');
    const Word word{std::string_view(plain).substr(start, plain.find_first_of(" \t\v\f", start) - start), column};
    if (state_ == State::points) to_number(scanner_, word);  // says what is wrong with the word
    if (sign == std::string_view::npos)
      scanner_.fail("'Key=value' or numbers are expected, this is " + printable(word.text), column);
    header_seen_ = true;
    std::string key = lower(scanner_.line().substr(start, sign - start));
    std::erase_if(key, is_blank);
    take(key, std::string(trimmed(scanner_.line().substr(start, sign - start))), sign);
  }

  void take(const std::string& key, const std::string& name, std::size_t sign) {
    // a comment may stand behind the value, and within a remark everything may
    const std::string_view value = trimmed(points::without_comment(scanner_.line().substr(sign + 1)));
    const auto column = static_cast<int>(sign + 2);
    if (key == "columndef") {
      section_.roles = column_definition(value, column);
    } else if (key == "xoffset" || key == "yoffset") {
      if (!value.empty()) (key == "xoffset" ? section_.offset_y : section_.offset_z) = number(value);
    } else if (key == "xypoints") {
      section_.promised_points = value.empty() ? 0.0 : number(value);
    } else if (key == "diametertaperline" || key == "wheeldiametertaperline") {
      constexpr double kMetres = 1e-3;
      if (is_nothing(value)) return;
      const double diameter = number(value);
      if (!(diameter > 0.0)) scanner_.fail("a diameter must be positive", column);
      section_.source.nominal_radius = 0.5 * kMetres * diameter;
    } else if (key == "programname") {
      section_.program = value;
      section_.drawn = lower(value).find("autocad") != std::string::npos;
    } else {
      for (const TellingKey& known : kTellingKeys)
        if (known.key == key && !is_nothing(value)) {
          section_.source.said.emplace_back(name, std::string(value));
          section_.source.notes.push_back(
              fmt::format("{}={} is not used{}{}", name, value, known.advice.empty() ? "" : ": ", known.advice));
        }
    }
  }

  double number(std::string_view value) {
    const auto column = static_cast<int>(value.data() - scanner_.line().data() + 1);
    return to_number(scanner_, {value.substr(0, value.find_first_of(" \t\v\f")), column});
  }

  /// "X,Y,A,C,N,K": X lateral, Y vertical, angle, curvature, and what the instrument adds.
  ColumnRoles column_definition(std::string_view list, int where) {
    ColumnRoles roles;
    roles.y = roles.z = -1;
    roles.named = true;
    for (int column = 0;; ++column) {
      const std::size_t comma = list.find(',');
      const std::string name = lower(trimmed(list.substr(0, comma)));
      int* const target = name == "x" ? &roles.y : name == "y" ? &roles.z : nullptr;
      if (target == nullptr) {
        if (name != "*")
          roles.in_words += (roles.in_words.empty() ? "" : ", ") + std::string(trimmed(list.substr(0, comma)));
      } else {
        if (*target >= 0) scanner_.fail("ColumnDef names " + name + " twice", where);
        *target = column;
      }
      if (comma == std::string_view::npos) break;
      list.remove_prefix(comma + 1);
    }
    if (roles.y < 0 || roles.z < 0)
      scanner_.fail("ColumnDef must name the columns X and Y", where, "for example ColumnDef=X,Y,A,C,N");
    return roles;
  }

  void open_section(std::string_view bare) {
    const std::string name = lower(bare);
    if (name.starts_with("[profile") && name.ends_with("points]")) {
      state_ = State::points;
      return;
    }
    state_ = State::keys;
    header_seen_ = false;
    if (!name.starts_with("[profile")) return;
    close_section();
  }

  void close_section() {
    const ProfileSource source = section_.source;
    if (!section_.table.empty() || !in_sections_) {
      section_.number = static_cast<int>(sections_.size() + 1);
      const auto found = static_cast<double>(section_.table.size());
      if (section_.promised_points && *section_.promised_points > 0.0 && *section_.promised_points != found)
        section_.source.notes.push_back(
            fmt::format("XYPoints says {:g} points, there are {:g}", *section_.promised_points, found));
      sections_.push_back(std::move(section_));
    }
    section_ = MiniprofSection(file_);
    section_.source.kind = source.kind;
  }

  LineScanner scanner_;
  std::string file_;
  Body body_;
  State state_ = State::start;
  bool in_sections_ = false, header_seen_ = false;
  std::string_view last_text_;
  MiniprofSection section_;
  std::vector<MiniprofSection> sections_;
};

std::string in_words(const MiniprofSection& section) {
  return fmt::format("{} ({} points, {})", section.number, section.table.size(),
                     section.drawn ? "drawn with " + section.program : "measured");
}

/// The one that is asked for; else the only one, or the only one that was measured.
MiniprofSection choose(std::vector<MiniprofSection>&& sections, const std::string& file, int number) {
  const auto all = [&] {
    std::string list;
    for (const MiniprofSection& s : sections) list += (list.empty() ? "" : ", ") + in_words(s);
    return list;
  };
  if (number > 0) {
    if (static_cast<std::size_t>(number) > sections.size())
      throw Error(ErrorKind::input_data, fmt::format("there is no profile {} in the file, there are {}", number, all()),
                  {file, 0, 0}, "name one of them");
    return std::move(sections[static_cast<std::size_t>(number) - 1]);
  }
  if (sections.empty())
    throw Error(ErrorKind::input_data, "there are no points in the file", {file, 0, 0}, "is it truncated?");
  if (sections.size() == 1) return std::move(sections.front());
  std::vector<MiniprofSection*> measured;
  for (MiniprofSection& s : sections)
    if (!s.drawn) measured.push_back(&s);
  if (measured.size() != 1)
    throw Error(ErrorKind::input_data, fmt::format("the file holds several profiles: {}", all()), {file, 0, 0},
                fmt::format("put its number behind the name: '{}#1' to '#{}'",
                            std::string_view(file).substr(file.find_last_of('/') + 1), sections.size()));
  measured.front()->source.notes.push_back(
      fmt::format("of several profiles this is the measured one: {}", in_words(*measured.front())));
  return std::move(*measured.front());
}

/// The first word of a text that is not a comment.
std::string_view first_line(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty() && line.front() != '!' && line.front() != '%') return line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

}  // namespace

bool begins_like_simpack(std::string_view text) { return lower(first_line(text)).starts_with("header.begin"); }

bool begins_like_miniprof(std::string_view text) {
  const std::string line = lower(first_line(text));
  if (line.starts_with("miniprof") || line.starts_with("#mini") || line == "[fileinfo]") return true;
  constexpr std::array<std::string_view, 6> kKeys{"programname", "columndef", "date",
                                                  "time",        "mptypeno",  "transformstate"};
  const std::size_t sign = line.find('=');
  return sign != std::string::npos &&
         std::find(kKeys.begin(), kKeys.end(), trimmed(std::string_view(line).substr(0, sign))) != kKeys.end();
}

ColumnContent parse_miniprof(std::string_view text, const std::string& file, Body body, int section) {
  MiniprofSection chosen = choose(MiniprofParser(text, file, body).parse(), file, section);
  ColumnContent content;
  content.points.file = file;
  content.offset_y = chosen.offset_y;
  content.offset_z = chosen.offset_z;
  content.source = std::move(chosen.source);
  if (chosen.table.empty()) return content;
  const ColumnRoles roles = chosen.roles.value_or(ColumnRoles{});
  if (!roles.in_words.empty()) content.source.notes.push_back("columns not used: " + roles.in_words);
  const points::FieldStyle style = chosen.table.style();
  if (!roles.named) chosen.table.refuse_ambiguous_commas(style);
  content.points = chosen.table.points(roles, style, false, content.source.notes);
  return content;
}

}  // namespace treadmark::io::profiles
