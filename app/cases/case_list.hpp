// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_rows.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/files/part_log.hpp"
#include "treadmark/io/results/listed_number.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

class CaseSequence;

/// A file with more cases is run as a list: numbers of every case, and no fields of patches.
inline constexpr std::size_t kLongList = 1000;

/// What is wanted of the cases of a list.
struct ListOptions {
  std::vector<std::string> numbers;   ///< by their names in results (io/results/listed_number.hpp); empty: usual ones
  std::filesystem::path kept;         ///< where finished rows are kept while the work goes on; empty: a nameless file
  bool json = false;                  ///< whether all of every case is wanted as JSON, too
  std::vector<std::string> settings;  ///< echo of overrides
};

/// A case of a list, solved.
struct ListedResult {
  int number = 0;
  Status status = Status::ok;
  bool grave = false;           ///< a remark says that numbers may be wrong
  bool shift = false;           ///< creepages are lengths, power is work
  std::string message;          ///< why it is not ok, and grave remarks
  std::string remarks;          ///< names of all remarks, with blanks between them
  std::vector<double> given;    ///< numbers of the row of a table, in the units of their keys
  std::vector<double> numbers;  ///< SI; NaN: not known
  std::string json;             ///< as it stands in result.json; empty unless asked for

  bool doubtful() const { return grave && status == Status::ok; }
  std::string_view status_word() const { return doubtful() ? "doubtful" : to_string(status); }
};

/// Any number of cases, solved on all threads, whose results stand in a file: memory does not grow with their number,
/// but for some bytes every 64 cases. Results do not depend on threads, nor on how often the work was interrupted.
class SolvedList {
 public:
  /// Solves what is not kept yet. Cases that go on from the one before them are solved in order, all others by
  /// themselves. A case that cannot be solved, for whatever reason, has Status::failed and its message; the others go
  /// on. After a stop request Cancelled is thrown once finished rows are kept (of sequences in time: whole ones); a
  /// kill costs those of the last second. progress gets the number found, with an empty text, first. Errors: Error for
  /// geometry that cannot be read, names that are no numbers of results, and files that cannot be written, or where
  /// rows of something else are kept.
  SolvedList(io::ListedCases given, SurfaceStore& store, const ListOptions& options, const Progress& progress);
  ~SolvedList();

  const io::RunResult& head() const { return head_; }  ///< where results come from; without cases
  std::size_t size() const { return size_; }
  std::size_t found() const { return found_; }  ///< cases that were finished before
  const std::vector<const io::CaseKey*>& given_keys() const { return given_keys_; }
  const std::vector<io::ListedNumber>& numbers() const { return numbers_; }

  /// All results in the order of the cases. A check point before each.
  void for_each(const std::function<void(const ListedResult&)>& visit) const;
  /// Removes what was kept: the results are written elsewhere.
  void forget() { log_->remove(); }

 private:
  class Source;
  struct ListedCase;
  std::size_t begun(std::size_t part) const;
  /// Rows of a part that are in the log.
  std::size_t kept_of(std::size_t part) const;
  void solve(std::size_t part) const;
  ListedResult solved(const ListedCase& one, CaseSequence& sequence) const;

  io::RunResult head_;
  std::size_t size_ = 0, found_ = 0;
  bool json_ = false;
  std::vector<const io::CaseKey*> given_keys_;
  std::vector<io::ListedNumber> numbers_;
  std::unique_ptr<const Source> source_;
  std::unique_ptr<io::PartLog> log_;
};

/// How the cases of a list ended.
struct ListSummary {
  std::vector<std::pair<std::string, std::size_t>> statuses;  ///< word and number of cases
  std::vector<std::string> said;                              ///< about the first ones that did not end as ok
  bool failed = false, not_converged = false;                 ///< failed: grave remarks count, of any status
};

/// Writes results in one go, with little memory: into the folder, unless its name is empty, cases.csv, cases.h5 and,
/// last, cases.json (where they come from, and the summary); to json, unless it is empty, all of every case as
/// result.json has it. Returns the summary; notes gets what this build leaves out. Throws Cancelled after a stop
/// request of the scope that holds; then nothing is written.
ListSummary write_list(const SolvedList& list, const std::filesystem::path& folder,
                       const std::function<void(std::string_view)>& json, std::vector<std::string>& notes);

/// The summary as text.
std::string list_summary_text(const ListSummary& summary);

}  // namespace treadmark::app
