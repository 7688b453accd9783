// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "treadmark/core/vehicle_model.hpp"
#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::io {

/// Reads a vehicle or a track (TOML, docs/simulation-files.md).
/// overrides: "key.path=value" with parts by their name, "bodies.car.mass_kg=30000", "scale_stiffness=1.2".
/// Throws Error(configuration) with file:line:column: broken TOML, unknown keys and names (with a suggestion), values
/// out of range, bodies that nothing holds. Safe to call from several threads.
VehicleModel read_vehicle_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});
TrackModel read_track_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for text in memory; name serves for messages. Paths of changes as above, whatever their messages say.
VehicleModel parse_vehicle_text(std::string_view text, const std::string& name,
                                std::span<const CaseOverride> changes = {});
TrackModel parse_track_text(std::string_view text, const std::string& name, std::span<const CaseOverride> changes = {});

}  // namespace treadmark::io
