// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/detector.hpp"

#include <mutex>
#include <shared_mutex>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/contact_search.hpp"
#include "treadmark/model/backend_name.hpp"

namespace treadmark::detection {
namespace {

DetectorRow search_row(std::string name, std::string summary, SearchMethod method) {
  return {std::move(name), std::move(summary), [method](const BodyPair& bodies, SearchSettings settings) {
            settings.method = method;
            settings.locus_rows.reset();
            return std::make_unique<ContactSearch>(bodies, settings);
          }};
}

class Registry {
 public:
  static Registry& the() {
    static Registry registry;
    return registry;
  }

  void add(DetectorRow row) {
    const auto refuse = [&](const char* why) {
      throw Error(ErrorKind::configuration, "the detector '" + row.name + "' " + why);
    };
    if (!is_backend_name(row.name)) refuse("has a name that no case file could hold");
    if (row.summary.empty() || !row.make) refuse("has no summary, or makes nothing");
    const std::unique_lock lock(mutex_);
    for (const auto& known : rows_)
      if (known->name == row.name) refuse("exists already");
    rows_.push_back(std::make_unique<const DetectorRow>(std::move(row)));
  }

  std::vector<const DetectorRow*> all() const {
    const std::shared_lock lock(mutex_);
    std::vector<const DetectorRow*> out;
    for (const auto& row : rows_) out.push_back(row.get());
    return out;
  }

 private:
  Registry() {
    add(search_row("grid",
                   "a grid over the rail, evaluated where bounds do not rule contact out, and finer grids on "
                   "what it finds",
                   SearchMethod::pruned_grid));
    add(search_row("full_grid", "the same with every point of the grid evaluated", SearchMethod::full_grid));
    add(search_row("locus", "where the wheel's circles come closest to a rail that does not change along the track",
                   SearchMethod::locus));
  }

  mutable std::shared_mutex mutex_;
  std::vector<std::unique_ptr<const DetectorRow>> rows_;
};

}  // namespace

void register_detector(DetectorRow row) { Registry::the().add(std::move(row)); }

std::vector<const DetectorRow*> detectors() { return Registry::the().all(); }

const DetectorRow& detector_of(std::string_view name) {
  const std::vector<const DetectorRow*> all = detectors();
  const auto found = ranges::find(all, name, &DetectorRow::name);
  if (found != all.end()) return **found;
  std::vector<std::string> names;
  for (const DetectorRow* row : all) names.push_back(row->name);
  throw Error(ErrorKind::configuration, "there is no detector '" + std::string(name) + "'", {},
              advice_on_name(name, names));
}

}  // namespace treadmark::detection
