// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "treadmark/solvers/vehicle/contact_table.hpp"

namespace treadmark::app {

/// Contact tables by what they were made from: runs that differ in speed or track only share one. Thread-safe; who
/// asks for a table that another thread is making waits for it.
class ContactTables {
 public:
  using Table = std::shared_ptr<const vehicle::ContactTable>;

  /// bodies: content keys of both surfaces; prototype, load: as for vehicle::build_contact_table. make: called where no
  /// table fits; its errors pass through, and the next one who asks tries again.
  Table get(const std::string& bodies, const wheelrail::Problem& prototype, double load,
            const std::function<Table()>& make);

 private:
  struct Entry {
    std::string bodies;
    wheelrail::Problem made_for;
    double load;
    std::mutex making;
    Table table;
  };

  std::mutex mutex_;
  std::list<Entry> entries_;
};

}  // namespace treadmark::app
