// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/surface_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

constexpr std::size_t kLongest = 200;
constexpr std::string_view kGoesOn = "surface-doubt-goes-on", kNames = "surface-doubts";

/// The first word, taken off.
std::string_view take_word(std::string_view& line) {
  const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(' '), line.size())); };
  skip_blanks();
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(word.size());
  skip_blanks();
  return word;
}

std::string in_ascii(std::string text) {
  for (char& c : text)
    if (c == '\t' || c == '\r')
      c = ' ';
    else if (c < ' ' || c > '~')
      c = '?';
  return text;
}

}  // namespace

std::vector<std::string> to_lines(std::span<const SurfaceDoubt> doubts) {
  std::vector<std::string> out;
  for (const SurfaceDoubt& doubt : doubts) {
    std::string line = fmt::format("{} {}:", kSurfaceDoubt, doubt.name);
    std::string_view rest = doubt.text;
    while (!rest.empty()) {
      const std::string_view word = take_word(rest);
      if (line.size() + 1 + word.size() > kLongest) out.push_back(std::exchange(line, std::string(kGoesOn)));
      line.append(" ").append(word);
    }
    out.push_back(std::move(line));
  }
  return out;
}

std::string names_line(std::span<const SurfaceDoubt> doubts) {
  if (doubts.empty()) return {};
  std::string out{kNames};
  for (const SurfaceDoubt& doubt : doubts) out += ' ' + doubt.name;
  return out;
}

std::vector<SurfaceDoubt> doubts_of_lines(std::span<const std::string> lines) {
  std::vector<SurfaceDoubt> out;
  for (const std::string& given : lines) {
    const std::string line = in_ascii(given);
    std::string_view rest = line;
    const std::string_view key = take_word(rest);
    while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
    if (key == kSurfaceDoubt) {
      const std::string_view all = rest, name = take_word(rest);
      if (name.ends_with(':'))
        out.push_back({std::string(name.substr(0, name.size() - 1)), std::string(rest)});
      else
        out.push_back({"import", std::string(all)});
    } else if (key == kGoesOn && !out.empty()) {
      std::string& text = out.back().text;
      text.append(text.empty() ? "" : " ").append(rest);
    } else if (key == kNames) {
      while (!rest.empty())
        out.push_back({std::string(take_word(rest)), "the import of the scan warned of it; its report says more"});
    }
  }
  return out;
}

void add_doubts(std::vector<SurfaceDoubt>& to, std::span<const SurfaceDoubt> from) {
  for (const SurfaceDoubt& doubt : from)
    if (ranges::find(to, doubt) == to.end()) to.push_back(doubt);
}

std::string in_words(const SurfaceDoubt& doubt, std::string_view body, const std::string& file) {
  return fmt::format("{} surface {}: {}: {}", body, file, doubt.name, doubt.text);
}

}  // namespace treadmark
