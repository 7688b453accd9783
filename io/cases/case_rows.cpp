// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/points/line_blocks.hpp"
#include "treadmark/io/settings/toml_faults.hpp"

namespace treadmark::io {
namespace {

/// Keys that make the surfaces, or several cases: rows are contacts of one pair, each by itself.
bool is_shared(std::string_view path) {
  constexpr std::string_view kSections[] = {"rail.", "wheel.", "roller.", "influence.", "subsurface."};
  constexpr std::string_view kKeys[] = {"wheelset.nominal_radius_mm",
                                        "wheelset.flange_back_position_mm",
                                        "case.steps",
                                        "case.time_step_s",
                                        "case.history",
                                        "case.sequence"};
  return ranges::any_of(kSections, [&](std::string_view section) { return path.starts_with(section); }) ||
         ranges::find(kKeys, path) != std::end(kKeys);
}

constexpr std::size_t kLongestShown = 40;

bool is_number(const CaseKey& key) { return key.info.type == KeyType::number || key.info.type == KeyType::integer; }

bool holds_row(std::string_view line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first != std::string_view::npos && line[first] != '#';
}

void require_table(const std::filesystem::path& file) {
  require_file(file, "table of cases", ErrorKind::configuration);
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown))
    throw Error(ErrorKind::configuration, "a table of cases is read more than once, which this cannot be",
                {file.string()}, "copy it into a file");
  if (!std::ifstream(file, std::ios::binary))
    throw Error(ErrorKind::configuration, "the table of cases cannot be opened", {file.string()},
                "check its permissions");
}

/// The check sum of rows one after the other.
std::uint64_t with_row(std::uint64_t sum, std::string_view line) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;
  return kOdd * sum + check_sum(std::as_bytes(std::span<const char>(line)));
}

[[noreturn]] void refuse_empty(const SourcePosition& where) {
  throw Error(ErrorKind::configuration, "the table has no rows", where,
              "its first line names keys with commas between them, every other one is a case");
}

std::vector<std::string> cells_of(std::string_view line, const SourcePosition& where) {
  if (ranges::count(line, '"') % 2 != 0)
    throw Error(ErrorKind::configuration, "a quote is not closed", where, "quotes stand in pairs, within one line");
  return csv_cells(line);
}

/// A cell as what its key takes; a word where numbers stand is text, which check_value refuses in words.
CaseValue cell_value(const KeyInfo& key, const std::string& cell, const SourcePosition& where) {
  const bool plus = cell.starts_with('+') && !cell.starts_with("+-");
  const char *const first = cell.data() + (plus ? 1 : 0), *const last = cell.data() + cell.size();
  const auto parsed = [&](auto value) -> CaseValue {
    const auto [end, trouble] = from_chars(first, last, value);
    if (trouble == std::errc() && end == last) return {where, value};
    if (!key.choices.empty()) return {where, cell};
    const TextFault fault = number_fault(cell);
    const std::string_view shown = cut_to_bytes(cell, kLongestShown);
    throw Error(ErrorKind::configuration,
                fmt::format("{} = '{}{}' is no {}", key.path, shown, shown.size() < cell.size() ? "..." : "",
                            key.type == KeyType::integer ? "whole number" : "number"),
                where, fault.message.empty() ? "" : fault.message + ": " + fault.advice);
  };
  switch (key.type) {
    case KeyType::number:
      if (ranges::find(key.choices, cell) != key.choices.end()) return {where, cell};
      return parsed(double{});
    case KeyType::integer:
      return parsed(std::int64_t{});
    case KeyType::flag:
      if (cell == "true" || cell == "false") return {where, cell == "true"};
      return {where, cell};
    default:
      return {where, cell};
  }
}

}  // namespace

CaseRows::CaseRows(std::filesystem::path file, Case common, std::filesystem::path folder,
                   std::vector<CaseOverride> changes)
    : file_(std::move(file)), common_(std::move(common)), folder_(std::move(folder)), changes_(std::move(changes)) {
  for (const CaseOverride& change : changes_)
    if (change.value.is_list() && case_key(change.path) != nullptr && is_number(*case_key(change.path)))
      throw Error(ErrorKind::configuration,
                  fmt::format("a list of {} makes cases, and so does cases_file", change.path), change.value.where,
                  "give one value, which all rows get, or leave cases_file out");
  index();
  sha256_ = sha256_file(file_);  // between two readings of all rows that must be the same
  std::vector<std::exception_ptr> errors(blocks());
  parallel_for(blocks(), [&](std::size_t k) {
    try {
      block(k);
    } catch (const Error&) {
      errors[k] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

void CaseRows::index() {
  require_table(file_);
  if (std::filesystem::file_size(file_) == 0) refuse_empty(at(0));
  points::ByteBlocks bytes(file_, {}, {});
  points::LineBlocks lines(bytes);
  for (std::string_view line; lines.next(line);) {
    if (line.find('\0') != std::string_view::npos)
      throw Error(ErrorKind::configuration, "the table holds zero bytes, which no text does", at(lines.number()),
                  "save it as UTF-8 text with commas");
    if (!holds_row(line)) continue;
    if (heads_.empty()) {
      take_heads(line, lines.number());
      continue;
    }
    if (count_++ % kBlock == 0) blocks_.push_back({lines.start(), lines.number(), 0});
    blocks_.back().sum = with_row(blocks_.back().sum, line);
  }
  if (count_ == 0) refuse_empty(at(lines.number()));
}

/// By a change of the key itself, or of another alternative of its group.
bool CaseRows::is_overridden(const CaseKey& key) const {
  return ranges::any_of(changes_, [&](const CaseOverride& change) {
    const CaseKey* other = case_key(change.path);
    return other != nullptr && (other == &key || (!key.info.group.empty() && other->info.group == key.info.group &&
                                                  other->info.alternative != key.info.alternative));
  });
}

void CaseRows::take_heads(std::string_view line, int number) {
  heads_ = cells_of(line, at(number));
  ChosenKeys chosen;
  for (std::size_t i = 0; i < heads_.size(); ++i) {
    const std::string& head = heads_[i];
    const CaseKey* key = case_key(head);
    if (key == nullptr && head.find(';') != std::string::npos)
      throw Error(ErrorKind::configuration, "semicolons stand between the names of columns", at(number),
                  "put commas between cells, and points into numbers");
    if (head.empty())
      throw Error(ErrorKind::configuration, fmt::format("column {} has no name", i + 1), at(number),
                  "is there a comma too many?");
    if (key == nullptr) refuse_unknown_case_key(head, at(number));
    const KeyType type = key->info.type;
    if (is_shared(head) || !(is_number(*key) || type == KeyType::flag || type == KeyType::choice))
      throw Error(ErrorKind::configuration, fmt::format("{} cannot differ from row to row", head), at(number),
                  "rows of cases_file are contacts of one pair, each by itself: give it in the case file, or use "
                  "[[cases]]");
    if (ranges::find(columns_, key, &Column::key) != columns_.end())
      throw Error(ErrorKind::configuration, fmt::format("two columns have the name {}", head), at(number));
    check_exclusive(key->info, at(number), chosen);
    Column& column = columns_.emplace_back(Column{key, i, {}});
    if (is_overridden(*key)) {
      overridden_.push_back(head);
    } else if (is_number(*key)) {
      column.number = numbers_.size();
      numbers_.push_back(key);
    }
  }
  const SourcePosition where = at(number);
  std::vector<GivenKey> given;
  for (const std::string& head : heads_) given.push_back({head, &where});
  check_exclusive_sections(given);
  ranges::sort(columns_, {}, &Column::key);  // keys stand in the order in which they are applied
}

std::vector<CaseRow> CaseRows::block(std::size_t k) const {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  const auto changed = [&] {
    throw Error(ErrorKind::configuration, "the table of cases has changed while it was read", {file_.string()},
                "leave it alone until the work is done, and start anew");
  };
  require_table(file_);
  points::ByteBlocks bytes(file_, {}, {}, kPiece);
  if (blocks_[k].offset >= bytes.size()) changed();
  bytes.seek(blocks_[k].offset);
  points::LineBlocks lines(bytes, blocks_[k].line);
  const std::size_t first = k * kBlock, count = std::min(kBlock, count_ - first);
  std::vector<std::pair<int, std::string>> rows;
  std::uint64_t sum = 0;
  for (std::string_view line; rows.size() < count && lines.next(line);)
    if (holds_row(line)) {
      sum = with_row(sum, line);
      rows.emplace_back(lines.number(), line);
    }
  if (rows.size() < count || sum != blocks_[k].sum) changed();
  std::vector<CaseRow> out;
  out.reserve(count);
  for (const auto& [number, line] : rows) out.push_back(row(line, first + out.size(), number));
  return out;
}

CaseRow CaseRows::row(std::string_view line, std::size_t index, int line_number) const {
  const SourcePosition where = at(line_number);
  const std::vector<std::string> cells = cells_of(line, where);
  if (cells.size() != heads_.size())
    throw Error(ErrorKind::configuration,
                fmt::format("cells of the row: {}, columns of the table: {}", cells.size(), heads_.size()), where);
  CaseRow out{common_, std::vector<double>(numbers_.size(), NAN)};
  for (const auto& [key, cell, number] : columns_) {
    if (cells[cell].empty())
      throw Error(ErrorKind::configuration, fmt::format("{} is empty", key->info.path), where,
                  "every row gives every column");
    const CaseValue value = cell_value(key->info, cells[cell], where);
    apply_value(out.content, *key, value, folder_);
    if (number && !std::holds_alternative<std::string>(value.data)) out.numbers[*number] = value.number();
  }
  for (const CaseOverride& change : changes_) apply_assignment(out.content, change, folder_);
  out.content.number = static_cast<int>(index) + 1;
  out.content.where = where;
  if (out.content.steps > 0 ||
      std::visit([](const auto& content) { return content.history != HistoryUse::start; }, out.content.content))
    throw Error(ErrorKind::configuration, "rows of cases_file do not follow each other in time", where,
                "leave case.history and case.steps out, or use [[cases]]");
  take_as_told(out.content);
  validate_case(out.content);
  std::vector<Case> alone{std::move(out.content)};
  settle_sequences(alone);
  out.content = std::move(alone.front());
  return out;
}

}  // namespace treadmark::io
