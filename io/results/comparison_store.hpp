// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// Writes the fields of all candidates to one HDF5 file in SI units: /candidate_01 (the truth), /candidate_02 ..., each
/// with its cases as write_hdf5 writes them, and with surfaces where it has any; the layout is in docs/results.md. The
/// file appears only when complete. Errors: as write_hdf5. Not to be called from two threads at once.
void write_comparison_fields(const std::filesystem::path& path, const Comparison& comparison);

/// The comparison in such a file: what was compared, and of each candidate name, resolution, failure, cases with
/// fields, and surfaces. Its rows and bodies are in compare.json only. Errors: Error(input_data), as read_hdf5. Not to
/// be called from two threads at once.
Comparison read_comparison_fields(const std::filesystem::path& path);

/// A row as the files have it: with what names its candidate, and what is known of that.
struct ComparedRow : ComparisonRow {
  std::string backend, wheel_backend, rail_backend;
  double resolution = 0.0;  ///< [m]; 0 = as given
  CandidateDigest all = {};
};
ComparedRow compared_row(const ComparisonCandidate& candidate, const ComparisonRow& row);

}  // namespace treadmark::io

namespace treadmark {

template <>
std::span<const Column<io::ComparisonCandidate>> columns();
template <>
std::span<const Column<io::RepresentedBody>> columns();
/// Numbers of a row that are not put here are counts and words that have a check of their own. Errors of a row that is
/// not comparable are not known.
template <>
std::span<const Column<io::ComparedRow>> columns();

}  // namespace treadmark
