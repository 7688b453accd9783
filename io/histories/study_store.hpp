// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/histories/study_model.hpp"

namespace treadmark::io {

/// Writes a study to one HDF5 file: /run_0001 ... are the runs' own stores, copied; /sweep is the table of swept values
/// and summaries. Equal runs give equal bytes, in whatever order they are listed. A run without a store is in the table
/// only. The file appears only when complete. Errors: as study_table; Error(input_data) for stores that cannot be read;
/// Error(configuration) for files that cannot be written. Not to be called from two threads at once.
void write_study_store(const std::filesystem::path& path, const StudyResult& study);

/// What a store of a study says of it, without its runs. Errors: Error(input_data). Not to be called from two threads
/// at once.
StudyResult read_study_head(const std::filesystem::path& path);

/// Table with commas, a run a line in the order of the numbers: swept keys, then the summary (SI; exact; empty = none),
/// then run, label, status, message. The file appears only when complete. Errors: as study_table; Error(configuration).
/// Thread-safe.
void write_sweep_csv(const std::filesystem::path& path, const StudyResult& study);

}  // namespace treadmark::io
