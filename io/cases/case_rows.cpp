// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <initializer_list>
#include <utility>

#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/text.hpp"

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

bool is_number(const CaseKey& key) { return key.info.type == KeyType::number || key.info.type == KeyType::integer; }

bool holds_row(std::string_view line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first != std::string_view::npos && line[first] != '#';
}

std::ifstream opened(const std::filesystem::path& file) {
  require_file(file, "table of cases", ErrorKind::configuration);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(ErrorKind::configuration, "cannot read the table of cases", {file.string()});
  return in;
}

/// A cell as what its key takes; where that cannot be, as text, which check_value refuses in words.
CaseValue cell_value(const KeyInfo& key, const std::string& cell, const SourcePosition& where) {
  const char *const first = cell.data() + (cell.starts_with('+') ? 1 : 0), *const last = cell.data() + cell.size();
  const auto parsed = [&](auto value) -> CaseValue {
    const auto [end, trouble] = from_chars(first, last, value);
    if (trouble == std::errc() && end == last) return {where, value};
    return {where, cell};
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
  sha256_ = sha256_file(file_);
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
  std::ifstream in = opened(file_);
  std::uint64_t offset = 0;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::uint64_t begin = offset;
    offset += line.size() + 1;
    ++number;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (line.find('\0') != std::string::npos)
      throw Error(ErrorKind::configuration, "the table holds zero bytes, which no text does", at(number),
                  "save it as UTF-8 text with commas");
    if (!holds_row(line)) continue;
    if (heads_.empty()) {
      take_heads(line, number);
      continue;
    }
    if (count_++ % kBlock == 0) blocks_.push_back({begin, number});
  }
  if (count_ == 0)
    throw Error(ErrorKind::configuration, "the table has no rows", at(number),
                "its first line names keys with commas between them, every other one is a case");
}

void CaseRows::take_heads(const std::string& line, int number) {
  heads_ = csv_cells(line);
  ChosenKeys chosen;
  for (std::size_t i = 0; i < heads_.size(); ++i) {
    const std::string& head = heads_[i];
    const CaseKey* key = case_key(head);
    if (key == nullptr && head.find(';') != std::string::npos)
      throw Error(ErrorKind::configuration, "semicolons stand between the names of columns", at(number),
                  "put commas between cells, and points into numbers");
    if (key == nullptr) refuse_unknown_case_key(head, at(number));
    const KeyType type = key->info.type;
    if (is_shared(head) || !(is_number(*key) || type == KeyType::flag || type == KeyType::choice))
      throw Error(ErrorKind::configuration, fmt::format("{} cannot differ from row to row", head), at(number),
                  "rows of cases_file are contacts of one pair, each by itself: give it in the case file, or use "
                  "[[cases]]");
    if (ranges::find(columns_, key, &Column::key) != columns_.end())
      throw Error(ErrorKind::configuration, fmt::format("two columns have the name {}", head), at(number));
    check_exclusive(key->info, at(number), chosen);
    columns_.push_back({key, i, numbers_.size()});
    if (is_number(*key)) numbers_.push_back(key);
  }
  ranges::sort(columns_, {}, &Column::key);  // keys stand in the order in which they are applied
}

std::vector<CaseRow> CaseRows::block(std::size_t k) const {
  std::ifstream in = opened(file_);
  in.seekg(static_cast<std::streamoff>(blocks_[k].offset));
  const std::size_t first = k * kBlock, count = std::min(kBlock, count_ - first);
  std::vector<CaseRow> out;
  out.reserve(count);
  int number = blocks_[k].line;
  for (std::string line; out.size() < count && std::getline(in, line); ++number)
    if (holds_row(line)) out.push_back(row(line, first + out.size(), number));
  if (out.size() < count)
    throw Error(ErrorKind::configuration, "the table of cases has changed while it was read", {file_.string()});
  return out;
}

CaseRow CaseRows::row(const std::string& line, std::size_t index, int line_number) const {
  const SourcePosition where = at(line_number);
  const std::vector<std::string> cells = csv_cells(line);
  if (cells.size() != heads_.size())
    throw Error(ErrorKind::configuration,
                fmt::format("{} cells where there are {} columns", cells.size(), heads_.size()), where);
  CaseRow out{common_, std::vector<double>(numbers_.size(), NAN)};
  for (const auto& [key, cell, number] : columns_) {
    if (cells[cell].empty())
      throw Error(ErrorKind::configuration, fmt::format("{} is empty", key->info.path), where,
                  "every row gives every column");
    const CaseValue value = cell_value(key->info, cells[cell], where);
    apply_value(out.content, *key, value, folder_);
    if (is_number(*key) && !std::holds_alternative<std::string>(value.data)) out.numbers[number] = value.number();
  }
  for (const CaseOverride& change : changes_) apply_assignment(out.content, change, folder_);
  out.content.number = static_cast<int>(index) + 1;
  out.content.where = where;
  if (std::visit([](const auto& content) { return content.history != HistoryUse::start; }, out.content.content))
    throw Error(ErrorKind::configuration, "rows of cases_file do not follow each other in time", where,
                "leave case.history out, or use [[cases]]");
  take_as_told(out.content);
  validate_case(out.content);
  std::vector<Case> alone{std::move(out.content)};
  settle_sequences(alone);
  out.content = std::move(alone.front());
  return out;
}

}  // namespace treadmark::io
