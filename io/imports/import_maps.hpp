// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::io {

/// Writes the maps of a report to one HDF5 file in SI units (docs/scans.md); maps without values are left out. The same
/// report gives the same bytes. The file appears only when complete. Errors: Error(configuration) if it cannot be
/// written or a map's sizes do not fit its values. Not to be called from two threads at once, as all functions for HDF5
/// files.
void write_import_maps(const std::filesystem::path& path, const ImportReport& report);

/// The maps of such a file, and the nominal radius in full precision; body: of the report that they belong to. Errors:
/// Error(input_data) for files that are no such files, cut off, or do not fit together.
void read_import_maps(const std::filesystem::path& path, ImportReport& report);

}  // namespace treadmark::io
