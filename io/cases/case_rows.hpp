// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// A case that a row of a table makes, and the numbers that the row gives, in the units of their keys.
struct CaseRow {
  Case content;
  std::vector<double> numbers;  ///< in the order of the columns, CaseRows::numbers()
};

/// The cases of a table (cases_file): the first line names keys of case files, every other one that is not empty and
/// no comment (#) is a case by itself, which starts from rest. Rows stay in their file until they are asked for, so
/// that there may be any number of them. Immutable; thread-safe.
class CaseRows {
 public:
  /// common: what the rows share; changes: what is set in every row after all else. All rows are read and checked once.
  /// Errors: Error(configuration) with file and line, of several the first; Error(input_data) for what is no text, as
  /// lines without end (io/points/line_blocks.hpp).
  CaseRows(std::filesystem::path file, Case common, std::filesystem::path folder, std::vector<CaseOverride> changes);

  std::size_t size() const { return count_; }
  const std::filesystem::path& file() const { return file_; }
  const std::string& sha256() const { return sha256_; }
  /// The keys with a number in every row which that row has: no change takes its place.
  const std::vector<const CaseKey*>& numbers() const { return numbers_; }
  /// The columns whose place changes take.
  const std::vector<std::string>& overridden() const { return overridden_; }

  /// So many rows belong together in reading.
  static constexpr std::size_t kBlock = 64;
  std::size_t blocks() const { return blocks_.size(); }
  /// Errors: as above, where the file has changed since.
  std::vector<CaseRow> block(std::size_t k) const;

 private:
  struct Place {
    std::uint64_t offset;
    int line;
    std::uint64_t sum;  ///< of the rows, by which it is known that they are still the same
  };
  struct Column {
    const CaseKey* key;
    std::size_t cell;                   ///< its place in the line
    std::optional<std::size_t> number;  ///< among numbers()
  };

  void index();
  bool is_overridden(const CaseKey& key) const;
  void take_heads(std::string_view line, int number);
  CaseRow row(std::string_view line, std::size_t index, int line_number) const;
  SourcePosition at(int line) const { return {file_.string(), line, 0}; }

  std::filesystem::path file_;
  Case common_;
  std::filesystem::path folder_;
  std::vector<CaseOverride> changes_;
  std::vector<Column> columns_;  ///< in the order in which keys are applied
  std::vector<const CaseKey*> numbers_;
  std::vector<std::string> heads_, overridden_;
  std::vector<Place> blocks_;
  std::size_t count_ = 0;
  std::string sha256_;
};

}  // namespace treadmark::io
