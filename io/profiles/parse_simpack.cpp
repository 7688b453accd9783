// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <optional>
#include <utility>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/profiles/parse_points.hpp"

namespace treadmark::io::profiles {
namespace {

enum class Section { none, header, spline, points };

constexpr double kSmallestNearDistance = 1e-6;

class SimpackParser {
 public:
  SimpackParser(std::string_view text, const std::string& file, Body body) : scanner_(text, file), body_(body) {
    content_.points.file = file;
  }

  SimpackContent parse() {
    while (scanner_.next_line()) {
      drop_comment();
      if (const std::optional<Word> first = scanner_.next_word()) statement(*first);
    }
    if (!skipped_.empty())
      scanner_.fail("the file ends without " + printable(skipped_ + ".end"), 0, "is the file truncated?");
    switch (section_) {
      case Section::header:
        scanner_.fail("the file ends without 'header.end'", 0, "is the file truncated?");
      case Section::points:
        scanner_.fail("the file ends without 'point.end'", 0, "is the file truncated?");
      case Section::spline:
        scanner_.fail("the file ends without 'spline.end'", 0, "is the file truncated?");
      case Section::none:
        break;
    }
    if (!have_points_) scanner_.fail("no 'point.begin' in the file", 0, "is this a Simpack profile?");
    return std::move(content_);
  }

 private:
  void drop_comment() {
    const std::string_view line = scanner_.line();
    bool in_quotes = false;
    bool at_start = true;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\'') in_quotes = !in_quotes;
      if ((line[i] == '!' && !in_quotes) || (line[i] == '%' && at_start)) return scanner_.cut(i);
      if (!is_blank(line[i])) at_start = false;
    }
  }

  void statement(const Word& first) {
    if (section_ == Section::points && looks_numeric(first.text)) return point(first);
    const std::string word = lower(first.text);
    if (!skipped_.empty()) {
      if (word == skipped_ + ".end") skipped_.clear();
      return;
    }
    const bool has_sign = word.find('=') != std::string::npos;
    if (word.ends_with(".begin") && !has_sign) return begin(word, first);
    if (word.ends_with(".end") && !has_sign) return end(word, first);
    if (section_ == Section::points) to_number(scanner_, first);  // says what is wrong with the word
    if (section_ == Section::none)
      scanner_.fail("text outside the sections: " + printable(first.text), first.column, "is this a Simpack profile?");
    key_and_value(first);
  }

  void begin(const std::string& word, const Word& first) {
    if (section_ == Section::points)
      scanner_.fail(printable(first.text) + " before 'point.end'", first.column, "is the file damaged?");
    if (word == "header.begin" && section_ == Section::none) {
      section_ = Section::header;
    } else if (word == "spline.begin" && section_ == Section::none) {
      section_ = Section::spline;
    } else if (word == "point.begin" && section_ == Section::spline) {
      if (have_points_) scanner_.fail("a second 'point.begin'", first.column, "keep one profile in a file");
      have_points_ = true;
      section_ = Section::points;
    } else if (word == "header.begin" || word == "spline.begin" || word == "point.begin") {
      scanner_.fail(printable(first.text) + " does not belong here", first.column, "is a section not ended?");
    } else {
      skipped_ = word.substr(0, word.size() - 6);
    }
  }

  void end(const std::string& word, const Word& first) {
    if (word == "point.end" && section_ == Section::points) {
      section_ = Section::spline;
    } else if ((word == "spline.end" && section_ == Section::spline) ||
               (word == "header.end" && section_ == Section::header)) {
      section_ = Section::none;
    } else {
      scanner_.fail(printable(first.text) + " ends a section that is not open", first.column,
                    "is a section not ended?");
    }
  }

  void point(const Word& first) {
    const double y = to_number(scanner_, first);
    const std::optional<Word> second = scanner_.next_word();
    if (!second) scanner_.fail("a point needs y and z, there is one number", first.column, "is the file truncated?");
    const double z = to_number(scanner_, *second);
    if (const std::optional<Word> weight = scanner_.next_word()) {
      to_number(scanner_, *weight);
      if (const std::optional<Word> more = scanner_.next_word())
        scanner_.fail("a point has y, z and a weight, this is more: " + printable(more->text), more->column);
    }
    content_.points.add(y, z, scanner_.number());
  }

  void key_and_value(const Word& first) {
    const std::size_t sign = scanner_.line().find('=');
    if (sign == std::string_view::npos)
      scanner_.fail("'key = value' is expected, this is " + printable(first.text), first.column);
    const auto start = static_cast<std::size_t>(first.column - 1);
    if (sign <= start) scanner_.fail("a key is missing before '='", first.column);
    std::string key = lower(scanner_.line().substr(start, sign - start));
    while (is_blank(key.back())) key.pop_back();
    scanner_.set_offset(sign + 1);
    if (section_ == Section::header)
      header_value(key);
    else
      spline_value(key);
  }

  void header_value(const std::string& key) {
    if (key != "type") return;
    const Word word = value(key);
    const int type = to_integer(scanner_, word);
    if (type != 0 && type != 1) scanner_.fail("type must be 0 (rail) or 1 (wheel)", word.column);
    if ((type == 0) != (body_ == Body::rail))
      scanner_.fail(type == 0 ? "this is a rail profile, a wheel profile is expected"
                              : "this is a wheel profile, a rail profile is expected",
                    word.column, "exchange the files or correct the type");
  }

  void spline_value(const std::string& key) {
    if (key == "shift.y")
      content_.shift_y = number(key);
    else if (key == "shift.z")
      content_.shift_z = number(key);
    else if (key == "bound.y.min")
      content_.y_min = number(key);
    else if (key == "bound.y.max")
      content_.y_max = number(key);
    else if (key == "bound.z.min")
      content_.z_min = number(key);
    else if (key == "bound.z.max")
      content_.z_max = number(key);
    else if (key == "mirror.y")
      content_.mirror_y = flag(key);
    else if (key == "mirror.z")
      content_.mirror_z = flag(key);
    else if (key == "inversion")
      content_.inversion = flag(key);
    else if (key == "point.dist.min")
      content_.near_distance = std::max(kSmallestNearDistance, number(key));
    else if (key == "units.len.f")
      content_.units_per_metre = positive(key);
    else if (key == "units.ang.f")
      positive(key);
    else if (key == "rotate")
      no_rotation(key);
  }

  Word value(const std::string& key) {
    const std::optional<Word> word = scanner_.next_word();
    if (!word) scanner_.fail("'" + key + "' has no value", static_cast<int>(scanner_.line().size()));
    if (const std::optional<Word> more = scanner_.next_word())
      scanner_.fail("'" + key + "' takes one value, this is more: " + printable(more->text), more->column);
    return *word;
  }

  double number(const std::string& key) { return to_number(scanner_, value(key)); }

  double positive(const std::string& key) {
    const Word word = value(key);
    const double result = to_number(scanner_, word);
    if (!(result > 0.0)) scanner_.fail("'" + key + "' must be positive", word.column);
    return result;
  }

  bool flag(const std::string& key) {
    const Word word = value(key);
    const double result = to_number(scanner_, word);
    if (result != 0.0 && result != 1.0) scanner_.fail("'" + key + "' must be 0 or 1", word.column);
    return result == 1.0;
  }

  void no_rotation(const std::string& key) {
    const Word word = value(key);
    if (to_number(scanner_, word) != 0.0)
      scanner_.fail("rotated profiles are not supported: 'rotate' must be 0", word.column, "rotate the points");
  }

  LineScanner scanner_;
  Body body_;
  SimpackContent content_;
  Section section_ = Section::none;
  std::string skipped_;  ///< name of a section without meaning here, until it ends
  bool have_points_ = false;
};

}  // namespace

SimpackContent parse_simpack(std::string_view text, const std::string& file, Body body) {
  return SimpackParser(text, file, body).parse();
}

}  // namespace treadmark::io::profiles
