// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "treadmark/app/simulation/contact_tables.hpp"
#include "treadmark/app/simulation/defect_depth.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/solvers/vehicle/contacts/chosen_contact.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"

namespace treadmark::app {

/// A vehicle on its track with contact elements at all wheels.
struct BuiltVehicle {
  vehicle::VehicleOnTrack vehicle;
  /// By wheel: the element, where the contact is solved in full; else null.
  std::vector<std::shared_ptr<vehicle::FullContact>> full;
  std::vector<UsedBodies> bodies;  ///< by wheel, as its full contact sees them
  /// Of wheels whose contact is chosen: tables until a simulation begins them.
  std::vector<std::shared_ptr<vehicle::ChosenContact>> chosen;
  /// By wheel; null where its contact is not a full one, or it has no defects.
  std::vector<std::shared_ptr<const DefectDepth>> defect_depth;
  double table_seconds = 0.0;  ///< spent on contact tables
  /// With contact tables at all wheels, for the start in a curve; none where that is not wanted or not possible.
  std::optional<vehicle::VehicleOnTrack> easy;
};

/// "ws1_right"
std::string wheel_name(const io::WheelContactInput& wheel);

/// The shape of a wheel with full contact.
io::SurfaceSource wheel_source(const io::SimulationFile& file, const io::WheelContactInput& wheel);

/// Contact of a wheel as in a case file: its side, radius and rail, whose place is mirrored for a left-hand one.
io::WheelRailCase contact_input(const io::SimulationFile& file, const io::WheelContactInput& wheel);

/// Place of a wheelset along the rails at the start [m].
double rail_place(const io::SimulationFile& file, int wheelset);

/// Builds surfaces, contact tables and equations. Wheels with table contact are round and run on a rail without
/// defects. Errors: those of reading and building surfaces; Error(configuration) for contacts that a simulation cannot
/// have.
/// tables: where contact tables are looked for and kept; null: made anew. progress: told of a table that takes long.
BuiltVehicle build_vehicle(const io::SimulationFile& file, SurfaceStore& store, ContactTables* tables = nullptr,
                           const Progress& progress = {});

/// Finds the errors of build_vehicle without solving contact tables.
void check_vehicle(const io::SimulationFile& file, SurfaceStore& store);

/// What the columns of a history will be, without solving anything. Errors: as build_vehicle, but for those of
/// surfaces.
std::vector<io::HistoryColumn> history_columns(const io::SimulationFile& file);

/// Settings of the integration.
vehicle::SimulationSettings integration_settings(const io::SimulationFile& file);

}  // namespace treadmark::app
