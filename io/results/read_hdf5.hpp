// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// The run in a file of write_hdf5, as far as that writes it: run, cases in the order of their numbers, patches with
/// fields and blocks below the surface, sampled surfaces. Not in such files, and left as they are in an empty result:
/// times of the parts of a solution, force iterations, the list of representations, what asks for text files, and
/// sensitivities. Attributes that newer files have more of are missing in older ones and then left so too. Errors:
/// Error(input_data) for files that are no such files, of another version, cut off, or do not fit together. Not to be
/// called from two threads at once.
RunResult read_hdf5(const std::filesystem::path& path);

/// Its parts, of files that hold such groups. cases(): all groups case_0001 ... below a group. Errors as above.
std::vector<CaseResult> read_cases(const Hdf5GroupReader& parent);
CaseResult read_case(const Hdf5GroupReader& group);
std::vector<SampledSurface> read_surfaces(const Hdf5GroupReader& parent);

/// Throws Error(input_data) unless the file says that it holds this, or all surfaces that cases name are there.
void require_format(const Hdf5GroupReader& root, const std::string& format);
void check_surface_names(const Hdf5GroupReader& where, std::span<const CaseResult> cases,
                         std::span<const SampledSurface> surfaces);

/// Throws Error(input_data): the file is none of ours. what goes on from "the file of results ...".
[[noreturn]] void refuse_result(const Hdf5GroupReader& where, const std::string& what);

}  // namespace treadmark::io
