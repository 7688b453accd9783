// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// The comparison in a folder of `treadmark compare`: compare.json and, where it is there, fields.h5, which has the
/// results and the surfaces. Numbers have the 12 digits of the file; messages of rows are in the results only. Errors:
/// Error(input_data) for files that are missing, broken, lack keys, or do not belong together. Not to be called from
/// two threads at once (HDF5).
Comparison read_comparison(const std::filesystem::path& folder);

}  // namespace treadmark::io
