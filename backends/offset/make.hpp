// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/offset_map.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::offset {

enum class Interpolation { bilinear, quadratic, bicubic };

/// Where and how densely offsets are sampled.
struct OffsetSettings {
  double du = 1e-3;  ///< voxel along u: [m] along the track, or [m] of arc at the nominal radius (rounded so that a
                     ///< whole number of voxels makes the turn)
  double dy = 1e-3;  ///< voxel along y [m]
  double tolerance = 1e-9;                        ///< offsets up to this are background [m]
  Rectangle region_uy{-1e30, 1e30, -1e30, 1e30};  ///< x: u [m] or [rad]; sampled where the base has a surface
};

/// Sparse offsets over one base, in an OpenVDB grid: one value per voxel of (u, y), background 0.
class SparseOffsets;

struct OffsetSample {
  std::shared_ptr<const SparseOffsets> offsets;
  std::size_t nodes = 0;      ///< looked at
  std::size_t active = 0;     ///< beyond the tolerance
  std::size_t continued = 0;  ///< base present, target missing: offset of the nearest node of the section
  std::size_t gaps = 0;       ///< sections where only the base has a surface, between others that have both
  double max_offset = 0.0;    ///< [m]
};

/// target - base at the nodes. Both are wheels or both rails; nominal_radius is unused for rails.
/// A rail's region must be finite along u. Errors: Error(configuration) for settings that make no sense or would need
/// more than 2^31 nodes; Error(input_data) if the base nowhere underlies the target.
OffsetSample sample_offsets(const Surface& target, const Surface& base, Body body, double nominal_radius,
                            const OffsetSettings& settings);

/// From measured deviations, resampled to nothing: voxels are the nodes of the map. A wheel's map that covers the turn
/// is periodic: its step must divide 2 pi. Errors: Error(configuration), Error(input_data).
OffsetSample offsets_from_map(const OffsetMap& map, Body body, double tolerance);

/// backend: what Surface::backend() says. Errors: Error(configuration) for a base of the other body.
std::shared_ptr<const Surface> make_offset_surface(std::shared_ptr<const Surface> base,
                                                   std::shared_ptr<const SparseOffsets> offsets,
                                                   Interpolation interpolation, std::string backend);

/// Memory of the values [bytes], number of active voxels.
std::size_t memory_bytes(const SparseOffsets& offsets);
std::size_t active_count(const SparseOffsets& offsets);

/// A .vdb file: the offsets as a FloatGrid sheet at k = 0 with its transform, and as metadata units, axes, body,
/// nominal radius and the base (a constant section: standard profile, arcs or points). Or the same as a .nvdb file of
/// NanoVDB, which is evaluated where it lies, without OpenVDB (nano_file.hpp).
struct OffsetFile {
  std::shared_ptr<const SparseOffsets> offsets;
  SurfaceSpec base;      ///< without defects; with the errors of the surface over it
  std::string notes{};   ///< for people: kept in the file as its entry 'notes'; not read back
  std::string remark{};  ///< of reading: a sentence about what another program changed; may be empty
};
/// What OpenVDB wrote again is read too: other names of the grid, half precision, packed values, other grids beside it,
/// a transform that was moved or scaled; a .nvdb file only as write_vdb wrote it. The end of the name says which.
/// Errors: Error(input_data) for a file that is missing, empty, damaged, not VDB, or holds no offsets, saying what it
/// holds; Error(configuration) for a base that is not a constant section, or a file that cannot be written.
void write_vdb(const std::filesystem::path& file, const OffsetFile& content);
OffsetFile read_vdb(const std::filesystem::path& file);

}  // namespace treadmark::offset
