// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>
#include <mutex>

#include "treadmark/app/lists/result_list.hpp"
#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;
using io::Json;
using Clock = std::chrono::steady_clock;

constexpr const char* kFormat = "treadmark-unfinished-list-1";
constexpr std::chrono::seconds kInterval{5};  // a kill costs this much work at most

/// Rows that are finished, by what they were made from.
class KeptRows {
 public:
  explicit KeptRows(fs::path file) : file_(std::move(file)) {
    if (file_.empty() || !fs::exists(file_)) return;
    try {
      const io::JsonTree tree = io::read_json_file(file_);
      if (tree.text("format") != kFormat) tree.refuse("it has another format");
      for (const io::JsonTree& kept : tree.at("rows").items()) {
        ListRow row{kept.text("name"),        kept.text("status"),          {},
                    kept.at("words").texts(), kept.at("numbers").numbers(), kept.number("badness"),
                    kept.text("document")};
        rows_.emplace(kept.text("key"), std::move(row));
      }
    } catch (const Error& error) {
      throw Error(ErrorKind::configuration, "this is no unfinished list of treadmark: " + error.message(),
                  {file_.string()}, "move it away: rows that are finished are kept here");
    }
  }

  /// What was kept before this call: it does not change.
  const ListRow* find(const std::string& key) const {
    const auto found = rows_.find(key);
    return found == rows_.end() ? nullptr : &found->second;
  }

  void add(const std::string& key, const ListRow& row) {
    const std::scoped_lock lock(mutex_);
    made_.emplace_back(key, row);
    if (Clock::now() - last_ < kInterval) return;
    write();
    last_ = Clock::now();
  }

  void write() const {
    if (file_.empty() || made_.empty()) return;
    Json out{{"format", kFormat}, {"rows", Json::array()}};
    const auto add_row = [&](const std::string& key, const ListRow& row) {
      out["rows"].push_back({{"key", key},
                             {"name", row.name},
                             {"status", row.status},
                             {"words", row.words},
                             {"numbers", row.numbers},
                             {"badness", row.badness},
                             {"document", row.document}});
    };
    for (const auto& [key, row] : rows_) add_row(key, row);
    for (const auto& [key, row] : made_) add_row(key, row);
    write_file(file_, io::dumped(out, -1) + '\n');
  }

 private:
  fs::path file_;
  std::map<std::string, ListRow> rows_;                ///< found
  std::vector<std::pair<std::string, ListRow>> made_;  ///< since then
  std::mutex mutex_;
  Clock::time_point last_ = Clock::now();
};

/// Everything that a row is made from; empty where that is not known: files that cannot be read, or name others.
std::string key_of(const ResultList& list, const ListWork& work, std::size_t i) try {
  std::string all =
      fmt::format("{} {}\n{}{}\n{}\n", version(), git_revision(), plugin_identity(), list.title, list.settings);
  for (const std::string& source : work.sources(i)) {
    const std::string extension = io::extension_of(source);
    if (extension == ".toml" || extension == ".inp" || io::can_hold(source, io::kSlicesFile)) return {};
    std::error_code ignored;
    all += source + (fs::is_regular_file(source, ignored) ? ' ' + io::sha256_file(source) : std::string()) + '\n';
  }
  return io::sha256_hex(all);
} catch (const Error&) {
  return {};
}

ListRow made_row(const ListWork& work, std::size_t i) {
  try {
    return work.make(i);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    return {work.name(i), "failed", error.what()};
  }
}

}  // namespace

std::size_t ResultList::failed() const {
  return static_cast<std::size_t>(ranges::count_if(rows, [](const ListRow& row) { return !row.error.empty(); }));
}

std::vector<const ListRow*> ResultList::worst_first() const {
  std::vector<const ListRow*> out;
  for (const ListRow& row : rows) out.push_back(&row);
  const auto rank = [](const ListRow* row) {
    return !row->error.empty() ? HUGE_VAL : std::isnan(row->badness) ? -HUGE_VAL : row->badness;
  };
  ranges::stable_sort(out, std::greater<>(), rank);
  return out;
}

void make_rows(ResultList& list, const ListWork& work, const fs::path& kept, const Progress& progress) {
  KeptRows finished(kept);
  list.rows.assign(work.count, {});
  std::vector<std::string> keys(work.count);
  std::vector<std::size_t> wanted;  // the others are finished
  if (!kept.empty()) parallel_for(work.count, [&](std::size_t i) { keys[i] = key_of(list, work, i); });
  for (std::size_t i = 0; i < work.count; ++i)
    if (const ListRow* row = keys[i].empty() ? nullptr : finished.find(keys[i]))
      list.rows[i] = *row;
    else
      wanted.push_back(i);
  std::size_t count = 0;
  std::mutex reporting;
  try {
    parallel_for(wanted.size(), [&](std::size_t k) {
      const std::size_t i = wanted[k];
      if (progress.stop_requested()) throw Cancelled();
      list.rows[i] = made_row(work, i);
      if (!keys[i].empty() && list.rows[i].error.empty()) finished.add(keys[i], list.rows[i]);
      const std::scoped_lock lock(reporting);
      if (progress.report) progress.report(++count, wanted.size(), list.rows[i].name);
    });
  } catch (...) {
    finished.write();
    throw;
  }
}

}  // namespace treadmark::app
