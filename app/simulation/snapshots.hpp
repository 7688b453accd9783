// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Contact fields at chosen instants of the wheels with full contact: kept as what it takes to solve the instant again.
class Snapshots {
 public:
  Snapshots(const io::SimulationFile& file, const BuiltVehicle& built) : file_(file), built_(built) {}

  /// The instant at the start, of every wheel.
  void take_start(const vehicle::Simulation& simulation);
  /// Where a wheelset has passed one of the requested pitch angles, or a requested position, since `before`.
  void take_passed(const vehicle::Simulation& simulation, const vehicle::SystemState& before);

  bool wanted() const { return !file_.fields.pitch.empty() || !file_.fields.position.empty(); }

  void save(ByteWriter& out) const;
  void restore(ByteReader& in);

  /// Solves the instants again: a case each, in order of time. times: of the cases [s].
  io::RunResult results(std::vector<double>& times) const;

 private:
  struct Kept {
    std::size_t wheel = 0;
    vehicle::FullContact::Instant instant;
  };
  void keep(std::size_t wheel);

  const io::SimulationFile& file_;
  const BuiltVehicle& built_;
  std::vector<Kept> kept_;
};

}  // namespace treadmark::app
