// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// Writes the fields of all candidates to one HDF5 file in SI units: /candidate_01 (the truth), /candidate_02 ..., each
/// with its cases as write_hdf5 writes them, and with surfaces where it has any; the layout is in docs/results.md. The
/// file appears only when complete. Errors: as write_hdf5. Not to be called from two threads at once.
void write_comparison_fields(const std::filesystem::path& path, const Comparison& comparison);

/// The comparison in such a file: what was compared, and of each candidate name, resolution, failure, cases with
/// fields, and surfaces. Its rows and bodies are in compare.json only. Errors: Error(input_data), as read_hdf5. Not to
/// be called from two threads at once.
Comparison read_comparison_fields(const std::filesystem::path& path);

}  // namespace treadmark::io
