// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/case_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "treadmark/app/cases/case_sequence.hpp"
#include "treadmark/app/cases/run_parts.hpp"
#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/results/write_json.hpp"

namespace treadmark::app {
namespace {

using io::CaseRows;
using Geometry = wheelrail::Geometry;
using SteadyClock = std::chrono::steady_clock;

std::string si_name(const io::CaseKey& key) {
  return key.info.path.substr(0, key.info.path.size() - io::unit_at_end(key.info.path).ending.size());
}

bool is_shift(const io::Case& c) {
  return std::visit([](const auto& content) { return content.regime == Regime::shift; }, c.content);
}

void put(ByteWriter& out, const ListedResult& row) {
  out.put(row.number);
  out.put(row.status);
  out.put(row.grave);
  out.put(row.shift);
  for (const std::string* text : {&row.message, &row.remarks, &row.json}) out.put(*text);
  out.put(row.given);
  out.put(row.numbers);
}

std::vector<ListedResult> rows_in(std::span<const std::byte> bytes) {
  std::vector<ListedResult> out;
  for (ByteReader in(bytes); !in.at_end();) {
    ListedResult& row = out.emplace_back();
    in.get(row.number);
    in.get(row.status);
    in.get(row.grave);
    in.get(row.shift);
    for (std::string* text : {&row.message, &row.remarks, &row.json}) in.get(*text);
    in.get(row.given);
    in.get(row.numbers);
  }
  return out;
}

/// Files of a case beside its surfaces.
void add_hashes(const io::InfluenceInput& influence, std::string& identity) {
  if (influence.kind == InfluenceSettings::Kind::table) identity += io::sha256_file(influence.file) + '\n';
}

}  // namespace

/// A case of a part, and what it is solved with.
struct SolvedList::ListedCase {
  io::Case content;
  std::vector<double> given;
  const Geometry* geometry;  ///< null: of a patch
  const io::Case* judged;    ///< with the same surfaces: its profiles were judged
};

/// Cases in parts of about as many as a block of rows; those of a sequence in time are in one part.
class SolvedList::Source {
 public:
  Source(io::ListedCases given, SurfaceStore& store)
      : file_(std::move(given.file)), rows_(std::move(given.rows)), notes_(profiles_, store) {
    const SampledRegions regions = rows_ != nullptr ? regions_of_rows() : sampled_regions(file_);
    for (const io::Case& c : file_.cases) {
      check_cancelled();
      const auto* input = std::get_if<io::WheelRailCase>(&c.content);
      geometries_.push_back(input != nullptr ? std::optional(geometry_of(*input, store, regions)) : std::nullopt);
    }
    profiles_ = check_profiles_of_run(file_);
    if (rows_ == nullptr) divide();
  }

  std::size_t cases() const { return rows_ != nullptr ? rows_->size() : file_.cases.size(); }
  std::size_t parts() const { return rows_ != nullptr ? rows_->blocks() : groups_.size(); }
  std::size_t size_of(std::size_t part) const {
    if (rows_ != nullptr) return std::min(CaseRows::kBlock, rows_->size() - part * CaseRows::kBlock);
    std::size_t count = 0;
    for (const auto& group : groups_[part]) count += group.size();
    return count;
  }
  std::size_t part_of(std::size_t i) const { return rows_ != nullptr ? i / CaseRows::kBlock : part_of_[i]; }

  /// Groups of cases that follow each other in time.
  std::vector<std::vector<ListedCase>> part(std::size_t k) const {
    std::vector<std::vector<ListedCase>> out;
    if (rows_ != nullptr) {
      const Geometry* geometry = geometries_.front() ? &*geometries_.front() : nullptr;
      for (io::CaseRow& row : rows_->block(k))
        out.emplace_back().push_back({std::move(row.content), std::move(row.numbers), geometry, &file_.cases.front()});
      return out;
    }
    for (const auto& group : groups_[k]) {
      out.emplace_back();
      for (const std::size_t i : group)
        out.back().push_back({file_.cases[i], {}, geometries_[i] ? &*geometries_[i] : nullptr, &file_.cases[i]});
    }
    return out;
  }

  const ProfilesOfRun& profiles() const { return profiles_; }
  SolverPool& pool() const { return pool_; }
  ResultNotes& notes() const { return notes_; }

 private:
  SampledRegions regions_of_rows() const {
    const auto* first = std::get_if<io::WheelRailCase>(&file_.cases.front().content);
    if (first == nullptr) return {};
    for (const io::SurfaceSource* source : {&first->rail, &first->wheel}) refuse_one_place(*source, "a table of cases");
    RegionsOfCases all;
    all.add(*first);
    if (!is_sampled(first->rail) && !is_sampled(first->wheel)) return all.regions();
    for (std::size_t k = 0; k < rows_->blocks(); ++k) {
      check_cancelled();
      for (const io::CaseRow& row : rows_->block(k)) all.add(std::get<io::WheelRailCase>(row.content.content));
    }
    return all.regions();
  }

  void divide() {
    part_of_.resize(file_.cases.size());
    std::size_t room = 0;
    for (std::vector<std::size_t>& group : groups_in_time(file_)) {
      if (room == 0) {
        groups_.emplace_back();
        room = CaseRows::kBlock;
      }
      for (const std::size_t i : group) part_of_[i] = static_cast<std::uint32_t>(groups_.size() - 1);
      room -= std::min(room, group.size());
      groups_.back().push_back(std::move(group));
    }
  }

  io::CaseFile file_;
  std::shared_ptr<const CaseRows> rows_;
  std::vector<std::optional<Geometry>> geometries_;  ///< of the cases of the file
  std::vector<std::vector<std::vector<std::size_t>>> groups_;
  std::vector<std::uint32_t> part_of_;
  ProfilesOfRun profiles_;
  mutable SolverPool pool_;
  mutable ResultNotes notes_;
};

SolvedList::~SolvedList() = default;

SolvedList::SolvedList(io::ListedCases given, SurfaceStore& store, const ListOptions& options, const Progress& progress)
    : json_(options.json) {
  const CancellationScope scope(progress.stop);
  const auto start = SteadyClock::now();
  const bool wheel_on_rail = ranges::any_of(given.file.cases, [](const io::Case& c) { return c.content.index() == 0; });
  if (given.rows) given_keys_ = given.rows->numbers();
  for (const std::string& name : options.numbers) {
    if (ranges::find(numbers_, name, &io::ListedNumber::name) != numbers_.end())
      throw Error(ErrorKind::configuration, fmt::format("{} stands twice among the numbers of the list", name));
    numbers_.push_back(io::listed_number(name));
  }
  if (numbers_.empty()) numbers_ = io::usual_numbers(wheel_on_rail);
  std::erase_if(numbers_, [&](const io::ListedNumber& number) {  // what rows give is there, in their unit
    return ranges::any_of(given_keys_, [&](const io::CaseKey* key) { return si_name(*key) == number.si_name; });
  });

  store.begin_run();
  head_ = head_of(given.file);
  std::string files;
  for (const io::Case& c : given.file.cases)
    std::visit([&](const auto& content) { add_hashes(content.influence, files); }, c.content);
  const std::shared_ptr<const CaseRows> rows = given.rows;
  source_ = std::make_unique<const Source>(std::move(given), store);
  size_ = source_->cases();
  head_.cases_total = static_cast<int>(size_);
  head_.complete = true;
  head_.settings = options.settings;
  head_.doubts = profile_doubts(source_->profiles());
  head_.geometry_sha256 = store.hashes();
  if (rows) head_.geometry_sha256.emplace_back(rows->file().string(), rows->sha256());

  std::string identity = fmt::format("{} {}\n{}{}\n{}\n{}", head_.version, head_.git, plugin_identity(),
                                     head_.input_sha256, options.json, files);
  for (const std::string& setting : options.settings) identity += setting + '\n';
  for (const auto& [file, hash] : head_.geometry_sha256) identity += fmt::format("{} {}\n", file, hash);
  for (const io::ListedNumber& number : numbers_) identity += number.name + '\n';
  log_ = std::make_unique<io::PartLog>(options.kept, identity);

  std::vector<std::size_t> wanted;
  for (std::size_t k = 0; k < source_->parts(); ++k) {
    found_ += kept_of(k);
    if (!log_->has(k)) wanted.push_back(k);
  }
  std::mutex reporting;
  std::size_t finished = found_;
  if (progress.report) progress.report(finished, size_, "");
  parallel_for(wanted.size(), [&](std::size_t i) {
    const std::size_t fresh = source_->size_of(wanted[i]) - kept_of(wanted[i]);
    solve(wanted[i]);
    const std::lock_guard lock(reporting);
    finished += fresh;
    if (progress.report) progress.report(finished, size_, "cases");
  });
  head_.surfaces = store.uses();
  head_.seconds = std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// Where groups of a part stand that are finished while the part is not.
std::size_t SolvedList::begun(std::size_t part) const { return source_->parts() + part; }

std::size_t SolvedList::kept_of(std::size_t part) const {
  if (log_->has(part)) return source_->size_of(part);
  return log_->has(begun(part)) ? rows_in(log_->content(begun(part))).size() : 0;
}

void SolvedList::solve(std::size_t part) const {
  using namespace std::chrono_literals;
  constexpr SteadyClock::duration kOften = 1s;  // what a kill may cost
  std::size_t kept = kept_of(part);
  std::vector<std::byte> done;
  if (kept > 0) done = log_->content(begun(part));
  SteadyClock::time_point last = SteadyClock::now();
  try {
    for (const std::vector<ListedCase>& group : source_->part(part)) {
      if (kept > 0) {
        kept -= group.size();
        continue;
      }
      CaseSequence sequence(source_->pool());
      ByteWriter rows;
      for (const ListedCase& one : group) put(rows, solved(one, sequence));
      done.insert(done.end(), rows.bytes().begin(), rows.bytes().end());
      if (SteadyClock::now() - last < kOften) continue;
      log_->add(begun(part), done);
      last = SteadyClock::now();
    }
  } catch (const Cancelled&) {
    if (!done.empty()) log_->add(begun(part), done);
    throw;
  }
  log_->add(part, done);
}

ListedResult SolvedList::solved(const ListedCase& one, CaseSequence& sequence) const {
  check_cancelled();
  const auto start = SteadyClock::now();
  io::CaseResult result;
  try {
    result = sequence.solve(one.content, one.geometry);
  } catch (const Error& error) {
    result = {};
    result.status = Status::failed;
    result.message = error.what();
  }
  result.number = one.content.number;
  result.shown = one.content.shown;
  if (!result.shown) result.patches.clear();
  source_->notes().add(*one.judged, one.content, result);
  result.seconds = std::chrono::duration<double>(SteadyClock::now() - start).count();
  ListedResult row;
  row.number = result.number;
  row.status = result.status;
  row.grave = any_grave(result.remarks);
  row.shift = is_shift(one.content);
  row.message = with_grave(result.message, result.remarks);
  for (const Remark& remark : result.remarks)
    row.remarks += (row.remarks.empty() ? "" : " ") + std::string(remark.row().name);
  row.given = one.given;
  for (const io::ListedNumber& number : numbers_) row.numbers.push_back(number.si(result));
  if (json_) row.json = io::case_text(result);
  return row;
}

void SolvedList::for_each(const std::function<void(const ListedResult&)>& visit) const {
  struct Open {
    std::vector<ListedResult> rows;
    std::size_t next = 0;
  };
  std::map<std::size_t, Open> open;  // as many parts as there are sequences beside each other
  for (std::size_t i = 0; i < size_; ++i) {
    check_cancelled();
    const std::size_t part = source_->part_of(i);
    const auto [place, fresh] = open.try_emplace(part);
    Open& at = place->second;
    if (fresh) {
      at.rows = rows_in(log_->content(part));
      ranges::sort(at.rows, {}, &ListedResult::number);
    }
    visit(at.rows.at(at.next++));
    if (at.next == at.rows.size()) open.erase(place);
  }
}

}  // namespace treadmark::app
