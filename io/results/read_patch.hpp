// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// A patch with its fields and blocks from the group of a file of results. Errors: Error(input_data).
PatchResult read_patch(const Hdf5GroupReader& group);

/// Loads of a case or patch; none where they are not known. Errors: Error(input_data).
std::optional<Loads> read_loads(const Hdf5GroupReader& group);

}  // namespace treadmark::io
