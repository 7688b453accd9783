// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/contact_program/contact_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::io {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Length of the line without its comment; a % within quotes is no comment.
std::size_t length_without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool word_start = i == 0 || is_blank(line[i - 1]) || line[i - 1] == ',';
    if (c == '\'' && (quoted || word_start)) quoted = !quoted;
    if (c == '%' && (!quoted || line.find('\'', i) == std::string_view::npos)) return i;
  }
  return line.size();
}

std::optional<double> to_real(std::string_view word) {
  constexpr double kGreatest = 1e100;  // other units of it are numbers still
  std::string text(word);
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';
  // Fortran leaves the letter out where an exponent has three digits, and reads it so always: .1-07 is .1e-07.
  const std::size_t sign = text.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && (is_digit(text[sign - 1]) || text[sign - 1] == '.'))
    text.insert(sign, 1, 'e');
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  if (first == last || !(is_digit(*first) || *first == '.' || *first == '-')) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = from_chars(first, last, value);
  if (error != std::errc{} || end != last || !(std::abs(value) <= kGreatest)) return std::nullopt;
  return value;
}

std::optional<long> to_integer(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  long value = 0;
  const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc{} && end == word.data() + word.size()) return value;
  const auto real = to_real(word);
  constexpr double kLargest = 1e15;  // up to which a real holds every integer
  if (!real || *real != std::floor(*real) || std::abs(*real) > kLargest) return std::nullopt;
  return to_whole<long>(*real);
}

std::optional<double> to_angle(std::string_view word) {
  double factor = 1.0;
  const char suffix = word.empty() ? ' ' : word.back();
  if (suffix == 'd' || suffix == 'D') factor = std::numbers::pi / 180.0;
  if (factor != 1.0 || suffix == 'r' || suffix == 'R') word.remove_suffix(1);
  const auto value = to_real(word);
  return value ? std::optional(*value * factor) : std::nullopt;
}

/// A word of digits only and another one right behind a comma, "0,28", on a line where blanks separate numbers, too.
bool looks_like_decimal_comma(std::string_view line, std::size_t begin, std::size_t end) {
  const auto digits_end = [&](std::size_t from) {
    while (from < line.size() && is_digit(line[from])) ++from;
    return from;
  };
  const auto ends_number = [&](std::size_t at) { return at >= line.size() || is_blank(line[at]) || line[at] == ','; };
  const std::size_t first = begin < line.size() && (line[begin] == '-' || line[begin] == '+') ? begin + 1 : begin;
  if (first == end || digits_end(first) != end || end >= line.size() || line[end] != ',') return false;
  const std::size_t second = digits_end(end + 1);
  if (second == end + 1 || !ends_number(second)) return false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (!is_blank(line[i]) || is_blank(line[i - 1]) || line[i - 1] == ',') continue;
    std::size_t next = i;
    while (next < line.size() && is_blank(line[next])) ++next;
    const std::size_t word = line.find_first_of(" \t\r,", next);
    if (is_digit(line[i - 1]) && next < line.size() && to_real(line.substr(next, word - next))) return true;
  }
  return false;
}

}  // namespace

ContactText::ContactText(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {
  where_ = {file_, 1, 1};
}

bool ContactText::next_line() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  const std::string_view raw = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  line_ = raw.substr(0, length_without_comment(raw));
  next_ = 0;
  line_begun_ = false;
  ++line_number_;
  constexpr std::string_view kOwn = "%treadmark ";
  if (const std::size_t own = raw.find_first_not_of(" \t");
      own != std::string_view::npos && raw.substr(own).starts_with(kOwn))
    own_settings_.push_back(
        {std::string(raw.substr(own + kOwn.size())), {file_, line_number_, static_cast<int>(own) + 1}});
  return true;
}

std::optional<ContactText::Word> ContactText::peek_on_line() {
  std::size_t begin = next_;
  for (bool comma = false; begin < line_.size(); ++begin) {
    if (line_[begin] == ',') {
      if (comma) {
        word_end_ = begin;
        return Word{};  // between two commas
      }
      comma = true;
    } else if (!is_blank(line_[begin])) {
      break;
    }
  }
  next_ = begin;
  if (next_ >= line_.size()) return std::nullopt;
  if (line_[next_] == '\'') {
    const std::size_t end = line_.find('\'', next_ + 1);
    const bool closed = end != std::string_view::npos;
    word_end_ = closed ? end + 1 : line_.size();
    return Word{line_.substr(next_ + 1, (closed ? end : line_.size()) - next_ - 1), true, closed};
  }
  word_end_ = next_;
  while (word_end_ < line_.size() && !is_blank(line_[word_end_]) && line_[word_end_] != ',') ++word_end_;
  return Word{line_.substr(next_, word_end_ - next_)};
}

bool ContactText::at_end() {
  while (!peek_on_line())
    if (!next_line()) return true;
  return false;
}

void ContactText::drop_line() {
  if (!line_begun_) return;
  line_ = {};
  next_ = 0;
}

void ContactText::begin_record(std::string_view name) {
  record_ = name;
  drop_line();
  if (at_end()) {
    where_ = {file_, line_number_, 0};
    fail(fmt::format("the file ends where {} is expected", name));
  }
  where_ = {file_, line_number_, static_cast<int>(next_) + 1};
}

ContactText::Word ContactText::required(std::string_view name, std::string_view kind) {
  if (at_end()) {
    where_ = {file_, line_number_, 0};
    fail(fmt::format("the file ends in {}: expected {} ({})", record_, name, kind));
  }
  const Word word = *peek_on_line();
  consume(word);
  return word;
}

void ContactText::consume(const Word& word) {
  where_ = {file_, line_number_, static_cast<int>(next_) + 1};
  last_length_ = static_cast<int>(std::min(word_end_ - next_, word.text.find('.')));
  if (looks_like_decimal_comma(line_, next_, word_end_))
    fail(fmt::format("'{}' may be two values or one with a decimal comma",
                     line_.substr(next_, line_.find_first_of(" \t\r", next_) - next_)),
         "write a point for a decimal comma, or a blank behind a comma that separates values");
  next_ = word_end_;
  line_begun_ = true;
}

void ContactText::wrong_word(std::string_view name, std::string_view kind, const Word& word) const {
  constexpr std::size_t kLongest = 40;
  if (word.text.empty() && !word.quoted)
    fail(fmt::format("expected {} ({}) of {}, found nothing between two commas", name, kind, record_));
  fail(fmt::format("expected {} ({}) of {}, found '{}'", name, kind, record_, word.text.substr(0, kLongest)));
}

void ContactText::fail(std::string_view message, std::string advice) const {
  throw Error(ErrorKind::configuration, std::string(message), where_, std::move(advice));
}

long ContactText::integer(std::string_view name) {
  const Word word = required(name, "an integer");
  const auto value = word.quoted ? std::nullopt : to_integer(word.text);
  if (!value) wrong_word(name, "an integer", word);
  return *value;
}

namespace {

void require_magnitude(const ContactText& text, std::string_view name, double value, double greatest) {
  if (!(std::abs(value) <= greatest))
    text.fail(fmt::format("{} = {:g} is beyond the greatest magnitude that is taken, {:g}", name, value, greatest));
}

}  // namespace

double ContactText::real(std::string_view name) {
  const Word word = required(name, "a number");
  const auto value = word.quoted ? std::nullopt : to_real(word.text);
  if (!value) wrong_word(name, "a number", word);
  constexpr double kBeyondAllUnits = 1e15;
  require_magnitude(*this, name, *value, kBeyondAllUnits);
  return *value;
}

double ContactText::real(std::string_view name, double greatest) {
  const double value = real(name);
  require_magnitude(*this, name, value, greatest);
  return value;
}

double ContactText::angle(std::string_view name, double greatest) {
  const double value = angle(name);
  require_magnitude(*this, name, value, greatest);
  return value;
}

double ContactText::angle(std::string_view name) {
  const Word word = required(name, "an angle");
  const auto value = word.quoted ? std::nullopt : to_angle(word.text);
  if (!value) wrong_word(name, "an angle", word);
  return *value;
}

std::string ContactText::quoted(std::string_view name) {
  const Word word = required(name, "text in single quotes");
  if (!word.quoted || !word.closed) wrong_word(name, "text in single quotes", word);
  return std::string(word.text);
}

std::optional<long> ContactText::optional_integer() {
  const auto word = peek_on_line();
  const auto value = word && !word->quoted ? to_integer(word->text) : std::nullopt;
  if (value) {
    consume(*word);
  } else if (word && !word->quoted && to_real(word->text)) {
    consume(*word);
    fail(fmt::format("expected an integer or nothing behind the values of {}, found '{}'", record_, word->text));
  }
  return value;
}

std::optional<double> ContactText::optional_real() {
  const auto word = peek_on_line();
  const auto value = word && !word->quoted ? to_real(word->text) : std::nullopt;
  if (value) consume(*word);
  return value;
}

}  // namespace treadmark::io
