// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/toml_nesting.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {

namespace {

SourcePosition place_in(std::string_view text, std::size_t at, const std::string& name) {
  const std::string_view before = text.substr(0, at);
  const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 = 0
  return {name, 1 + static_cast<int>(ranges::count(before, '\n')), 1 + static_cast<int>(characters_of(line))};
}

/// What the characters of a TOML text outside strings and comments mean for depth.
class NestingScan {
 public:
  /// Returns the depth that the character leads to.
  std::size_t take(char c) {
    switch (c) {
      case '.':
        if (!in_value_) ++parts_;  // else the point of a number
        break;
      case '=':
        in_value_ = true;
        break;
      case '[':
        if (open_.empty() && !in_value_)
          begin_header();
        else
          enter(true);
        break;
      case '{':
        enter(false);
        break;
      case ']':
      case '}':
        leave();
        break;
      case ',':
        if (!open_.empty()) begin_element();
        break;
      case '\n':
        if (open_.empty()) begin_line();
        break;
      default:
        break;
    }
    return outer_ + parts_;
  }

 private:
  struct Bracket {
    std::size_t outer, parts;  ///< outside it
    bool list;
  };

  void enter(bool list) {
    open_.push_back({outer_, parts_, list});
    outer_ += parts_;
    begin_element();
  }
  void leave() {
    if (open_.empty()) return;  // that of a header
    outer_ = open_.back().outer;
    parts_ = open_.back().parts;
    in_value_ = true;
    open_.pop_back();
  }
  void begin_element() {
    parts_ = 1;
    in_value_ = open_.back().list;
  }
  void begin_header() {
    outer_ = 0;
    in_header_ = true;
  }
  void begin_line() {
    if (in_header_) outer_ = parts_;
    in_header_ = in_value_ = false;
    parts_ = 1;
  }

  std::vector<Bracket> open_;
  std::size_t outer_ = 0;  ///< depth of what surrounds the key or element
  std::size_t parts_ = 1;  ///< of the key, as far as it is read
  bool in_value_ = false, in_header_ = false;
};

}  // namespace

std::size_t after_toml_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool lines = text.substr(at, 3) == three;
  for (at += lines ? 3 : 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (!lines && (text[at] == quote || text[at] == '\n')) {
      return at + 1;
    } else if (lines && text.substr(at, 3) == three) {
      at += 3;
      for (int k = 0; k < 2 && at < text.size() && text[at] == quote; ++k) ++at;  // quotes may stand before the end
      return at;
    }
  }
  return text.size();
}

void refuse_deep_toml(std::string_view text, const std::string& name) {
  NestingScan scan;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = after_toml_string(text, at);
    } else if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (scan.take(c) > kDeepestNesting) {
      throw Error(ErrorKind::configuration, fmt::format("nested deeper than {} tables and lists", kDeepestNesting),
                  place_in(text, at, name), "no key lies that deep");
    } else {
      ++at;
    }
  }
}

}  // namespace treadmark::io
