// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <vector>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::app {

/// What is written down of a simulation at every instant: time and place, forces of the wheels (of those with full
/// contact also what their patches are like), motions of all bodies, energies. The columns of the watched wheel have no
/// prefix.
class HistoryRecord {
 public:
  HistoryRecord(const BuiltVehicle& built, const vehicle::Simulation& simulation);

  std::vector<io::HistoryColumn> columns() const;
  /// Appends the present instant.
  void append(std::vector<double>& values) const;

 private:
  struct Column {
    io::HistoryColumn head;
    std::function<double()> value;
  };
  void add(std::string name, std::string unit, std::string description, std::function<double()> value);
  void add_wheel(std::size_t wheel, const std::string& prefix, bool full);
  void add_bodies();
  void add_energies();

  const vehicle::Simulation& simulation_;
  std::vector<Column> columns_;
};

}  // namespace treadmark::app
