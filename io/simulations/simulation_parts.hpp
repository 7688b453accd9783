// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/io/simulations/table_reader.hpp"

namespace treadmark::io {

/// Parts of the reader of simulation files. Error(configuration) at the place of what is wrong.

/// [simulation] but for its tables.
SimulationSettings read_settings(const TableReader& simulation);
FieldRequests read_fields(const TableReader& simulation);
/// One entry for every wheel of the vehicle.
std::vector<WheelContactInput> read_wheels(const TableReader& simulation, std::size_t wheelsets);

/// Everything outside of [simulation]: the keys of a case file.
struct ContactPart {
  CaseTable tables;
  std::vector<std::string> overrides;
  std::filesystem::path name;
};
/// Refuses keys that a simulation finds itself, and reads the rest into out.contact and out.notes; out.vehicle and
/// out.settings are set.
void read_contact(const ContactPart& part, SimulationFile& out);
/// [simulation.other_wheel] into out.other_wheel; out.contact and out.wheels are set.
void read_other_wheel(const ContactPart& part, const TableReader& simulation, SimulationFile& out);

}  // namespace treadmark::io
