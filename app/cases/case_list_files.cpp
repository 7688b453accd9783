// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "treadmark/app/cases/case_list.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::app {
namespace {

constexpr const char* kTableFormat = "treadmark-cases-1";
constexpr std::string_view kStatusWords[] = {"ok", "no_contact", "not_converged", "failed", "doubtful"};
constexpr std::uint8_t kDoubtful = 4;

std::uint8_t code_of(const ListedResult& row) {
  return row.doubtful() ? kDoubtful : static_cast<std::uint8_t>(row.status);
}

std::string heads_of(const SolvedList& list) {
  std::string line = "case,status";
  for (const io::CaseKey* key : list.given_keys()) line += ',' + key->info.path;
  for (const io::ListedNumber& number : list.numbers()) line += ',' + number.name;
  return line + ",remarks,message\n";
}

std::string line_of(const SolvedList& list, const ListedResult& row) {
  std::string line = fmt::format("{},{}", row.number, row.status_word());
  for (const double value : row.given) line += ',' + io::csv_cell(value, Digits::all);
  for (std::size_t k = 0; k < row.numbers.size(); ++k)
    line += ',' + io::csv_cell(list.numbers()[k].in_file(row.numbers[k], row.shift));
  return line + ',' + io::csv_cell(row.remarks) + ',' + io::csv_cell(row.message) + '\n';
}

/// Counts how cases ended.
class Counts {
 public:
  void add(const ListedResult& row) {
    ++counts_[code_of(row)];
    failed_ = failed_ || row.grave || row.status == Status::failed;
    if (row.message.empty()) return;
    constexpr std::size_t kMostSaid = 10;
    if (said_.size() < kMostSaid)
      said_.push_back(fmt::format("case {}: {}: {}", row.number, row.status_word(), row.message));
    ++messages_;
    longest_ = std::max(longest_, row.message.size());
  }

  std::size_t messages() const { return messages_; }
  std::size_t longest() const { return longest_; }
  ListSummary summary() const {
    ListSummary out;
    for (std::size_t k = 0; k < std::size(kStatusWords); ++k)
      if (counts_[k] > 0) out.statuses.emplace_back(kStatusWords[k], counts_[k]);
    out.said = said_;
    out.failed = failed_;
    out.not_converged = counts_[static_cast<std::size_t>(Status::not_converged)] > 0;
    return out;
  }

 private:
  std::size_t counts_[std::size(kStatusWords)] = {};
  std::size_t messages_ = 0, longest_ = 0;
  bool failed_ = false;
  std::vector<std::string> said_;
};

/// Collects bytes for fewer calls.
class Gathered {
 public:
  explicit Gathered(std::function<void(std::string_view)> write) : write_(std::move(write)) {}
  void add(std::string_view bytes) {
    constexpr std::size_t kEnough = std::size_t{1} << 18;
    text_ += bytes;
    if (text_.size() >= kEnough) flush();
  }
  void flush() {
    write_(text_);
    text_.clear();
  }

 private:
  std::function<void(std::string_view)> write_;
  std::string text_;
};

/// The results as columns of an HDF5 file; of all columns at a time some thousand rows are in memory.
void write_columns(const std::filesystem::path& file, const SolvedList& list, const Counts& counts) {
  using Kind = io::Hdf5Column::Kind;
  const std::size_t rows = list.size();
  std::vector<io::Hdf5Column> columns;
  const auto number = [&](std::string name, std::string unit, std::string meaning, std::size_t count) {
    columns.push_back({std::move(name), std::move(unit), std::move(meaning), Kind::number, count, sizeof(double)});
  };
  number("case", "1", "number in the input", rows);
  for (const io::CaseKey* key : list.given_keys()) {
    const io::KeyUnit unit = io::unit_at_end(key->info.path);
    number(key->info.path.substr(0, key->info.path.size() - unit.ending.size()), std::string(unit.si_name),
           key->info.doc, rows);
  }
  for (const io::ListedNumber& one : list.numbers()) number(one.si_name, std::string(one.unit()), one.meaning, rows);
  const std::size_t numbers = columns.size();
  std::string words;
  for (std::size_t k = 0; k < std::size(kStatusWords); ++k)
    words += fmt::format("{}{} {}", k > 0 ? ", " : "", k, kStatusWords[k]);
  columns.push_back({"status", "1", words, Kind::byte, rows, 1});
  number("message_case", "1", "number of a case that has a message", counts.messages());
  columns.push_back(
      {"message", "1", "what it says", Kind::text, counts.messages(), std::max<std::size_t>(counts.longest(), 1)});
  std::vector<io::Attribute> attributes = io::origin_attributes(kTableFormat, list.head());
  attributes.push_back({"cases_total", list.head().cases_total});
  io::Hdf5ColumnFile out(file, attributes, columns);

  constexpr std::size_t kPiece = 4096;
  std::vector<std::vector<double>> values(numbers);
  std::vector<std::uint8_t> statuses;
  std::size_t first = 0, said = 0;
  const auto flush = [&] {
    for (std::size_t k = 0; k < numbers; ++k) {
      out.write(k, first, values[k]);
      values[k].clear();
    }
    out.write(numbers, first, statuses);
    first += statuses.size();
    statuses.clear();
  };
  list.for_each([&](const ListedResult& row) {
    std::size_t k = 0;
    values[k++].push_back(row.number);
    for (std::size_t i = 0; i < row.given.size(); ++i)
      values[k++].push_back(row.given[i] * io::unit_of_key(list.given_keys()[i]->info.path));
    for (const double value : row.numbers) values[k++].push_back(value);
    statuses.push_back(code_of(row));
    if (!row.message.empty()) {
      const double of_case = row.number;
      out.write(numbers + 1, said, std::span(&of_case, 1));
      out.write(numbers + 2, said++, row.message);
    }
    if (statuses.size() == kPiece) flush();
  });
  flush();
  out.finish();
}

std::string head_text(const SolvedList& list, const ListSummary& summary) {
  io::Json out = io::Json::parse(io::to_json(list.head()));
  out.erase("cases");
  for (const auto& [word, count] : summary.statuses) out["statuses"][word] = count;
  return io::dumped(out) + '\n';
}

}  // namespace

ListSummary write_list(const SolvedList& list, const std::filesystem::path& folder,
                       const std::function<void(std::string_view)>& json, std::vector<std::string>& notes) {
  std::optional<OutputFolder> output;
  std::optional<OutputFile> table;
  if (!folder.empty()) {
    output.emplace(folder, OutputFolder::Old::kept);
    table.emplace(output->path() / "cases.csv");
  }
  Gathered csv([&](std::string_view bytes) { table->write(bytes); }), text(json);
  Counts counts;
  if (table) csv.add(heads_of(list));
  if (json) text.add(io::text_before_cases(list.head()));
  bool first = true;
  list.for_each([&](const ListedResult& row) {
    counts.add(row);
    if (table) csv.add(line_of(list, row));
    if (!json) return;
    if (!std::exchange(first, false)) text.add(io::kBetweenCases);
    text.add(row.json);
  });
  if (json) {
    text.add(io::kBehindCases);
    text.flush();
  }
  const ListSummary summary = counts.summary();
  if (!table) return summary;
  csv.flush();
  table->commit();
  if (has_part("hdf5"))
    write_columns(output->path() / "cases.h5", list, counts);
  else
    notes.push_back(left_out_message("hdf5", "cases.h5") + ": " + left_out_advice("hdf5"));
  write_file(output->path() / "cases.json", head_text(list, summary));
  // what an earlier run of few cases left must not pass for results of these
  std::error_code ignored;
  for (const char* name : {"result.json", "fields.h5", "pressure.svg"}) std::filesystem::remove(folder / name, ignored);
  output->move_into("cases.json");
  return summary;
}

std::string list_summary_text(const ListSummary& summary) {
  std::string text, statuses;
  for (const std::string& said : summary.said) text += said + '\n';
  std::size_t total = 0;
  for (const auto& [word, count] : summary.statuses) {
    statuses += fmt::format("{}{} {}", statuses.empty() ? "" : ", ", count, word);
    total += count;
  }
  return text + fmt::format("{} cases: {}\n", total, statuses);
}

}  // namespace treadmark::app
