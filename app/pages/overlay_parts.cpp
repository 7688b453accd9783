// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/pages/overlay_parts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/report/html_text.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

/// Finds a line by its name, or begins it.
SaidByAll& line_of(std::vector<SaidByAll>& lines, const std::string& what, std::size_t results, const char* otherwise) {
  const auto found = ranges::find(lines, what, &SaidByAll::what);
  if (found != lines.end()) return *found;
  lines.push_back({what, std::vector<std::string>(results, otherwise)});
  return lines.back();
}

std::string version_of(const Origin& origin) {
  return origin.git.empty() ? origin.version : fmt::format("{} ({})", origin.version, origin.git);
}

/// As much of a text as a table has room for.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 60, kKept = 40;
  if (text.size() <= kMost) return text;
  return fmt::format("{}… ({} characters)", io::cut_to_bytes(text, kKept), io::characters_of(text));
}

}  // namespace

Change change(double first, double second, double scale) {
  constexpr double kRounding = 1e-9, kLeastShare = 1e-3;
  Change out{second - first, kNaN};
  if (std::fabs(out.difference) <= kRounding * std::max(std::fabs(first), std::fabs(second))) out.difference = 0.0;
  if (std::isfinite(out.difference) && first != 0.0 && std::fabs(first) >= kLeastShare * scale)
    out.percent = 100.0 * out.difference / std::fabs(first);
  return out;
}

Cards::Card change_card(const std::string& label, const Change& change, const std::string& unit,
                        const std::string& where) {
  const auto with_sign = [](double value, const std::string& of) {
    return fmt::format("{}{}{}{}",
                       value > 0.0   ? "+"
                       : value < 0.0 ? "−"
                                     : "",
                       shown({std::fabs(value), 3}), of.empty() ? "" : " ", of);
  };
  if (!std::isfinite(change.difference)) return {label, "–", where};
  std::string note = std::isfinite(change.percent) ? with_sign(change.percent, "%") : std::string();
  if (!where.empty()) note += (note.empty() ? "" : ", ") + where;
  return {label, with_sign(change.difference, unit), std::move(note)};
}

void add_columns(Table& table, const std::vector<std::string>& names, const std::string& quantity,
                 const std::string& unit) {
  const std::string of = quantity.empty() ? "" : quantity + ", ";
  for (const std::string& name : names) table.columns.push_back({of + name, unit});
  for (std::size_t k = 1; k < names.size(); ++k) {
    const std::string whose = names.size() > 2 ? " of " + names[k] : "";
    table.columns.push_back({fmt::format("{}difference{}", of, whose), unit});
    table.columns.push_back({fmt::format("{}change{}", of, whose), "%"});
  }
}

void add_cells(Table::Row& row, std::span<const double> values, double scale) {
  constexpr int kDigits = 5, kDigitsOfChange = 3;
  for (const double value : values) row.cells.emplace_back(Number{value, kDigits});
  for (const double value : values.subspan(1)) {
    const Change step = change(values.front(), value, scale);
    row.cells.emplace_back(Number{step.difference, kDigitsOfChange});
    row.cells.emplace_back(Number{step.percent, kDigitsOfChange});
  }
}

std::vector<SaidByAll> origins_of(std::span<const Origin> origins, bool whole) {
  constexpr std::size_t kShort = 12;
  const auto hash = [&](const std::string& text) {
    return whole || text.size() <= kShort ? text : text.substr(0, kShort) + "…";
  };
  std::vector<SaidByAll> lines;
  for (std::size_t k = 0; k < origins.size(); ++k) {
    const Origin& origin = origins[k];
    const auto say = [&](const std::string& what, const std::string& text, const char* otherwise = "–") {
      if (!text.empty()) line_of(lines, what, origins.size(), otherwise).texts[k] = text;
    };
    say("version", version_of(origin));
    say("input", origin.input_file);
    say("SHA-256 of the input", hash(origin.input_sha256));
    for (const auto& [file, sha256] : origin.geometry_sha256) say("SHA-256 of " + file, hash(sha256));
    for (const std::string& setting : origin.settings) {
      const std::size_t equals = setting.find('=');
      const bool pair = equals != std::string::npos;
      say("set: " + setting.substr(0, equals), pair ? setting.substr(equals + 1) : "yes", "as in the input");
    }
    for (const auto& [name, value] : origin.inputs) say(name, value, "not given");
  }
  return lines;
}

Block difference_table(const std::vector<std::string>& names, const std::vector<SaidByAll>& lines) {
  Table table{"differs", "What differs between the results besides their numbers.", {{"what"}}};
  for (const std::string& name : names) table.columns.push_back({name});
  for (const SaidByAll& line : lines) {
    if (ranges::all_of(line.texts, [&](const std::string& text) { return text == line.texts.front(); })) continue;
    Table::Row row{{line.what}};
    for (const std::string& text : line.texts) row.cells.emplace_back(shortened(text));
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) return Paragraph{"Version, inputs and settings are the same."};
  return table;
}

Section origins_section(const std::vector<std::string>& names, std::span<const Origin> origins) {
  Section section{"origin", "Origin"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    section.blocks.emplace_back(Paragraph{names[k] + ":"});
    section.blocks.emplace_back(origin_facts(origins[k]));
    if (!origins[k].inputs.empty()) section.blocks.emplace_back(Facts{origins[k].inputs});
  }
  return section;
}

void add_version_note(std::span<const Origin> origins, Section& overview) {
  std::vector<std::string> versions;
  for (const Origin& origin : origins)
    if (ranges::find(versions, version_of(origin)) == versions.end()) versions.push_back(version_of(origin));
  if (versions.size() > 1)
    overview.blocks.emplace_back(Banner{
        Banner::Kind::note, "Versions differ:", joined(versions) + ". What differs below may come from the program."});
}

std::string stretches(std::span<const int> numbers) {
  constexpr int kMost = 12;
  std::string out;
  int written = 0;
  for (std::size_t i = 0; i < numbers.size();) {
    if (written++ == kMost) return out + " ...";
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (last == i + 1) last = i;  // two are said one by one
    out += out.empty() ? "" : ", ";
    out += last == i ? fmt::format("{}", numbers[i]) : fmt::format("{} to {}", numbers[i], numbers[last]);
    i = last + 1;
  }
  return out;
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t k = 0; k < names.size(); ++k)
    out += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return out;
}

}  // namespace treadmark::app::pages
