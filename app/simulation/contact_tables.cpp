// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/contact_tables.hpp"

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::app {

ContactTables::Table ContactTables::get(const std::string& bodies, const wheelrail::Problem& prototype, double load,
                                        const std::function<Table()>& make) {
  const wheelrail::Problem wanted = vehicle::table_problem(prototype);
  Entry* entry = nullptr;
  {
    const std::lock_guard lock(mutex_);
    auto found = ranges::find_if(
        entries_, [&](const Entry& e) { return e.bodies == bodies && e.load == load && e.made_for == wanted; });
    if (found == entries_.end()) {
      found = entries_.emplace(entries_.end());
      found->bodies = bodies;
      found->made_for = wanted;
      found->load = load;
    }
    entry = &*found;
  }
  const std::lock_guard lock(entry->making);
  if (!entry->table) entry->table = make();
  return entry->table;
}

std::shared_ptr<const vehicle::CreepTable> ContactTables::creep(
    double poisson, const std::function<void(std::size_t finished, std::size_t all)>& report) {
  const std::lock_guard lock(making_creep_);
  auto& table = creep_[poisson];
  if (!table) table = kept_creep_table(cache(), poisson, {}, report);
  return table;
}

}  // namespace treadmark::app
