// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "treadmark/io/hdf5/hdf5_file.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// Writes everything a run produced, fields included, to one HDF5 file in SI units:
/// /case_0001/patch_1/{gap, pressure, traction_x, ..., state}, each a dataset [ny, nx] (rows along s) with its unit as
/// attribute, and /surfaces/wheel_1 ...; the layout is in docs/results.md. Fields that are empty are left out.
/// Compressed where deflate is available. The file appears only when complete. Errors: Error(configuration) for fields
/// that do not match their grid and for files that cannot be written. Not to be called from two threads at once: the
/// HDF5 library may not be thread-safe.
void write_hdf5(const std::filesystem::path& path, const RunResult& run);

/// Whether the wall-clock times of a case are written: without them equal results give equal bytes.
enum class CaseTimes { written, left_out };

/// Writes one case with its patches and fields to a group, as it stands at /case_0001 of the file above. Errors as
/// above.
void write_case(const Hdf5GroupWriter& group, const CaseResult& result, CaseTimes times);

/// Writes surfaces to a group of their own, as they stand at /surfaces of the file above; none: no group. Errors: as
/// check_surfaces.
void write_surfaces(const Hdf5GroupWriter& parent, std::span<const SampledSurface> surfaces);

/// What is written at the group of a run besides its parts.
std::vector<Attribute> attributes_of(const RunResult& run);
/// The same of a case.
std::vector<Attribute> attributes_of(const CaseResult& result);
/// The same of a patch, besides its fields.
std::vector<Attribute> attributes_of(const PatchResult& patch);

}  // namespace treadmark::io
