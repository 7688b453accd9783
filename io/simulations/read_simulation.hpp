// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/io/simulations/table_of.hpp"

namespace treadmark::io {

struct LayoutInput;
struct IrregularityInput;

/// Reads a simulation file (TOML, docs/simulation-files.md) with the vehicle and the track that it names, relative to
/// its folder. overrides: "key.path=value", applied after everything else: keys of the simulation
/// ("simulation.wheels.0.contact=table") and of the contact as in a case file ("wheel.flats.0.depth_mm=1.2"), parts of
/// the vehicle and the track by their names
/// ("vehicle.bodies.car.mass_kg=30000", "track_model.scale_stiffness=1.5").
/// Geometry files are resolved but not opened. Throws Error(configuration) with file:line:column. Safe to call from
/// several threads.
SimulationFile read_simulation_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for text in memory; name serves for messages and for resolving files.
SimulationFile parse_simulation_text(std::string_view text, const std::filesystem::path& name,
                                     std::span<const std::string> overrides = {});
/// The same for tables that have been parsed already; sha256 stays empty.
SimulationFile simulation_of(CaseTable document, const std::filesystem::path& name,
                             std::span<const std::string> overrides = {});

/// Parts of the reader of simulation files. Error(configuration) at the place of what is wrong.

/// [simulation].
using SimulationTable = TableOf<SimulationFile>;
/// Its keys that are one member each, and its speeds.
void read_settings(const SimulationTable& simulation, SimulationFile& out);
/// [[simulation.train]]: hangs its vehicles behind out.vehicle.
void read_train(const SimulationTable& simulation, const std::filesystem::path& folder, SimulationFile& out);
/// [simulation.free_run]: the speeds; everything that drives and brakes out.vehicle is set, and out.start.
void read_free_run(const SimulationTable& simulation, SimulationFile& out);
/// Refuses speeds that vehicles which run free do not keep under torques and forces along x: their frames would run
/// away from them. All of file is set.
void check_speeds(const SimulationTable& simulation, const SimulationFile& file);
/// [simulation.fields].
FieldRequests read_fields(const SimulationTable& simulation);
/// What [simulation] says of the history; out.vehicle and out.settings are set.
void read_history(const SimulationTable& simulation, SimulationFile& out);
/// [assessment]; out.vehicle, out.settings and out.irregularities are set.
void read_assessment(const TableOf<AssessmentRequest>& assessment, const std::filesystem::path& folder,
                     SimulationFile& out);
/// [[simulation.torques]].
std::vector<AxleTorque> read_torques(const SimulationTable& simulation, const VehicleModel& vehicle);
/// [[simulation.forces]], [[simulation.spring_motions]], [[simulation.rail_shifts]].
void read_motions(const SimulationTable& simulation, SimulationFile& out);
/// [simulation.twist]; out.vehicle and out.settings are set.
void read_twist(const SimulationTable& simulation, SimulationFile& out);
/// One entry for every wheel of the vehicle; file.vehicle and file.settings are set.
std::vector<WheelContactInput> read_wheels(const SimulationTable& simulation, const SimulationFile& file);

/// A file that a key names, from the folder of the simulation file, with its text.
struct FileText {
  NamedFile file;
  std::string text;
};
/// Errors: Error(configuration) where there is no such file.
FileText named_text(const TableReader& table, std::string_view key, const std::filesystem::path& folder);

/// Places of the rearmost and the foremost wheelset along the vehicle [m].
FromTo wheelset_places(const VehicleModel& vehicle);

/// [layout], which must reach as far as the vehicle runs: out.vehicle, out.settings and out.contact are set.
void read_layout(const TableOf<LayoutInput>& layout, SimulationFile& out);
/// [layout] of a simulation file, or of a file that has nothing else, for those who have no vehicle on it; other tables
/// are not looked at. Errors: Error(configuration) with file:line:column; also where there is no [layout].
TrackLayout read_track_layout(const std::filesystem::path& file);
/// [irregularities], which must reach as far: out.vehicle, out.settings and out.layout are set.
void read_irregularities(const TableOf<IrregularityInput>& irregularities, const std::filesystem::path& folder,
                         SimulationFile& out);

/// Everything outside of [simulation], [layout] and [irregularities]: the keys of a case file.
struct ContactPart {
  CaseTable tables;
  std::vector<std::string> overrides;
  std::filesystem::path name;
};
/// Refuses keys that a simulation finds itself, and reads the rest into out.contact and out.notes; out.vehicle and
/// out.settings are set.
void read_contact(const ContactPart& part, SimulationFile& out);
/// [simulation.other_wheel] into out.other_wheel; out.contact and out.wheels are set.
void read_other_wheel(const ContactPart& part, const SimulationTable& simulation, SimulationFile& out);
/// [[simulation.check_rails]]; out.contact is set.
void read_check_rails(const SimulationTable& simulation, SimulationFile& out);
/// The contact with a [rail], where both sides have rails of their own.
ContactPart with_rail(ContactPart part, const SimulationTable& simulation);
/// [simulation.left_rail], right_rail and table_rail; part: as with_rail() gives it, out.contact is set.
void read_rails(const ContactPart& part, const SimulationTable& simulation, SimulationFile& out);

}  // namespace treadmark::io
