// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "treadmark/app/simulation/kept_tables.hpp"

namespace treadmark::app {

/// Tables of contacts and creep forces by what they were made from: runs that differ in speed or track only share one.
/// Thread-safe; who asks for a table that another thread is making waits for it.
class ContactTables {
 public:
  using Table = std::shared_ptr<const vehicle::ContactTable>;

  /// cache: where tables are kept from process to process.
  explicit ContactTables(std::optional<io::ContentCache> cache = {}) : cache_(std::move(cache)) {}
  const io::ContentCache* cache() const { return cache_ ? &*cache_ : nullptr; }

  /// bodies: content keys of both surfaces; prototype, load: as for vehicle::build_contact_table. make: called where no
  /// table fits; its errors pass through, and the next one who asks tries again.
  Table get(const std::string& bodies, const wheelrail::Problem& prototype, double load,
            const std::function<Table()>& make);

  /// The table of the exact theory's creep forces. report: as for vehicle::build_creep_table.
  std::shared_ptr<const vehicle::CreepTable> creep(
      double poisson, const std::function<void(std::size_t finished, std::size_t all)>& report = {});

 private:
  struct Entry {
    std::string bodies;
    wheelrail::Problem made_for;
    double load;
    std::mutex making;
    Table table;
  };

  std::optional<io::ContentCache> cache_;
  std::mutex mutex_;
  std::list<Entry> entries_;
  std::mutex making_creep_;
  std::map<double, std::shared_ptr<const vehicle::CreepTable>> creep_;  ///< by Poisson's ratio
};

}  // namespace treadmark::app
