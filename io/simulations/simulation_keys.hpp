// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/io/settings/key_words.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::io {

/// Where one of the settings is in a simulation file.
template <class Value>
auto setting(Value SimulationSettings::*member) {
  return [member](auto& file) -> auto& { return file.settings.*member; };
}

/// [simulation] and its tables.
const KeyTable<SimulationFile>& simulation_keys();
const KeyTable<TrainPart>& train_keys();
const KeyTable<SpeedProfile>& speed_profile_keys();
const KeyTable<FreeRun>& free_run_keys();
const KeyTable<AxleTorque>& torque_keys();
const KeyTable<BodyForce>& force_keys();
const KeyTable<SpringMotion>& spring_motion_keys();
const KeyTable<RailShift>& rail_shift_keys();
const KeyTable<TwistTest>& twist_keys();
const KeyTable<FieldRequests>& field_keys();
const KeyTable<WheelContactInput>& wheel_keys();
const KeyTable<CheckRailInput>& check_rail_keys();
const KeyTable<PointInput>& point_keys();

/// [assessment] and [[assessment.sections]] beside [simulation].
const KeyTable<AssessmentRequest>& assessment_keys();
const KeyTable<AssessmentSection>& section_keys();

/// What a simulation asks for, in words and units, for people. Thread-safe.
Inputs inputs_of(const SimulationFile& file);

/// JSON Schemas (draft 2020-12) of the files.
std::string vehicle_file_schema();
std::string track_file_schema();
std::string simulation_file_schema();
std::string study_file_schema();
std::string evolve_file_schema();
std::string design_file_schema();
std::string limits_file_schema();

/// All keys as Markdown tables (docs/simulation-files.md, docs/evolve.md, docs/design.md, docs/assessment.md); tables
/// that a track shares with a vehicle once.
std::string vehicle_key_table();
std::string track_key_table();
std::string simulation_key_table();
std::string study_key_table();
std::string limits_key_table();
std::string evolve_key_table();
std::string design_key_table();

}  // namespace treadmark::io
