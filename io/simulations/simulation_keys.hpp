// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/settings/key_list.hpp"
#include "treadmark/io/simulations/evolution_model.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::io {

/// The keys of one table of vehicle, track, simulation and study files, by name. The reader (TableReader), the schemas
/// and docs/simulation-files.md come from them. Immutable; safe to use from several threads.
using TableKeys = std::vector<KeyInfo>;

inline constexpr double kMostValues = 100000;  ///< of a variation, and runs of a study
inline constexpr double kMostSeats = 5000;     ///< of a flexible track

/// The tables of vehicle and of track files, with the keys of each.
const TableKeys& vehicle_tables();
const TableKeys& track_tables();
const TableKeys& vehicle_keys();
const TableKeys& track_keys();
/// Of a flexible track: [rail], [seats], [[varied]], [[joints]] and [lateral].
const TableKeys& rail_beam_keys();
const TableKeys& seat_keys();
const TableKeys& varied_seat_keys();
const TableKeys& joint_keys();
const TableKeys& lateral_keys();
const TableKeys& body_keys();
const TableKeys& place_keys();
const TableKeys& spring_keys();
const TableKeys& bump_stop_keys();
const TableKeys& wheelset_keys();
/// Of [[axles]], [[axles.bending]] and [[axles.torsion]].
const TableKeys& axle_keys();
const TableKeys& bending_keys();
const TableKeys& torsion_keys();

/// Keys of [simulation] that are one member of SimulationSettings each, in the order in which they are read.
const std::vector<SettingKey<SimulationSettings>>& plain_setting_keys();
/// All keys of [simulation], and those of its tables.
const TableKeys& simulation_keys();
const TableKeys& speed_profile_keys();
const TableKeys& torque_keys();
const TableKeys& field_keys();
const TableKeys& wheel_keys();
const TableKeys& check_rail_keys();
const TableKeys& point_keys();

/// [assessment] and [[assessment.sections]] beside [simulation].
const TableKeys& assessment_keys();
const TableKeys& section_keys();

/// [layout], [[layout.elements]], [irregularities] and [[irregularities.spectra]] beside [simulation].
const TableKeys& layout_keys();
const TableKeys& element_keys();
const TableKeys& irregularity_keys();
const TableKeys& spectrum_keys();

const TableKeys& study_keys();
const TableKeys& vary_keys();
const TableKeys& vary_value_keys();
const TableKeys& figure_keys();
const TableKeys& mark_keys();

/// JSON Schemas (draft 2020-12) of the files.
std::string vehicle_file_schema();
std::string track_file_schema();
std::string simulation_file_schema();
std::string study_file_schema();

/// [evolve] of files of `treadmark evolve`, its [evolve.wheel] and [evolve.rail], and their [law], [fatigue] and
/// [flow].
const TableKeys& evolve_keys();
const TableKeys& evolving_body_keys();
const TableKeys& wear_law_keys();
const TableKeys& fatigue_keys();
const TableKeys& flow_law_keys();
/// Those of their keys that are one member each.
const std::vector<SettingKey<EvolutionFile>>& plain_evolve_keys();
const std::vector<SettingKey<EvolvingBody>>& plain_evolving_body_keys();
const std::vector<SettingKey<WearLaw>>& plain_wear_law_keys();
const std::vector<SettingKey<FlowLaw>>& plain_flow_law_keys();
const std::vector<SettingKey<FatigueSettings>>& plain_fatigue_keys();
std::string evolve_file_schema();
std::string evolve_key_table();

/// All keys as Markdown tables (docs/simulation-files.md); tables that a track shares with a vehicle once.
std::string vehicle_key_table();
std::string track_key_table();
std::string simulation_key_table();
std::string study_key_table();

}  // namespace treadmark::io
