// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::app {

/// A wheel and its rail at an instant as a case that stands alone: steady rolling at the height of the wheelset.
io::WheelRailCase input_of(const io::SimulationFile& file, std::size_t wheel, const vehicle::PairMotion& motion);

/// Contact fields at chosen instants of the wheels with full contact: kept as what it takes to solve the instant again.
class Snapshots {
 public:
  Snapshots(const io::SimulationFile& file, const BuiltVehicle& built) : file_(file), built_(built) {}

  /// The instant at the start, of every wheel.
  void take_start();
  /// Where a wheelset has passed one of the requested pitch angles, or a requested position, since `before`.
  void take_passed(const vehicle::Simulation& simulation, const vehicle::SystemState& before);

  bool wanted() const { return !file_.fields.pitch.empty() || !file_.fields.position.empty(); }

  void save(ByteWriter& out) const;
  void restore(ByteReader& in);

  /// Solves the instants again: snapshots, a case each in order of time, with their times, scenes and sampled surfaces.
  void put_results(io::SimulationResult& result) const;

 private:
  struct Kept {
    std::size_t wheel = 0;
    std::vector<std::size_t> angles;  ///< which of the requested pitch angles it is for
    bool at_position = false;         ///< it is for a requested position
    vehicle::FullContact::Instant instant;
  };
  void describe_scenes(io::SimulationResult& result) const;
  std::vector<double> depth_of(const Kept& kept, const Grid2& grid, const wheelrail::PairSolution& solution) const;

  const io::SimulationFile& file_;
  const BuiltVehicle& built_;
  std::vector<Kept> kept_;
};

}  // namespace treadmark::app
