// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/contact_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace treadmark::io {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Length of the line without its comment; a % within quotes is no comment.
std::size_t length_without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool word_start = i == 0 || is_blank(line[i - 1]);
    if (c == '\'' && (quoted || word_start)) quoted = !quoted;
    if (c == '%' && (!quoted || line.find('\'', i) == std::string_view::npos)) return i;
  }
  return line.size();
}

std::optional<double> to_real(std::string_view word) {
  std::string text(word);
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  if (first == last || !(std::isdigit(static_cast<unsigned char>(*first)) || *first == '.' || *first == '-'))
    return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc{} || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<long> to_integer(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<double> to_angle(std::string_view word) {
  double factor = 1.0;
  const char suffix = word.empty() ? ' ' : word.back();
  if (suffix == 'd' || suffix == 'D') factor = std::numbers::pi / 180.0;
  if (factor != 1.0 || suffix == 'r' || suffix == 'R') word.remove_suffix(1);
  const auto value = to_real(word);
  return value ? std::optional(*value * factor) : std::nullopt;
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
  return true;
}

std::optional<ContactText::Word> ContactText::peek_on_line() {
  while (next_ < line_.size() && is_blank(line_[next_])) ++next_;
  if (next_ >= line_.size()) return std::nullopt;
  if (line_[next_] == '\'') {
    const std::size_t end = line_.find('\'', next_ + 1);
    const bool closed = end != std::string_view::npos;
    word_end_ = closed ? end + 1 : line_.size();
    return Word{line_.substr(next_ + 1, (closed ? end : line_.size()) - next_ - 1), true, closed};
  }
  word_end_ = next_;
  while (word_end_ < line_.size() && !is_blank(line_[word_end_])) ++word_end_;
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
  where_ = {file_, line_number_, static_cast<int>(next_) + 1};
  last_length_ = static_cast<int>(word_end_ - next_);
  next_ = word_end_;
  line_begun_ = true;
  return word;
}

void ContactText::wrong_word(std::string_view name, std::string_view kind, const Word& word) const {
  constexpr std::size_t kLongest = 40;
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

double ContactText::real(std::string_view name) {
  const Word word = required(name, "a number");
  const auto value = word.quoted ? std::nullopt : to_real(word.text);
  if (!value) wrong_word(name, "a number", word);
  return *value;
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
    where_ = {file_, line_number_, static_cast<int>(next_) + 1};
    next_ = word_end_;
    line_begun_ = true;
  }
  return value;
}

std::optional<double> ContactText::optional_real() {
  const auto word = peek_on_line();
  const auto value = word && !word->quoted ? to_real(word->text) : std::nullopt;
  if (value) {
    where_ = {file_, line_number_, static_cast<int>(next_) + 1};
    next_ = word_end_;
    line_begun_ = true;
  }
  return value;
}

}  // namespace treadmark::io
