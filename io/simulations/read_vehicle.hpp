// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/io/simulations/table_reader.hpp"
#include "treadmark/model/vehicle/flexible_track.hpp"
#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::io {

/// Reads a vehicle or a track (TOML, docs/simulation-files.md).
/// overrides: "key.path=value" with parts by their name, "bodies.car.mass_kg=30000", "scale_stiffness=1.2".
/// Throws Error(configuration) with file:line:column: broken TOML, unknown keys and names (with a suggestion), values
/// out of range, bodies that nothing holds. Safe to call from several threads.
VehicleModel read_vehicle_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});
/// A lumped track: a flexible one is refused with what to do about it.
TrackModel read_track_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// A track of either kind.
using AnyTrack = std::variant<TrackModel, FlexibleTrack>;
AnyTrack read_any_track_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for text in memory; name serves for messages. Paths of changes as above, whatever their messages say.
VehicleModel parse_vehicle_text(std::string_view text, const std::string& name,
                                std::span<const CaseOverride> changes = {});
TrackModel parse_track_text(std::string_view text, const std::string& name, std::span<const CaseOverride> changes = {});
AnyTrack parse_any_track_text(std::string_view text, const std::string& name,
                              std::span<const CaseOverride> changes = {});

/// Refuses bodies that nothing holds.
void check_held(const VehicleModel& vehicle);

/// A flexible track but for name, source and scales, from the tables beside [track].
FlexibleTrack read_flexible_track(const TableReader& document);

/// The parts that vehicle and track files share. One table may stand for several equal parts at different places, which
/// are then called by its name and their number from 1. Error(configuration) at the place of what is wrong.

std::vector<BodySpec> read_bodies(const TableReader& document);
/// bodies: those that can be connected, beside the ground.
std::vector<SpringSpec> read_springs(const TableReader& document, const std::vector<BodySpec>& bodies);
std::vector<BumpStopSpec> read_bump_stops(const TableReader& document, const std::vector<BodySpec>& bodies);
std::vector<DamperCurveSpec> read_damper_curves(const TableReader& document, const std::vector<BodySpec>& bodies);
/// springs and stops: whose loads may press them.
std::vector<DryFrictionSpec> read_frictions(const TableReader& document, const std::vector<BodySpec>& bodies,
                                            const std::vector<SpringSpec>& springs,
                                            const std::vector<BumpStopSpec>& stops);
std::vector<AirSpringSpec> read_air_springs(const TableReader& document, const std::vector<BodySpec>& bodies);
std::vector<FlexibleAxle> read_axles(const TableReader& document);

std::vector<std::string> names_of(const std::vector<BodySpec>& bodies);

/// Directions that a list of words names. Refuses unknown words and the same one twice.
std::array<bool, kFreedoms> directions_of(const TableReader& part, std::string_view key);

/// Names of parts start with a letter and go on with letters, digits, '_' and '-'.
std::string part_name(const TableReader& part);

/// The word of a direction: "x" ... "yaw".
std::string_view freedom_word(int freedom);

}  // namespace treadmark::io
