// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/backends/create.hpp"
#include "treadmark/model/shape/offset_map.hpp"

namespace treadmark {

/// The surface with offsets added (z of a rail, radius of a wheel), cubic B-splines between the nodes of the map;
/// outside of the map it is as it was. Errors: those of the backend of offsets; Error(configuration) for a roller.
NaturalSurface add_offsets(const NaturalSurface& natural, const OffsetMap& map);

/// The same as a .vdb or .nvdb file: over one section without defects the map itself, so that what is read from it is
/// what add_offsets makes; else sampled as wanted, over the section without them. notes: for the head of the file.
/// Errors: as write_offsets.
void write_added_offsets(const std::filesystem::path& file, const NaturalSurface& natural, const OffsetMap& map,
                         const Representation& wanted, const std::string& notes = {});

}  // namespace treadmark
