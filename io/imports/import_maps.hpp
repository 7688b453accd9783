// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::io {

/// The maps of an import, as they are in its report; those that it does not have are empty.
struct ImportMaps {
  Body body = Body::rail;
  double nominal_radius = 0.0;  ///< of a wheel [m]
  BandMap density, removed, fitted, residual, noise;
};

/// Writes the maps of a report to one HDF5 file in SI units (docs/scans.md); maps without values are left out. The same
/// report gives the same bytes. The file appears only when complete. Errors: Error(configuration) if it cannot be
/// written or a map's sizes do not fit its values. Not to be called from two threads at once, as all functions for HDF5
/// files.
void write_import_maps(const std::filesystem::path& path, const ImportReport& report);

/// Errors: Error(input_data) for files that are no such files, cut off, or do not fit together.
ImportMaps read_import_maps(const std::filesystem::path& path);

}  // namespace treadmark::io
