// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/channels.hpp"

#include <fmt/format.h>

#include "treadmark/io/settings/key_info.hpp"

namespace treadmark::io {

std::string channel_name(const HistoryColumn& column) {
  const std::string& text = column.description;
  if (column.name.find('.') != std::string::npos || !text.ends_with(')')) return column.name;
  const auto open = text.rfind("(ws");
  if (open == std::string::npos) return column.name;
  const std::string wheel = text.substr(open + 1, text.size() - open - 2);
  return wheel.ends_with("_left") || wheel.ends_with("_right") ? wheel + '.' + column.name : column.name;
}

bool fits(const std::string& name, const std::string& pattern) {
  // the last star may stand for one letter more, as long as the rest does not fit
  std::size_t n = 0, p = 0, star = std::string::npos, after_star = 0;
  while (n < name.size())
    if (p < pattern.size() && pattern[p] == '*')
      star = p++, after_star = n;
    else if (p < pattern.size() && pattern[p] == name[n])
      ++n, ++p;
    else if (star != std::string::npos)
      p = star + 1, n = ++after_star;
    else
      return false;
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

std::vector<std::size_t> fitting_columns(std::span<const HistoryColumn> columns, std::span<const std::string> patterns,
                                         const SourcePosition& where) {
  std::vector<bool> wanted(columns.size());
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (fits(columns[i].name, pattern) || fits(channel_name(columns[i]), pattern)) wanted[i] = any = true;
    if (any) continue;
    std::vector<std::string> known;
    for (const HistoryColumn& column : columns) known.push_back(channel_name(column));
    const std::string nearest = nearest_key(pattern, known);
    throw Error(ErrorKind::configuration, fmt::format("no channel of the history is called '{}'", pattern), where,
                nearest.empty() ? "* stands for any letters; docs/histories.md lists the channels"
                                : fmt::format("did you mean '{}'?", nearest));
  }
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (wanted[i]) out.push_back(i);
  return out;
}

}  // namespace treadmark::io
